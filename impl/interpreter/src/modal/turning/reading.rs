//! A profile as it is read.

use alloc::vec::Vec;

use gaugeblock_vocabulary::Motion;

use super::super::coordinates::Coordinates;
use super::super::vector::Vector;
use super::piece::Curve;

/// A move of a profile as it is written: Z, X.
#[derive(Clone, Copy, Debug)]
pub(super) struct ProfileMove {
    pub(super) to: Vector,
    pub(super) curve: Curve,
    pub(super) corner: Corner,
}

/// What a move has at its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Corner {
    Sharp,
    /// A: a fillet of this radius.
    Fillet(f64),
    /// C: the chord of such a fillet.
    Chamfer(f64),
}

/// A profile that is read.
#[derive(Clone, Debug)]
pub(super) struct Reading {
    /// Where the last move ends: Z, X.
    pub(super) here: Vector,
    /// Where the tool is, if the position follows the moves.
    pub(super) tool: Option<Coordinates>,
    /// The motion mode within the sub.
    pub(super) motion: Motion,
    pub(super) moves: Vec<ProfileMove>,
}

impl Reading {
    /// A profile before its first block.
    pub(super) fn new(start: Vector) -> Self {
        Self { here: start, tool: None, motion: Motion::Feed, moves: Vec::new() }
    }
}
