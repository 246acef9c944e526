//! A lathe cycle in numbers: its words, and its profile.

use alloc::vec::Vec;

use super::super::vector::Vector;
use super::frame::Frame;
use super::piece::Piece;

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
    /// Whether two lines in one direction keep their common end at a distance.
    pub(super) joins_parallels: bool,
}
