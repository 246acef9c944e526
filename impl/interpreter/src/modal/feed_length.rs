//! The length of a feed move, by which F of inverse time becomes a feed rate per minute.

use gaugeblock_vocabulary::{Effect, Plane, Position};

use crate::math;

use super::coordinates::Coordinates;

/// The length of a feed move from a point, active unit; none for other effects.
pub(super) fn feed_length(start: Coordinates, effect: &Effect, plane: Plane) -> Option<f64> {
    if let Effect::StraightFeed { end } = effect {
        return Some(straight(start.position(), *end));
    }
    let Effect::ArcFeed { end, first_centre, second_centre, turns } = effect else { return None };
    let in_plane = |point: Position| match plane {
        Plane::Zx => [point.z, point.x, point.y],
        Plane::Yz => [point.y, point.z, point.x],
        Plane::Xy | Plane::Uv | Plane::Wu | Plane::Vw => [point.x, point.y, point.z],
    };
    let ends = [in_plane(start.position()), in_plane(*end)];
    Some(helix(ends, [*first_centre, *second_centre], *turns))
}

/// The length of X, Y and Z, where they do not move of U, V and W, where those do not, either, of A, B and C.
fn straight(start: Position, end: Position) -> f64 {
    let length = |x: f64, y: f64, z: f64| math::hypotenuse(math::hypotenuse(x, y), z);
    let linear = length(end.x - start.x, end.y - start.y, end.z - start.z);
    let parallel = length(end.u - start.u, end.v - start.v, end.w - start.w);
    let rotary = length(end.a - start.a, end.b - start.b, end.c - start.c);
    if linear > 0.0 {
        linear
    } else if parallel > 0.0 {
        parallel
    } else {
        rotary
    }
}

/// The length of a helix, from its ends and its centre; negative turns are clockwise.
fn helix([start, end]: [[f64; 3]; 2], [first, second]: [f64; 2], turns: i32) -> f64 {
    let [start_first, start_second, start_along] = start;
    let [end_first, end_second, end_along] = end;
    let from = math::angle(start_second - second, start_first - first);
    let to = math::angle(end_second - second, end_first - first);
    let forward = if turns < 0 { from - to } else { to - from };
    let part = if forward > 0.0 { forward } else { forward + core::f64::consts::TAU };
    let whole = f64::from(turns.unsigned_abs().saturating_sub(1)) * core::f64::consts::TAU;
    let radius = math::hypotenuse(start_first - first, start_second - second);
    math::hypotenuse(radius * (part + whole), end_along - start_along)
}
