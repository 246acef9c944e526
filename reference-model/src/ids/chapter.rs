//! How a chapter of ids is written: a list of names with their ids, each after its sentence.

/// The rules of a chapter.
macro_rules! rules {
    ($first:expr; $($(#[doc = $doc:literal])* $name:ident = $id:literal,)*) => {
        $crate::ids::chapter::ids! {
            $first; $crate::ids::page::Rule; $($(#[doc = $doc])* $name = $id,)*
        }
    };
}

/// A constant for each id, numbered from a first number on.
macro_rules! ids {
    ($first:expr; $kind:path; $($(#[doc = $doc:literal])* $name:ident = $id:literal,)*) => {
        /// The ids of this chapter, in the order of their numbers.
        pub(super) const CHAPTER_IDS: &[&str] = &[$($id),*];

        #[expect(
            non_camel_case_types,
            clippy::upper_case_acronyms,
            dead_code,
            reason = "each is named as the constant that it numbers; the last two have both forms of a name"
        )]
        enum Numbering { $($name,)* Past_End, PAST }

        $($(#[doc = $doc])* pub const $name: $kind = $kind($first + Numbering::$name as u16);)*
    };
}

pub(crate) use ids;

/// A type for each choice of a chapter, with a variant for each option.
macro_rules! choices {
    ($first:expr; $(
        $(#[doc = $doc:literal])* $name:ident = $id:literal {
            $($(#[doc = $means:literal])* $option:ident = $text:literal,)*
        }
    )*) => {
        /// The pages of this chapter, in the order of their numbers.
        pub(super) const CHAPTER_PAGES: &[$crate::ids::page::Page] =
            &[$($crate::ids::page::Page { id: $id, options: &[$($text),*] }),*];

        enum Numbering { $($name,)* }

        $(
            $(#[doc = $doc])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub enum $name { $($(#[doc = $means])* $option,)* }

            impl $crate::ids::page::Choice for $name {
                const NUMBER: u16 = $first + Numbering::$name as u16;
                const OPTIONS: &'static [Self] = &[$(Self::$option),*];

                fn place(self) -> u8 {
                    self as u8
                }
            }
        )*
    };
}
