//! Generators for what values are made of: numbers, texts, words, names, positions, blocks.

use std::collections::BTreeMap;
use std::fmt::Debug;

use gaugeblock_vocabulary::{BlockLocation, Indexed, Position, Span};
use proptest::collection::{btree_map, vec};
use proptest::prelude::*;

use super::whole;

/// Any finite number, the plain ones more often.
pub(crate) fn number() -> BoxedStrategy<f64> {
    use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    prop_oneof![
        (-100_000_i32..100_000).prop_map(|thousandths| f64::from(thousandths) / 1000.0),
        POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO,
    ]
    .boxed()
}

/// Any text: plain words, and what makes a form stumble.
pub(crate) fn text() -> BoxedStrategy<String> {
    let awkward = vec(
        proptest::sample::select(vec![
            "\n", "\r", "\r\n", "\t", "\0", "\u{1b}", "\u{7f}", "\u{85}", "\u{2028}", "\u{feff}",
            "\"", "\"\"\"", "'", "'''", "\\", "\\u0041", "=", "[", "]", "(", ")", ":", " ", "#",
            "%", ";", "name=1", "é", "𝄞", "x", "1",
        ]),
        0..8,
    );
    prop_oneof![
        "[a-z0-9 ]{0,12}",
        awkward.prop_map(|parts| parts.concat()),
        vec(any::<char>(), 0..8).prop_map(|chars| chars.into_iter().collect()),
    ]
    .boxed()
}

/// A member of a closed list.
pub(crate) fn word<T: Copy + Debug + 'static>(all: &'static [T]) -> BoxedStrategy<T> {
    proptest::sample::select(all).boxed()
}

pub(crate) fn position() -> BoxedStrategy<Position> {
    let coordinate = prop_oneof![Just(0.0), number()];
    proptest::array::uniform9(coordinate).prop_map(Position::from).boxed()
}

pub(crate) fn block() -> BoxedStrategy<BlockLocation> {
    let file = prop_oneof![Just("main.ngc".to_owned()), text()];
    whole!(BlockLocation { file: file.prop_map(Into::into), line: any::<u32>() })
}

pub(crate) fn span() -> BoxedStrategy<Span> {
    whole!(Span { start: any::<u32>(), end: any::<u32>() })
}

/// Values by index, one at least.
pub(crate) fn indexed<K, T>(
    index: impl Strategy<Value = K> + 'static,
    value: impl Strategy<Value = T> + 'static,
) -> BoxedStrategy<Indexed<K, T>>
where
    K: Ord + Clone + Debug + 'static,
    T: Clone + Debug + 'static,
{
    btree_map(index, value, 1..4).prop_map(|map| Indexed(map.into())).boxed()
}

/// A table by name, which may be empty.
pub(crate) fn named<T: Debug + 'static>(
    value: impl Strategy<Value = T> + 'static,
) -> BoxedStrategy<BTreeMap<String, T>> {
    btree_map(text(), value, 0..3).boxed()
}
