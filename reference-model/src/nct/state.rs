//! The state of a run.

use gaugeblock_vocabulary::scenario::Machine;

use super::frames::{Frame, ModalCall};
use super::modes::Modes;
use super::programs::Programs;
use super::record::Record;
use super::variables::Variables;
use crate::{Choices, RuleCoverage};

/// A program that runs.
pub(super) struct Run<'a> {
    pub(super) programs: &'a Programs,
    pub(super) choices: Choices,
    pub(super) coverage: &'a mut RuleCoverage,
    pub(super) variables: Variables,
    /// The modal calls in force, the one that was commanded last at the end.
    pub(super) modal_calls: Vec<ModalCall>,
    /// The programs in progress, the main program first.
    pub(super) frames: Vec<Frame>,
    /// Turns of the main program, this one included.
    pub(super) turns: u32,
    pub(super) modes: Modes,
    pub(super) machine: &'a Machine,
    pub(super) record: Record,
    /// Where a fault would be.
    pub(super) at: u32,
}

/// What comes after a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flow {
    /// The next one.
    On,
    /// Nothing: the program has ended.
    Ended,
    /// The main program would begin again.
    Endless,
}
