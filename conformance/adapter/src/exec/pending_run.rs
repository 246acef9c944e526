//! Runs that were asked for and are not answered yet.

use std::thread::ThreadId;

use gaugeblock_vocabulary::{Scenario, Step};

/// A run that was asked for and not answered yet.
#[derive(Debug)]
pub(super) struct PendingRun {
    /// What of the request is still to be written.
    pub(super) unsent: Vec<u8>,
    /// Whether a digest will do for an answer.
    pub(super) accepts_digest: bool,
    pub(super) received: ReceivedSoFar,
}

/// A run that was asked for ahead.
#[derive(Debug)]
pub(super) struct PrefetchedRun {
    /// Who asked.
    pub(super) thread: ThreadId,
    pub(super) scenario: Scenario,
    pub(super) pending: PendingRun,
}

/// What came before the answer proper.
#[derive(Debug, Default)]
pub(super) struct ReceivedSoFar {
    pub(super) steps: Vec<Step>,
    /// Batches that may still come.
    pub(super) credit: u32,
    /// Operator's events that were told by now.
    pub(super) operator_events_sent: usize,
}
