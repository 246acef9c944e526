//! The contour along which the cutter is compensated.

use gaugeblock_vocabulary::{LengthUnit, Position};

use crate::rs274::modes::{Rounding, converted, unit_size};
use crate::rs274::planar::Leg;

/// What compensated moves leave for the next move.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contour {
    /// The compensated moves since G41 or G42; none before the entry, and none after G40.
    pub(crate) path: Option<CompensatedPath>,
    /// The end of compensation that no move has led away from yet.
    pub(crate) exit: Option<Exit>,
}

/// What G40 leaves for the move that leads away from a compensated path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exit {
    /// The diameter of the tool, active length unit; positive.
    pub(crate) diameter: f64,
    /// Along X, Y and Z from the programmed point to where the tool is, active length unit.
    pub(crate) tool: [f64; 3],
    /// The rotation of the coordinates at the G40, degrees.
    pub(crate) rotation: f64,
}

/// Compensated moves from the entry on.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CompensatedPath {
    /// The programmed point, active length unit and degrees.
    pub(crate) programmed: Position,
    /// The last move in the plane.
    pub(crate) last: Leg,
    /// Whether its end waits for the next one.
    pub(crate) waits: bool,
}

impl Contour {
    /// Whether a move waits for the next one.
    pub(crate) fn waits(&self) -> bool {
        self.path.as_ref().is_some_and(|path| path.waits)
    }

    /// Converts the contour to another length unit.
    pub(crate) fn convert(&mut self, from: LengthUnit, to: LengthUnit, rounding: Rounding) {
        if let Some(path) = &mut self.path {
            path.programmed = rounding.of(converted(path.programmed, from, to), path.programmed);
            path.last = path.last.scaled(unit_size(from) / unit_size(to));
        }
        if let Some(exit) = &mut self.exit {
            let factor = unit_size(from) / unit_size(to);
            exit.diameter *= factor;
            exit.tool = exit.tool.map(|distance| distance * factor);
        }
    }
}
