//! Lathe tools: which point of the tool follows the path.

use crate::rs274::planar::InPlane;
use crate::rs274::state::State;

/// Whether a number is that of an orientation whose point is not the centre of the tool.
pub(super) fn shifts(orientation: i32) -> bool {
    (1..=8).contains(&orientation)
}

/// How all points of a compensated path are shifted: along Z, along X, active length unit.
///
/// docs/compensation.md: orientations 1 to 8 under G18 shift all points by R·(X, Z).
fn shift(state: &State) -> InPlane {
    let (x, z) = match state.modes.compensation_orientation {
        1 => (-1.0, 1.0),
        2 => (-1.0, -1.0),
        3 => (1.0, -1.0),
        4 => (1.0, 1.0),
        5 => (0.0, 1.0),
        6 => (-1.0, 0.0),
        7 => (0.0, -1.0),
        8 => (1.0, 0.0),
        _ => (0.0, 0.0),
    };
    let radius = state.modes.compensation_radius.abs();
    (radius * z, radius * x)
}

/// A point of the plane as the machine goes to it.
pub(super) fn shifted(point: InPlane, state: &State) -> InPlane {
    let (first, second) = shift(state);
    (point.0 + first, point.1 + second)
}
