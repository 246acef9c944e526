//! Runs whose answers are still to come.

use std::thread::ThreadId;

use gaugeblock_vocabulary::{Scenario, Step};

/// A run that was requested and is not answered yet.
#[derive(Debug)]
pub(super) struct PendingRun {
    /// The part of the request that is not yet written.
    pub(super) unsent: Vec<u8>,
    /// Whether the answer may be a digest.
    pub(super) accepts_digest: bool,
    pub(super) received: ReceivedSoFar,
}

/// A run that was requested before a caller needs it.
#[derive(Debug)]
pub(super) struct PrefetchedRun {
    /// The thread that requested it.
    pub(super) thread: ThreadId,
    pub(super) scenario: Scenario,
    pub(super) pending: PendingRun,
}

/// What has been received of the answer.
#[derive(Debug, Default)]
pub(super) struct ReceivedSoFar {
    pub(super) steps: Vec<Step>,
    /// Batches that may still come.
    pub(super) credit: u32,
    /// Operator's events that were sent.
    pub(super) operator_events_sent: usize,
}
