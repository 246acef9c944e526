//! The result of a block on the modal side.

use alloc::string::String;

use gaugeblock_vocabulary::FaultKind;

use crate::limits::Limit;

/// How execution continues after a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flow {
    /// With the next block.
    More,
    /// With the next block, after a stop; the block has been finished.
    Stopped,
    /// With the rest of this block, which is more than a step does.
    Within {
        /// Whether the sink replied with a stop.
        stopped: bool,
    },
    /// Not at all: M2, M30.
    Ended,
}

/// Why a block was not executed, or not to its end; its place is known to the caller.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Refusal {
    /// The documents refuse it; the message is for people.
    Fault(FaultKind, String),
    /// It needs what the source of the program does not offer, or what this interpreter does not compute.
    Unsupported(String),
    /// The documents leave open what it does; the message is for people.
    Unspecified(String),
    /// More waits under cutter compensation than may.
    LimitExceeded(Limit),
    /// Its probe has moved and found nothing: what it did before stays.
    Missed,
    /// The sink aborted it: what it did before stays.
    Aborted,
}

impl Refusal {
    /// Whether the block has done nothing.
    pub(crate) fn undoes(&self) -> bool {
        !matches!(self, Self::Missed | Self::Aborted)
    }

    /// A refusal by the documents. It is cold: a program is refused once.
    #[cold]
    pub(crate) fn fault(kind: FaultKind, message: impl Into<String>) -> Self {
        Self::Fault(kind, message.into())
    }
}

/// Refuses the block.
#[cold]
pub(crate) fn refuse<T>(kind: FaultKind, message: impl Into<String>) -> Result<T, Refusal> {
    Err(Refusal::fault(kind, message))
}
