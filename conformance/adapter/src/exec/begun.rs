//! Runs that were asked for and are not answered yet.

use std::thread::ThreadId;

use gaugeblock_vocabulary::{Scenario, Step};

/// A run that was asked for and not answered yet.
#[derive(Debug)]
pub(super) struct Asked {
    /// What of the request is still to be written.
    pub(super) unsent: Vec<u8>,
    /// Whether a digest will do for an answer.
    pub(super) by_digest: bool,
    pub(super) before: Before,
}

/// A run that was asked for ahead.
#[derive(Debug)]
pub(super) struct Begun {
    /// Who asked.
    pub(super) by: ThreadId,
    pub(super) scenario: Scenario,
    pub(super) asked: Asked,
}

/// What came before the answer proper.
#[derive(Debug, Default)]
pub(super) struct Before {
    pub(super) steps: Vec<Step>,
    /// Batches that may still come.
    pub(super) credit: u32,
    /// Operator's events that were told by now.
    pub(super) told: usize,
}
