//! From program coordinates to those of the machine: units, rotation, offsets.

use super::{LengthUnit, Plane, Settings};
use crate::math;
use crate::modal::{Coordinates, Modes};
use gaugeblock_planner::Axes;

/// Millimetres in an inch.
const INCH: f64 = 25.4;

/// The transformation from program to machine coordinates.
#[derive(Clone, Debug, Default)]
pub(super) struct Frame {
    /// Units, offsets, rotation and plane of these alone are kept.
    modes: Modes,
}

impl Frame {
    pub(super) fn set(&mut self, changed: &Settings) {
        let modes = &mut self.modes;
        modes.units = changed.units.unwrap_or(modes.units);
        modes.plane = changed.plane.unwrap_or(modes.plane);
        modes.rotation = changed.rotation.unwrap_or(modes.rotation);
        let offsets = [
            (&mut modes.g5x_offset, changed.g5x_offset),
            (&mut modes.g92_offset, changed.g92_offset),
            (&mut modes.tool_offset, changed.tool_offset),
        ];
        for (offset, change) in offsets {
            *offset = change.map_or(*offset, Coordinates::from);
        }
    }

    /// The plane in which arcs lie.
    pub(super) fn plane(&self) -> Plane {
        self.modes.plane
    }

    /// A length in the active unit.
    pub(super) fn millimetres(&self, length: f64) -> f64 {
        match self.modes.units {
            LengthUnit::Inch => length * INCH,
            LengthUnit::Millimetre => length,
        }
    }

    /// A point of the program, in machine coordinates.
    pub(super) fn machine_of(&self, program: Axes) -> Axes {
        let Coordinates([x, y, z, a, b, c, u, v, w]) = self.modes.machine_of(Coordinates(program));
        let [x, y, z, u, v, w] = [x, y, z, u, v, w].map(|length| self.millimetres(length));
        [x, y, z, a, b, c, u, v, w]
    }

    /// A direction of the program, in machine coordinates: only the rotation about Z counts.
    pub(super) fn direction_of(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let (sine, cosine) = math::direction(self.modes.rotation);
        [x * cosine - y * sine, x * sine + y * cosine, z]
    }
}
