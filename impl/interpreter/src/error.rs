//! Why a call of this crate failed.

use alloc::boxed::Box;
use core::fmt;

use gaugeblock_vocabulary::{BlockLocation, Fault};

use crate::limits::Limit;
use crate::source::SourceError;

/// Why the interpreter does not go on.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// The program is refused at a block: the answer of the documents.
    Fault(Box<Fault>),
    /// The program needs more than [`crate::Limits`] allows.
    LimitExceeded {
        /// Which bound.
        limit: Limit,
        /// Where.
        block: BlockLocation,
    },
    /// The source could not be read.
    Source(SourceError),
    /// A value of the machine or of the options is not usable; which and why, for people.
    Configuration(&'static str),
}

impl Error {
    /// The file and the line that it is about, where it is about one.
    pub(crate) fn line(&self) -> Option<(&str, u32)> {
        let block = match self {
            Self::Fault(fault) => fault.block.as_ref()?,
            Self::LimitExceeded { block, .. } => block,
            Self::Source(_) | Self::Configuration(_) => return None,
        };
        Some((&block.file, block.line))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fault(fault) => match &fault.block {
                Some(block) => write!(f, "{block}: {}", fault.message),
                None => f.write_str(&fault.message),
            },
            Self::LimitExceeded { limit, block } => write!(f, "{block}: too many {limit}"),
            Self::Source(unreadable) => {
                write!(f, "{}: {}", unreadable.file, unreadable.message)
            }
            Self::Configuration(what) => f.write_str(what),
        }
    }
}

impl core::error::Error for Error {}

impl From<SourceError> for Error {
    fn from(unreadable: SourceError) -> Self {
        Self::Source(unreadable)
    }
}
