//! Generators for every type of the vocabulary: any value that the text and JSON forms promise to hold.
//!
//! The macros name each field and variant once and stop compiling when one is missing here.
//!
//! **Left out on purpose**, since no form promises it: numbers that are not finite, an indexed field without any
//! value (the same as an absent one), a state in another language than the outcome's.

mod numbers;
mod outcome;
mod scenario;

pub(crate) use outcome::{effect, outcome, settings};
pub(crate) use scenario::scenario;

/// A strategy for a struct from one strategy per field.
macro_rules! whole {
    ($type:ident { $($field:ident: $strategy:expr),* $(,)? }) => {
        (proptest::strategy::Just(()), $($strategy,)*)
            .prop_map(|((), $($field,)*)| $type { $($field,)* })
            .boxed()
    };
}

/// A strategy for a record: each field stands there or not.
macro_rules! recorded {
    ($type:ident { $($field:ident: $strategy:expr),* $(,)? }) => {{
        let all = proptest::strategy::Just($type::default()).boxed();
        $(
            let all = (all, proptest::option::weighted(0.3, $strategy))
                .prop_map(|(mut record, value)| {
                    record.$field = value;
                    record
                })
                .boxed();
        )*
        let complete = |record: $type| {
            let $type { $($field: _,)* } = record;
        };
        complete($type::default());
        all
    }};
}

/// A strategy for an enum from one strategy per field of each variant.
macro_rules! variants {
    ($type:ident { $($variant:ident { $($field:ident: $strategy:expr),* $(,)? })* }) => {{
        let complete = |value: &$type| match value {
            $($type::$variant { .. } => {})*
        };
        proptest::strategy::Union::new([
            $((proptest::strategy::Just(()), $($strategy,)*)
                .prop_map(|((), $($field,)*)| $type::$variant { $($field,)* })
                .boxed(),)*
        ])
        .prop_map(move |value| {
            complete(&value);
            value
        })
        .boxed()
    }};
}

pub(crate) use {recorded, variants, whole};
