//! The geometry of compensated moves in the selected plane: lines, circles, their crossings.

mod corner;
mod leg;

use crate::math;

pub(crate) use corner::{Corner, corner};
pub(crate) use leg::{Curve, Cutter, Leg, ProgrammedArc};

/// A point of the selected plane: along its first axis, along its second.
pub(crate) type InPlane = (f64, f64);

/// A direction of length 1, or a displacement.
pub(crate) type Vector = (f64, f64);

/// The vector from one point to another.
pub(crate) fn between(from: InPlane, to: InPlane) -> Vector {
    (to.0 - from.0, to.1 - from.1)
}

/// The length of a vector.
pub(crate) fn length(vector: Vector) -> f64 {
    math::hypotenuse(vector.0, vector.1)
}

/// The direction of a vector that has a length.
pub(crate) fn direction(vector: Vector) -> Vector {
    let length = length(vector);
    (vector.0 / length, vector.1 / length)
}

/// A vector turned counterclockwise by 90 degrees for 1, clockwise for -1.
pub(crate) fn quarter_turn(vector: Vector, sense: f64) -> Vector {
    (-sense * vector.1, sense * vector.0)
}

/// The scalar product.
pub(crate) fn along(one: Vector, other: Vector) -> f64 {
    one.0 * other.0 + one.1 * other.1
}

/// The cross product: positive where the other vector leads to the left.
pub(crate) fn across(one: Vector, other: Vector) -> f64 {
    one.0 * other.1 - one.1 * other.0
}

/// The point that is so many times a vector away from another.
pub(crate) fn away(from: InPlane, by: f64, vector: Vector) -> InPlane {
    (from.0 + by * vector.0, from.1 + by * vector.1)
}

/// The angle from one vector to another, counterclockwise, radians above -pi up to pi.
pub(crate) fn angle(from: Vector, to: Vector) -> f64 {
    math::angle(across(from, to), along(from, to))
}

/// The angle from one vector to another in a sense, radians from 0 to 2 pi.
pub(crate) fn sweep(from: Vector, to: Vector, sense: f64) -> f64 {
    let angle = sense * angle(from, to);
    if angle < 0.0 { angle + math::TURN } else { angle }
}

/// A line without ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Line {
    /// A point on it.
    pub(crate) point: InPlane,
    /// Its direction, of length 1.
    pub(crate) direction: Vector,
}

/// A circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Circle {
    pub(crate) centre: InPlane,
    pub(crate) radius: f64,
}

/// Which of two crossings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Crossing {
    /// The first along the line.
    First,
    /// The second along the line.
    Second,
}

/// Lengths that differ by less than this share are equal within rounding.
const ROUNDING: f64 = 1e-9;

impl Line {
    /// Whether it touches a circle within rounding, so that rounding decides whether they meet.
    pub(crate) fn touches(self, circle: Circle) -> bool {
        let distance = across(self.direction, between(self.point, circle.centre)).abs();
        (distance - circle.radius).abs() <= ROUNDING * circle.radius
    }

    /// Where it crosses a circle, if it does.
    pub(crate) fn crosses(self, circle: Circle, which: Crossing) -> Option<InPlane> {
        let to_centre = between(self.point, circle.centre);
        let nearest = along(to_centre, self.direction);
        let distance = across(self.direction, to_centre).abs();
        if distance > circle.radius {
            return None;
        }
        let half = math::other_leg(circle.radius, distance);
        let from_point = match which {
            Crossing::First => nearest - half,
            Crossing::Second => nearest + half,
        };
        Some(away(self.point, from_point, self.direction))
    }
}

impl Circle {
    /// Whether it touches another circle within rounding, so that rounding decides whether they meet.
    pub(crate) fn touches(self, other: Self) -> bool {
        let apart = length(between(self.centre, other.centre));
        let sum = self.radius + other.radius;
        let beside = |reach: f64| (apart - reach).abs() <= ROUNDING * sum;
        beside(sum) || beside((self.radius - other.radius).abs())
    }

    /// Where it crosses another circle: the crossing on the left of the way from its centre to the other one's, or the
    /// one on the right.
    pub(crate) fn crosses(self, other: Self, on_left: bool) -> Option<InPlane> {
        let way = between(self.centre, other.centre);
        let apart = length(way);
        let nearest =
            ((self.radius - other.radius) * (self.radius + other.radius) / apart + apart) / 2.0;
        if !nearest.is_finite() || nearest.abs() > self.radius {
            return None;
        }
        let way = direction(way);
        let half = math::other_leg(self.radius, nearest.abs());
        let sideways = quarter_turn(way, if on_left { 1.0 } else { -1.0 });
        Some(away(away(self.centre, nearest, way), half, sideways))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_crosses_a_circle_twice_or_not_at_all() {
        let circle = Circle { centre: (1.0, 2.0), radius: 5.0 };
        let line = |height| Line { point: (7.0, height), direction: (-1.0, 0.0) };
        assert_eq!(line(5.0).crosses(circle, Crossing::First), Some((5.0, 5.0)));
        assert_eq!(line(5.0).crosses(circle, Crossing::Second), Some((-3.0, 5.0)));
        assert_eq!(line(8.0).crosses(circle, Crossing::First), None);
        assert!(line(7.0).touches(circle) && !line(6.999).touches(circle));
        let other = |x| Circle { centre: (x, 2.0), radius: 2.0 };
        assert!(circle.touches(other(8.0)) && circle.touches(other(4.0)));
        assert!(!circle.touches(other(7.9)) && !circle.touches(other(3.9)));
    }

    #[test]
    fn two_circles_cross_on_both_sides_of_their_centres() {
        let one = Circle { centre: (0.0, 0.0), radius: 5.0 };
        let other = Circle { centre: (6.0, 0.0), radius: 5.0 };
        assert_eq!(one.crosses(other, true), Some((3.0, 4.0)));
        assert_eq!(one.crosses(other, false), Some((3.0, -4.0)));
        assert_eq!(one.crosses(Circle { centre: (6.0, 0.0), radius: 0.5 }, true), None);
        assert_eq!(one.crosses(Circle { centre: (0.0, 0.0), radius: 4.0 }, true), None);
        assert_eq!(one.crosses(one, true), None);
    }

    #[test]
    fn a_sweep_is_positive_in_its_sense() {
        let quarter = math::TURN / 4.0;
        assert!((sweep((1.0, 0.0), (0.0, 1.0), 1.0) - quarter).abs() < 1e-12);
        assert!((sweep((1.0, 0.0), (0.0, 1.0), -1.0) - 3.0 * quarter).abs() < 1e-12);
        assert_eq!(sweep((1.0, 0.0), (1.0, 0.0), 1.0).to_bits(), 0.0_f64.to_bits());
    }
}
