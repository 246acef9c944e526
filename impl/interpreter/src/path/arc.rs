//! Arcs and helices in machine coordinates (11.5.5).

use super::frame::Frame;
use super::{MOTION_MIN, Plane};
use crate::math;
use gaugeblock_planner::{Axes, Path};

impl Frame {
    /// The arc from where the point is, machine coordinates, to a point of the program about a centre in the selected
    /// plane. Turns are positive counterclockwise; an arc that ends where it begins goes once around for each.
    pub(super) fn arc(&self, at: &Axes, end: Axes, centre: (f64, f64), turns: i32) -> Path {
        let [x, y, z, ..] = end;
        let (first, second) = centre;
        // The centre lies in the plane of the end; whatever a helix climbs is along the normal.
        let (centre, normal, along) = match self.plane() {
            Plane::Xy | Plane::Uv => ([first, second, z], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]),
            Plane::Zx | Plane::Wu => ([second, y, first], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
            Plane::Yz | Plane::Vw => ([x, first, second], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        };
        let mut point = end;
        let [at_x, at_y, at_z, ..] = &mut point;
        [*at_x, *at_y, *at_z] = centre;
        let [x, y, z, ..] = self.machine_of(point);
        let centre = [x, y, z];
        let (normal, along) = (self.direction_of(normal), self.direction_of(along));
        let across = cross(normal, along);
        let end = self.machine_of(end);
        let from = in_plane(at, centre, along, across);
        let to = in_plane(&end, centre, along, across);
        Path::Arc { end, centre, normal, angle: angle(from, to, turns) }
    }
}

/// Radians from one point of a plane to another about the origin: counterclockwise where the turns are positive, and
/// a whole turn more for each above one.
fn angle(from: (f64, f64), to: (f64, f64), turns: i32) -> f64 {
    const TURN: f64 = core::f64::consts::TAU;
    let whole = TURN * f64::from(turns.unsigned_abs().saturating_sub(1));
    let way = math::hypotenuse(to.0 - from.0, to.1 - from.1);
    let part = if way <= MOTION_MIN {
        TURN
    } else {
        let turned = from.0 * to.1 - from.1 * to.0;
        let facing = from.0 * to.0 + from.1 * to.1;
        let counterclockwise = math::arctangent(turned, facing).to_radians();
        let wanted = if turns < 0 { -counterclockwise } else { counterclockwise };
        if wanted > 0.0 { wanted } else { wanted + TURN }
    };
    if turns < 0 { -(part + whole) } else { part + whole }
}

/// The coordinates of a point in a plane through a centre, along two directions of it.
fn in_plane(point: &Axes, centre: [f64; 3], along: [f64; 3], across: [f64; 3]) -> (f64, f64) {
    let [x, y, z, ..] = point;
    let [centre_x, centre_y, centre_z] = centre;
    let from = [x - centre_x, y - centre_y, z - centre_z];
    (dot(from, along), dot(from, across))
}

fn dot([x, y, z]: [f64; 3], [u, v, w]: [f64; 3]) -> f64 {
    x * u + y * v + z * w
}

fn cross([x, y, z]: [f64; 3], [u, v, w]: [f64; 3]) -> [f64; 3] {
    [y * w - z * v, z * u - x * w, x * v - y * u]
}
