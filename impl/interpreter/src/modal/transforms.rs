//! Coordinate systems (11.1): from program coordinates to those of the machine and back.
//!
//! machine = rotation(program + G92) + G5x + tool: the offset of G52 and G92 applies in the rotated coordinate system
//! (11.1.4.1, 11.5.14).

use crate::faults::{PlantedFault, planted};
use crate::math;

use super::coordinates::Coordinates;
use super::letters::{X, Y};
use super::modes::Modes;

impl Modes {
    fn turn(&self, degrees: f64) -> Option<(f64, f64)> {
        if self.rotation.abs() > 0.0 {
            let degrees = if planted(PlantedFault::RotationReversed) { -degrees } else { degrees };
            Some((math::sine(degrees), math::cosine(degrees)))
        } else {
            None
        }
    }

    /// Program coordinates with the offset of G92, in the directions of the machine.
    fn turned_of(&self, program: Coordinates) -> Coordinates {
        if planted(PlantedFault::LocalUnturned) {
            let turned = self.turn(self.rotation).map_or(program, |turn| program.turned(turn));
            return turned.plus(self.g92_offset);
        }
        let local = program.plus(self.g92_offset);
        self.turn(self.rotation).map_or(local, |turn| local.turned(turn))
    }

    /// Program coordinates in those of the machine.
    pub(crate) fn machine_of(&self, program: Coordinates) -> Coordinates {
        self.turned_of(program).plus(self.g5x_offset).plus(self.tool_offset)
    }

    /// Machine coordinates in those of the program.
    pub(crate) fn program_of(&self, machine: Coordinates) -> Coordinates {
        let turned = machine.minus(self.tool_offset).minus(self.g5x_offset);
        if planted(PlantedFault::LocalUnturned) {
            let near = turned.minus(self.g92_offset);
            return self.turn(-self.rotation).map_or(near, |turn| near.turned(turn));
        }
        let local = self.turn(-self.rotation).map_or(turned, |turn| turned.turned(turn));
        local.minus(self.g92_offset)
    }

    /// The origin that gives a machine position these program coordinates.
    pub(crate) fn origin_for(&self, machine: Coordinates, program: Coordinates) -> Coordinates {
        machine.minus(self.tool_offset).minus(self.turned_of(program))
    }

    /// The axes whose program coordinates change when the machine's axes of `letters` move, and the reverse: in a
    /// rotated coordinate system X and Y change together.
    pub(super) fn letters_moved_together(&self, letters: u32) -> u32 {
        let together = self.rotation.abs() > 0.0 && letters & (X | Y) != 0;
        if together { letters | X | Y } else { letters }
    }
}
