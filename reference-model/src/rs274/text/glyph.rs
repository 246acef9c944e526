//! Characters of a line, and their places.

use gaugeblock_vocabulary::Span;

/// A character that counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Glyph {
    /// The character in lower case; for a whole comment, [`Glyph::COMMENT`].
    pub character: char,
    /// Its first byte in the line.
    pub start: u32,
    /// One past its last byte.
    pub end: u32,
}

impl Glyph {
    /// The glyph in place of a whole comment: a left parenthesis, which occurs nowhere else.
    pub const COMMENT: char = '(';
}

/// A place in a line, which has at most 256 characters.
pub(super) fn place(byte: usize) -> u32 {
    u32::try_from(byte).unwrap_or(u32::MAX)
}

/// A part of a line.
pub(super) fn span(start: usize, end: usize) -> Span {
    Span { start: place(start), end: place(end) }
}
