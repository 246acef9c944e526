//! A lathe cycle under way.

use alloc::vec::Vec;

use super::finishing::Finishing;
use super::frame::Frame;
use super::numbers::{Contour, Cycle};
use super::offset::Offset;
use super::reading::Reading;
use super::roughing::Roughing;

/// What a cycle needs from the control side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ProfileStage {
    /// A call of the sub of this number.
    Call(f64),
    /// The blocks of the sub.
    Blocks,
}

/// How far a cycle has come.
#[derive(Clone, Debug)]
pub(super) enum Stage {
    /// The sub has to be called, or is being read.
    Profile(ProfileStage),
    /// The profile is complete.
    Read,
    /// G70.
    Finishing(Finishing),
    /// The offset of a roughing cycle.
    Offset(Offset),
    /// G71 and G72.
    Roughing(Roughing),
}

/// A cycle under way.
#[derive(Clone, Debug)]
pub(in super::super) struct Turning {
    pub(super) cycle: Cycle,
    pub(super) stage: Stage,
    /// The moves of the sub.
    pub(super) reading: Reading,
    pub(super) contour: Contour,
}

impl Turning {
    /// A cycle before its profile is read.
    pub(super) fn new(cycle: Cycle, number: f64) -> Self {
        Self {
            cycle,
            stage: Stage::Profile(ProfileStage::Call(number)),
            reading: Reading::new(cycle.start),
            contour: Contour {
                frame: Frame::unturned(false),
                start: cycle.start,
                pieces: Vec::new(),
                side: None,
                joins_parallels: true,
            },
        }
    }
}
