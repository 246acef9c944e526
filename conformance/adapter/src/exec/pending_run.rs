//! Runs that were requested, and what has been received of their answers.
//!
//! PROTOCOL.md describes digests (extension `digest`) and batches with their credit (extension `stream`).

use std::thread::ThreadId;

use gaugeblock_vocabulary::{Scenario, Step};

/// A run that was requested and is not answered yet.
#[derive(Debug)]
pub(super) struct PendingRun {
    /// The part of the request that is not yet written.
    pub(super) unsent: Vec<u8>,
    /// Whether the adapter may answer with a digest of the outcome instead of the outcome.
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
    /// How many batches of steps the adapter may still send before it needs new credit.
    pub(super) credit: u32,
    /// Operator's events that were sent.
    pub(super) operator_events_sent: usize,
}
