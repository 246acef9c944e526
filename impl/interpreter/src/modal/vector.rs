//! Points and directions in a plane.

use crate::math;

use super::coordinates::Conversion;

/// A point or a distance in a plane: along its first axis and along its second.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Vector {
    pub(super) p: f64,
    pub(super) q: f64,
}

impl Vector {
    pub(super) fn plus(self, other: Self) -> Self {
        Self { p: self.p + other.p, q: self.q + other.q }
    }

    pub(super) fn minus(self, other: Self) -> Self {
        Self { p: self.p - other.p, q: self.q - other.q }
    }

    pub(super) fn times(self, factor: f64) -> Self {
        Self { p: self.p * factor, q: self.q * factor }
    }

    pub(super) fn dot(self, other: Self) -> f64 {
        self.p * other.p + self.q * other.q
    }

    pub(super) fn cross(self, other: Self) -> f64 {
        self.p * other.q - self.q * other.p
    }

    pub(super) fn length(self) -> f64 {
        math::hypotenuse_of_any_size(self.p, self.q)
    }

    /// The same direction with length 1; not a number where it has none.
    pub(super) fn unit(self) -> Self {
        let length = self.length();
        Self { p: self.p / length, q: self.q / length }
    }

    /// Turned by 90 degrees, counterclockwise where `sense` is 1 and clockwise where it is -1.
    pub(super) fn quarter(self, sense: f64) -> Self {
        Self { p: -self.q * sense, q: self.p * sense }
    }

    /// The angle to another direction, radians from -pi to pi, positive counterclockwise.
    pub(super) fn angle_to(self, other: Self) -> f64 {
        math::angle(self.cross(other), self.dot(other))
    }

    pub(super) fn is_zero(self) -> bool {
        self.p == 0.0 && self.q == 0.0
    }

    pub(super) fn is_finite(self) -> bool {
        self.p.is_finite() && self.q.is_finite()
    }

    /// Lengths in another unit.
    pub(super) fn converted(self, by: Conversion) -> Self {
        Self { p: by.of(self.p), q: by.of(self.q) }
    }
}
