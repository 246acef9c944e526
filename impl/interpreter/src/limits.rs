//! Bounds of this implementation, not of the documents.

use core::fmt;

/// Bounds on depth and memory. A program that needs more is refused; nothing overflows and nothing grows without end.
///
/// The limits that documents state (levels of calls, arguments of a call, length of a line) apply besides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Deepest nesting of brackets in an expression.
    pub bracket_depth: u32,
    /// Deepest nesting of subroutine calls, where it is less than the ten of the documents.
    pub call_depth: u32,
    /// Named parameters that exist at one time, all levels together.
    pub named_parameters: u32,
    /// Bytes that compiled loops and subroutines take together, their labels included.
    pub code_bytes: u32,
    /// Blocks that are read after an aborted one, where the dialect reads ahead.
    pub blocks_ahead: u32,
    /// Settings and effects that wait for the next move under cutter compensation. A block adds a few more.
    pub waiting_effects: u32,
    /// Moves of the profile of a lathe cycle.
    pub profile_moves: u32,
}

impl Default for Limits {
    /// Enough for every program that the documents allow, in a few megabytes.
    fn default() -> Self {
        Self {
            bracket_depth: 64,
            call_depth: 64,
            named_parameters: 65_536,
            code_bytes: 16_777_216,
            blocks_ahead: 100_000,
            waiting_effects: 65_536,
            profile_moves: 16_384,
        }
    }
}

/// Which bound a program went beyond.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// [`Limits::bracket_depth`].
    BracketDepth,
    /// [`Limits::call_depth`].
    CallDepth,
    /// [`Limits::named_parameters`].
    NamedParameters,
    /// [`Limits::code_bytes`].
    CodeBytes,
    /// [`Limits::blocks_ahead`].
    BlocksAhead,
    /// [`Limits::waiting_effects`].
    WaitingEffects,
    /// [`Limits::profile_moves`], or an offset of a profile that takes too many steps.
    ProfileMoves,
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::BracketDepth => "nested brackets",
            Self::CallDepth => "nested calls",
            Self::NamedParameters => "named parameters",
            Self::CodeBytes => "bytes of loops and subroutines",
            Self::BlocksAhead => "blocks read ahead at an abort",
            Self::WaitingEffects => "effects that wait under cutter compensation",
            Self::ProfileMoves => "moves of a profile, or steps of its offset",
        })
    }
}
