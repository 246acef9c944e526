//! A lathe cycle under way.

use alloc::vec::Vec;

use super::super::vector::Vector;
use super::finishing::Finishing;
use super::frame::Frame;
use super::offset::Offset;
use super::piece::Piece;
use super::profile_words::Reading;
use super::roughing::Roughing;

/// A cycle in numbers. Lengths are radial, in the active unit.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Cycle {
    pub(super) kind: Kind,
    /// A: where the tool is before the profile; Z, X.
    pub(super) start: Vector,
}

/// Which cycle.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    /// G70.
    Finishing {
        /// D.
        from: f64,
        /// E.
        to: f64,
        /// P.
        passes: f64,
    },
    /// G71 and G72.
    Roughing {
        /// Whether the tool travels along X.
        faces: bool,
        pockets: Pockets,
        /// D.
        distance: f64,
        /// I.
        increment: f64,
        /// R.
        retract: f64,
    },
}

/// What a roughing cycle does with pockets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pockets {
    /// It cuts them: G71 and G72.
    Cut,
    /// It leaves them: G71.1 and G72.1.
    Left,
    /// It cuts only them: G71.2 and G72.2.
    Alone,
}

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

/// The profile as the cycle uses it: (travel, depth).
#[derive(Clone, Debug)]
pub(super) struct Contour {
    pub(super) frame: Frame,
    /// A.
    pub(super) start: Vector,
    /// The pieces after the lead.
    pub(super) pieces: Vec<Piece>,
    /// 1 where an offset is to the left of the direction of travel, -1 where it is to the right; none where that is
    /// open.
    pub(super) side: Option<f64>,
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
            },
        }
    }
}
