//! What an id of a quirk stands for, and how a chapter of them is written.

/// What a real controller does differently from its own document.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Quirk(pub(super) u16);

/// The quirks of a chapter.
macro_rules! quirks {
    ($first:expr; $($(#[doc = $doc:literal])* $name:ident = $id:literal,)*) => {
        $crate::ids::chapter::ids! {
            $first; $crate::dialects::page::Quirk; $($(#[doc = $doc])* $name = $id,)*
        }
    };
}
