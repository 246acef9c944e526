//! From program coordinates to the machine's: settings as an outcome records them.

use gaugeblock_vocabulary::{Axis, LengthUnit, Plane, Position, Settings};

use crate::math;
use crate::motion::vector::{AxisVector, last_place};

/// Millimetres of the active length unit; a millimetre where no unit was recorded.
pub(super) fn unit(settings: &Settings) -> f64 {
    match settings.units {
        Some(LengthUnit::Inch) => 25.4,
        Some(LengthUnit::Millimetre) | None => 1.0,
    }
}

/// Where a program point is on the machine, millimetres and degrees.
///
/// Rule offsets.local. From the program outward: the offset of G52 and G92, the rotation about Z, the origin of the
/// coordinate system, the tool offset. What was not recorded is zero.
pub(super) fn on_machine(program: Position, settings: &Settings) -> Position {
    let nine = |offset: Option<Position>| offset.unwrap_or_default().to_array();
    let local = nine(settings.g92_offset);
    let (origin, tool) = (nine(settings.g5x_offset), nine(settings.tool_offset));
    let program = program.to_array();
    let mut point: AxisVector = std::array::from_fn(|axis| program[axis] + local[axis]);
    let [x, y] = turned([point[0], point[1]], settings.rotation.unwrap_or(0.0));
    (point[0], point[1]) = (x, y);
    let mut machine = Position::default();
    for axis in Axis::ALL.iter().copied() {
        let place = axis.place();
        let rotary = matches!(axis, Axis::A | Axis::B | Axis::C);
        let size = if rotary { 1.0 } else { unit(settings) };
        *machine.get_mut(axis) = (point[place] + origin[place] + tool[place]) * size;
    }
    machine
}

fn turned([x, y]: [f64; 2], degrees: f64) -> [f64; 2] {
    if degrees == 0.0 {
        return [x, y];
    }
    let (sine, cosine) = (math::sine_of_degrees(degrees), math::cosine_of_degrees(degrees));
    [x * cosine - y * sine, x * sine + y * cosine]
}

/// The point `after`. An axis that differs from `before` only by the rounding of offsets keeps its old coordinate.
///
/// Without this, an axis that no word moves would move by a last digit whenever an offset changes.
pub(super) fn settled(before: Position, after: Position) -> Position {
    let mut settled = after;
    for axis in Axis::ALL.iter().copied() {
        let (old, new) = (before.get(axis), after.get(axis));
        if (new - old).abs() <= 64.0 * last_place(old.abs().max(1.0)) {
            *settled.get_mut(axis) = old;
        }
    }
    settled
}

/// First and second axis of a plane that has arcs.
///
/// Rule arcs.plane. XY, ZX or YZ; the third axis is the one that an arc goes about.
pub(super) fn axes(plane: Plane) -> Option<(Axis, Axis)> {
    match plane {
        Plane::Xy => Some((Axis::X, Axis::Y)),
        Plane::Zx => Some((Axis::Z, Axis::X)),
        Plane::Yz => Some((Axis::Y, Axis::Z)),
        Plane::Uv | Plane::Wu | Plane::Vw => None,
    }
}

/// The direction of the normal axis of a plane, in machine coordinates. It rotates with the coordinate system.
pub(super) fn normal(plane: Plane, settings: &Settings) -> [f64; 3] {
    let degrees = settings.rotation.unwrap_or(0.0);
    let in_xy = |x: f64, y: f64| {
        let [x, y] = turned([x, y], degrees);
        [x, y, 0.0]
    };
    match plane {
        Plane::Xy | Plane::Uv => [0.0, 0.0, 1.0],
        Plane::Zx | Plane::Wu => in_xy(0.0, 1.0),
        Plane::Yz | Plane::Vw => in_xy(1.0, 0.0),
    }
}
