//! A programmed path as points of a drawing.

use gaugeblock_vocabulary::motion::{ProgrammedPath, Shape};

/// How far one goes about an arc between two points, degrees.
const ARC_STEP_DEGREES: f64 = 3.0;

/// X, Y and Z of points along a path, so close that arcs look round. Of a spline only the end is known.
pub fn polyline(path: &ProgrammedPath) -> Vec<[f64; 3]> {
    let mut points = vec![[path.start.x, path.start.y, path.start.z]];
    for element in &path.elements {
        let Some(end) = element.end() else { continue };
        let end = [end.x, end.y, end.z];
        if let Shape::Arc { centre, normal, angle, .. } = &element.shape {
            let start = points.last().copied().unwrap_or(end);
            let steps = (angle.abs() / ARC_STEP_DEGREES).ceil().clamp(1.0, 100_000.0);
            let mut step = 1.0;
            while step < steps {
                points.push(on_arc((start, end), *centre, *normal, *angle, step / steps));
                step += 1.0;
            }
        }
        points.push(end);
    }
    points
}

/// A point of an arc after a share of it. Distance from the axis and place along it change evenly.
fn on_arc(
    (start, end): ([f64; 3], [f64; 3]),
    centre: [f64; 3],
    normal: [f64; 3],
    angle: f64,
    share: f64,
) -> [f64; 3] {
    let split = |point: [f64; 3]| {
        let from = [0, 1, 2].map(|axis| point[axis] - centre[axis]);
        let along = dot(from, normal);
        (along, [0, 1, 2].map(|axis| from[axis] - along * normal[axis]))
    };
    let ((first, out), (last, to)) = (split(start), split(end));
    let (radius, final_radius) = (libm::sqrt(dot(out, out)), libm::sqrt(dot(to, to)));
    let scale = if radius > 0.0 { 1.0 + (final_radius / radius - 1.0) * share } else { 0.0 };
    let along = first + (last - first) * share;
    let turned = angle.to_radians() * share;
    let (sine, cosine) = (libm::sin(turned), libm::cos(turned));
    let across = [
        normal[1] * out[2] - normal[2] * out[1],
        normal[2] * out[0] - normal[0] * out[2],
        normal[0] * out[1] - normal[1] * out[0],
    ];
    [0, 1, 2].map(|axis| {
        let around = (out[axis] * cosine + across[axis] * sine) * scale;
        centre[axis] + along * normal[axis] + around
    })
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
