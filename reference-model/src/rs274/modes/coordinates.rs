//! Where a point of the program is on the machine.
//!
//! From the program outward: local offset (G52, G92), rotation about Z, origin of the coordinate system, tool offset.

use gaugeblock_vocabulary::{Axis, LengthUnit, Position};

use super::Modes;
use crate::math;

/// Millimetres in a length unit.
pub fn unit_size(unit: LengthUnit) -> f64 {
    match unit {
        LengthUnit::Inch => 25.4,
        LengthUnit::Millimetre => 1.0,
    }
}

/// What becomes of the last bits of a coordinate that a conversion of units, an offset or a polar word has computed.
///
/// The documents do not say how exactly a controller computes, so that nothing can be said of a program whose meaning
/// depends on it: there the model's own answer changes with this.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rounding {
    /// They stay.
    #[default]
    AsComputed,
    /// The coordinate is the number of few decimals that it misses by its last bits, if it misses one.
    ToDecimals,
    /// It is larger by its last bit.
    Up,
    /// It is smaller by its last bit.
    Down,
}

impl Rounding {
    /// A position that was computed from another one; a coordinate that is as it was has no bits to lose.
    pub(crate) fn of(self, computed: Position, from: Position) -> Position {
        if self == Self::AsComputed {
            return computed;
        }
        each(computed, from, |computed, from| {
            if (computed - from).abs() > 0.0 { self.coordinate(computed, from) } else { computed }
        })
    }

    /// The distance and the angle of a polar point, of which either may have been computed from another point: each
    /// time they are moved on by more than the rounding error of a point, so that two points that may be one become
    /// different.
    pub(crate) fn of_polar(self, distance: f64, angle: f64) -> (f64, f64) {
        let part = match self {
            Self::AsComputed | Self::ToDecimals => return (distance, angle),
            Self::Up => 4.0 * f64::EPSILON,
            Self::Down => -4.0 * f64::EPSILON,
        };
        (distance + distance * part, angle + 360.0 * part)
    }

    /// A coordinate that is 0, or as small a number as nobody knows.
    pub(crate) fn of_nothing(self) -> f64 {
        match self {
            Self::AsComputed | Self::ToDecimals => 0.0,
            Self::Up => 1e-300,
            Self::Down => -1e-300,
        }
    }

    fn coordinate(self, computed: f64, from: f64) -> f64 {
        let last_bit = computed.abs().max(from.abs()) * f64::EPSILON;
        match self {
            Self::AsComputed => computed,
            Self::ToDecimals => {
                let decimals = (computed * 1e6).round() / 1e6;
                if (decimals - computed).abs() < 64.0 * last_bit { decimals } else { computed }
            }
            Self::Up => computed + last_bit,
            Self::Down => computed - last_bit,
        }
    }
}

/// Whether an axis counts in degrees.
pub(crate) fn is_rotary(axis: Axis) -> bool {
    matches!(axis, Axis::A | Axis::B | Axis::C)
}

/// Two positions, axis by axis.
pub(crate) fn each(a: Position, b: Position, value: impl Fn(f64, f64) -> f64) -> Position {
    let (a, b) = (a.to_array(), b.to_array());
    Position::from(std::array::from_fn::<f64, 9, _>(|place| value(a[place], b[place])))
}

/// A position in another length unit; degrees stay.
pub fn converted(position: Position, from: LengthUnit, to: LengthUnit) -> Position {
    if from == to {
        return position;
    }
    let mut converted = position;
    for axis in Axis::ALL.iter().copied().filter(|axis| !is_rotary(*axis)) {
        *converted.get_mut(axis) = position.get(axis) * unit_size(from) / unit_size(to);
    }
    converted
}

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
        self.local_applies = stored(5210).abs() > 0.0;
        let offset = if self.local_applies {
            nine(|place| stored(5211 + place))
        } else {
            Position::default()
        };
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

    #[test]
    fn only_what_was_computed_is_rounded() {
        let from = Position { x: 3.0, y: 2.0, z: 1.0, ..Position::default() };
        let computed = Position { x: 3.0, y: 0.1 + 0.2, z: 1.0 / 3.0, ..Position::default() };
        let moved = |rounding: Rounding| {
            let apart = each(rounding.of(computed, from), computed, |a, b| (a - b).abs());
            [apart.x, apart.y, apart.z].map(|distance| distance > 0.0)
        };
        assert_eq!(moved(Rounding::AsComputed), [false; 3]);
        assert_eq!(moved(Rounding::ToDecimals), [false, true, false]);
        assert_eq!(moved(Rounding::Up), [false, true, true]);
        assert_eq!(moved(Rounding::Down), [false, true, true]);
    }

    #[test]
    fn degrees_are_no_lengths() {
        let inches = Position { x: 1.0, b: 90.0, ..Position::default() };
        let millimetres = Position { x: 25.4, b: 90.0, ..Position::default() };
        close(converted(inches, LengthUnit::Inch, LengthUnit::Millimetre), millimetres);
        close(converted(millimetres, LengthUnit::Millimetre, LengthUnit::Inch), inches);
    }
}
