//! Where a block is in a program, and a part of its text.

use alloc::borrow::{Cow, ToOwned as _};
use core::fmt;

/// File name of the main program.
pub(crate) const MAIN_FILE: &str = "main.ngc";

/// A place in a program: a block is one line's worth.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BlockLocation {
    /// File name; the main program is `main.ngc`.
    pub file: Cow<'static, str>,
    /// Line, from 1.
    pub line: u32,
}

impl BlockLocation {
    /// A block by file and line. Most blocks are of the main program, whose name costs no text of its own.
    pub fn new(file: impl AsRef<str>, line: u32) -> Self {
        let file = match file.as_ref() {
            MAIN_FILE => Cow::Borrowed(MAIN_FILE),
            other => Cow::Owned(other.to_owned()),
        };
        Self { file, line }
    }
}

impl fmt::Display for BlockLocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.file, self.line)
    }
}

/// A part of a line, for pointing at it: bytes from `start` up to, not including, `end`, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Span {
    /// First byte of the line.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}
