//! The rest of a block that may be more than a step does.

use super::super::snapshots::BlockSnapshot;
use super::drilling::Drilling;
use super::threading::Threading;

/// The kind of work.
#[derive(Clone, Copy, Debug)]
pub(super) enum Job {
    /// A canned cycle.
    Drilling(Drilling),
    /// G76.
    Threading(Threading),
    /// G70 to G72.2; the cycle is kept apart.
    Turning,
}

/// The rest of a block.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct PendingBlock {
    pub(super) line: u32,
    pub(super) job: Job,
    /// The code of group 4 that comes after the motion.
    pub(super) stop: Option<u16>,
    /// The state before the block, once a step has passed.
    pub(super) before: Option<BlockSnapshot>,
}
