//! The ids that a dialect adds to those of the documents: none.

/// The ids of each chapter.
pub(crate) const ID_CHAPTERS: &[&[&str]] = &[];

/// How many there are.
pub(crate) const ID_COUNT: u16 = 0;
