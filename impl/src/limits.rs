//! What an interpreter may use: bounds of this implementation, not of the documents.

use core::fmt;

/// Bounds on depth and memory. A program that needs more is refused; nothing overflows and nothing grows without end.
///
/// The limits that documents state (levels of calls, arguments of a call, length of a line) apply besides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Longest line, bytes.
    pub line_length: u32,
    /// Deepest nesting of brackets in an expression.
    pub bracket_depth: u32,
    /// Deepest nesting of subroutine calls.
    pub call_depth: u32,
    /// Deepest nesting of loops and conditions in one subroutine.
    pub block_depth: u32,
    /// Named parameters that exist at one time, all levels together.
    pub named_parameters: u32,
    /// Bytes that packed loops and subroutines take together.
    pub packed_bytes: u32,
}

impl Default for Limits {
    /// Enough for every program that the documents allow, in a few megabytes.
    fn default() -> Self {
        Self {
            line_length: 4096,
            bracket_depth: 64,
            call_depth: 64,
            block_depth: 64,
            named_parameters: 65_536,
            packed_bytes: 16_777_216,
        }
    }
}

/// Which bound a program went beyond.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// [`Limits::line_length`].
    LineLength,
    /// [`Limits::bracket_depth`].
    BracketDepth,
    /// [`Limits::call_depth`].
    CallDepth,
    /// [`Limits::block_depth`].
    BlockDepth,
    /// [`Limits::named_parameters`].
    NamedParameters,
    /// [`Limits::packed_bytes`].
    PackedBytes,
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::LineLength => "bytes in a line",
            Self::BracketDepth => "nested brackets",
            Self::CallDepth => "nested calls",
            Self::BlockDepth => "nested loops and conditions",
            Self::NamedParameters => "named parameters",
            Self::PackedBytes => "bytes of loops and subroutines",
        })
    }
}
