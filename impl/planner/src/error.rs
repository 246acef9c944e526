//! Why a planner was not made, or a segment was not queued.

use core::fmt;

/// Why a planner was not made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Error {
    /// A value of the machine cannot be used; the text says which and why.
    Configuration(&'static str),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Configuration(what) => f.write_str(what),
        }
    }
}

impl core::error::Error for Error {}

/// Why a segment was not queued.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotQueued {
    /// The queue is full, or an abort is clearing it; try again after the next cycle.
    Full,
    /// A number is not finite, a feed is not positive, a radius is zero, or the segment moves an axis that cannot
    /// move.
    Malformed,
}
