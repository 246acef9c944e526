//! Where a point of the program is on the machine.
//!
//! From the program outward: local offset (G52, G92), rotation about Z, origin of the coordinate system, tool offset.

use gaugeblock_vocabulary::{LengthUnit, Position};

use super::Modes;
use super::units::{converted, each};
use crate::math;

impl Modes {
    /// The machine position of a program point, active length unit.
    ///
    /// Rule offsets.local. A local offset is applied after the rotation of the coordinate system, so that it turns
    /// with it.
    pub fn machine_point(&self, program: Position) -> Position {
        let local = each(program, self.g92_offset, |point, offset| point + offset);
        let turned = turned(local, self.rotation);
        let on_machine = each(turned, self.g5x_offset, |point, offset| point + offset);
        let machine = each(on_machine, self.tool_offset, |point, offset| point + offset);
        self.rounding.of(machine, program)
    }

    /// The program point of a machine position, active length unit.
    pub fn program_point(&self, machine: Position) -> Position {
        let without_tool = each(machine, self.tool_offset, |point, offset| point - offset);
        let in_system = each(without_tool, self.g5x_offset, |point, offset| point - offset);
        let turned = turned(in_system, -self.rotation);
        let program = each(turned, self.g92_offset, |point, offset| point - offset);
        self.rounding.of(program, machine)
    }

    /// All that lies between a point of the program and one of the machine.
    pub(crate) fn frame(&self) -> impl PartialEq + use<> {
        (self.units, self.rotation, self.g5x_offset, self.g92_offset, self.tool_offset)
    }

    /// Rule offsets.stored. Origin and rotation of the selected coordinate system come from its ten parameters, which
    /// are in the machine's length unit.
    pub(crate) fn load_work_offset(&mut self, stored: impl Fn(u32) -> f64, unit: LengthUnit) {
        let first = first_parameter(self.work_offset);
        let origin = nine(|place| stored(first + place));
        self.g5x_offset = converted(origin, unit, self.units);
        self.rotation = stored(first + 9);
    }

    /// Rule offsets.local-parameters. #5211 to #5219 are the local offset unless #5210 is 0.
    pub(crate) fn load_local_offset(&mut self, stored: impl Fn(u32) -> f64, unit: LengthUnit) {
        let applies = stored(5210).abs() > 0.0;
        self.use_stored_offset(applies, stored, unit);
    }

    /// Takes over the local offset that the parameters hold, or none.
    pub(super) fn use_stored_offset(
        &mut self,
        applies: bool,
        stored: impl Fn(u32) -> f64,
        unit: LengthUnit,
    ) {
        self.local_applies = applies;
        let offset = if applies { nine(|place| stored(5211 + place)) } else { Position::default() };
        self.g92_offset = converted(offset, unit, self.units);
    }
}

/// The first of the ten parameters of a coordinate system, 1 to 9: #5221 for G54, #5241 for G55.
pub(crate) fn first_parameter(system: u32) -> u32 {
    5201 + 20 * system
}

/// Nine values by their place, from X.
fn nine(value: impl Fn(u32) -> f64) -> Position {
    let mut values = [0.0; 9];
    for (place, slot) in (0_u32..).zip(&mut values) {
        *slot = value(place);
    }
    Position::from(values)
}

/// A point turned about Z, degrees counterclockwise.
fn turned(point: Position, degrees: f64) -> Position {
    if degrees == 0.0 {
        return point;
    }
    let (sine, cosine) = (math::sine_of_degrees(degrees), math::cosine_of_degrees(degrees));
    Position { x: point.x * cosine - point.y * sine, y: point.x * sine + point.y * cosine, ..point }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Choices;
    use gaugeblock_vocabulary::Machine;

    fn modes() -> Modes {
        let stored = [(5221, 10.0), (5224, 5.0), (5230, 90.0)].into_iter().collect();
        let machine = Machine { parameters: stored, ..Machine::default() };
        let mut modes = Modes::new(&machine, &Choices::default());
        modes.tool_offset.z = 2.0;
        modes.g92_offset.x = 1.0;
        modes
    }

    fn close(a: Position, b: Position) {
        let apart = each(a, b, |a, b| (a - b).abs());
        assert!(apart.to_array().iter().all(|distance| *distance < 1e-9), "{a} {b}");
    }

    #[test]
    fn local_offset_rotation_origin_and_tool_offset_are_applied_in_this_order() {
        let program = Position { x: 3.0, y: 1.0, z: 7.0, ..Position::default() };
        let machine = Position { x: 10.0 - 1.0, y: 4.0, z: 9.0, a: 5.0, ..Position::default() };
        close(modes().machine_point(program), machine);
    }

    #[test]
    fn a_machine_point_is_the_inverse_of_a_program_point() {
        let program = Position { x: -3.0, y: 0.5, z: 7.0, c: 30.0, w: 1.0, ..Position::default() };
        close(modes().program_point(modes().machine_point(program)), program);
    }
}
