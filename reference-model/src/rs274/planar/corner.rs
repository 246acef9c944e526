//! The corner between two compensated moves.

use super::leg::{Curve, Cutter, Leg};
use super::{Crossing, InPlane, Line, along, angle, away, quarter_turn};
use crate::math;

/// What a corner makes of the two moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Corner {
    /// The move ends where its own curve does, and the next one starts there.
    Tangent,
    /// The move ends at the intersection of both curves; none if they have none.
    Inner(Option<InPlane>),
    /// The curves touch within rounding: whether they meet is open.
    Touching,
    /// A joining move leads from the end of one curve to the start of the next.
    Outer,
}

/// The angle, radians, up to which a corner is tangent.
const TANGENT: f64 = 0.05;

/// The corner between two moves.
///
/// docs/compensation.md, "Moves, corners": t is the angle from the end tangent of a move to the start tangent of the
/// next, positive toward the tool. `slack` is added to it, radians.
pub(crate) fn corner(before: &Leg, next: &Leg, cutter: Cutter, slack: f64) -> Corner {
    let turn = cutter.side * angle(before.arrives, next.leaves) + slack;
    let turn = if turn < -TANGENT { turn + math::TURN } else { turn };
    let inside = inside(next).or(inside(before)).unwrap_or(1.0);
    if turn <= TANGENT {
        Corner::Tangent
    } else if turn <= math::TURN / 2.0 - inside * TANGENT {
        if touch(before, next) {
            return Corner::Touching;
        }
        Corner::Inner(intersection(before, next, cutter))
    } else {
        Corner::Outer
    }
}

/// k of an arc.
fn inside(leg: &Leg) -> Option<f64> {
    match leg.curve {
        Curve::Straight(_) => None,
        Curve::Round { inside, .. } => Some(inside),
    }
}

/// Whether the curves of a line and an arc, or of two arcs, touch.
fn touch(before: &Leg, next: &Leg) -> bool {
    match (before.curve, next.curve) {
        (Curve::Straight(_), Curve::Straight(_)) => false,
        (Curve::Straight(line), Curve::Round { circle, .. })
        | (Curve::Round { circle, .. }, Curve::Straight(line)) => line.touches(circle),
        (Curve::Round { circle: first, .. }, Curve::Round { circle: second, .. }) => {
            first.touches(second)
        }
    }
}

/// The point at which the curves of two moves cross.
fn intersection(before: &Leg, next: &Leg, cutter: Cutter) -> Option<InPlane> {
    match (before.curve, next.curve) {
        (Curve::Straight(first), Curve::Straight(second)) => {
            Some(of_parallels(first, second, cutter))
        }
        (Curve::Straight(line), Curve::Round { circle, inside, .. }) => {
            let which = if inside > 0.0 { Crossing::Second } else { Crossing::First };
            line.crosses(circle, which)
        }
        (Curve::Round { circle, inside, .. }, Curve::Straight(line)) => {
            let which = if inside > 0.0 { Crossing::First } else { Crossing::Second };
            line.crosses(circle, which)
        }
        (
            Curve::Round { circle: first, inside: of_first, .. },
            Curve::Round { circle: second, inside: of_second, .. },
        ) => first.crosses(second, cutter.side * of_first * of_second > 0.0),
    }
}

/// The intersection of the parallels to two lines that meet in a point, from the end of the first one.
///
/// From the corner it is R (n0 + n1) / (1 + n0 · n1) away: R along n0, and R tan(t / 2) backward along the first
/// line.
fn of_parallels(first: Line, second: Line, cutter: Cutter) -> InPlane {
    let normal = |line: Line| quarter_turn(line.direction, cutter.side);
    let (one, other) = (normal(first), normal(second));
    let corner = away(first.point, -cutter.radius, one);
    let portion = cutter.radius / (1.0 + along(one, other));
    away(corner, portion, (one.0 + other.0, one.1 + other.1))
}
