//! Arcs on the machine.

use gaugeblock_vocabulary::motion::Shape;
use gaugeblock_vocabulary::{Axis, Effect, Plane, Position, Settings};

use super::frame::{axes, normal, on_machine, settled};
use crate::math;

/// An arc whose end is less than this angle from its start, degrees, is a full circle.
const SAME_DIRECTION: f64 = 1e-7;

/// The shape of an arc in machine coordinates, from the position `here`.
///
/// Rules arcs.direction, arcs.turns and arcs.full-circle. The sign of the turns is the direction, seen from the
/// positive end of the normal axis; each turn after the first is a full circle; ends that coincide
/// are a full circle too.
pub(super) fn shape(here: Position, effect: &Effect, settings: &Settings) -> Shape {
    let Effect::ArcFeed { end: program_end, first_centre, second_centre, turns } = effect else {
        return Shape::Curve { end: here };
    };
    let end = settled(here, on_machine(*program_end, settings));
    let plane = settings.plane.unwrap_or(Plane::Xy);
    let Some((first, second)) = axes(plane) else { return Shape::Curve { end } };
    let mut centre = *program_end;
    *centre.get_mut(first) = *first_centre;
    *centre.get_mut(second) = *second_centre;
    let [x, y, z, ..] = on_machine(centre, settings).to_array();
    let (centre, normal) = ([x, y, z], normal(plane, settings));
    let Some(angle) = angle(here, end, centre, normal) else { return Shape::Curve { end } };
    let more = f64::from(turns.unsigned_abs().saturating_sub(1)) * 360.0;
    let angle = if *turns < 0 {
        -(less_than_a_turn(-angle) + more)
    } else {
        less_than_a_turn(angle) + more
    };
    Shape::Arc { end, centre, normal, angle }
}

/// The angle, above 0 up to 360, that leads the same way.
fn less_than_a_turn(angle: f64) -> f64 {
    let positive = angle.rem_euclid(360.0);
    let coincides = !(SAME_DIRECTION..=360.0 - SAME_DIRECTION).contains(&positive);
    if coincides { 360.0 } else { positive }
}

/// The angle in degrees from one point to another about an axis; `None` for a point on the axis.
fn angle(from: Position, to: Position, centre: [f64; 3], normal: [f64; 3]) -> Option<f64> {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let outward = |point: Position| -> [f64; 3] {
        let at = [point.get(Axis::X), point.get(Axis::Y), point.get(Axis::Z)];
        let away: [f64; 3] = std::array::from_fn(|axis| at[axis] - centre[axis]);
        let height = dot(away, normal);
        std::array::from_fn(|axis| away[axis] - normal[axis] * height)
    };
    let (from, to) = (outward(from), outward(to));
    let cross = [
        from[1] * to[2] - from[2] * to[1],
        from[2] * to[0] - from[0] * to[2],
        from[0] * to[1] - from[1] * to[0],
    ];
    let is_point = |vector: [f64; 3]| dot(vector, vector) == 0.0;
    if is_point(from) || is_point(to) {
        return None;
    }
    Some(math::degrees_of(dot(cross, normal), dot(from, to)))
}
