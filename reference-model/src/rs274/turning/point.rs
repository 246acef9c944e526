//! Points of the plane of a lathe cycle, and the axes in which the cycle looks at them.

use crate::math;

/// A point, or a displacement.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Point {
    /// Along the travel axis; Z as a profile is read.
    pub(crate) w: f64,
    /// Along the depth axis; X as a profile is read, a radius.
    pub(crate) u: f64,
}

impl Point {
    /// The displacement to another point.
    pub(super) fn to(self, other: Self) -> Self {
        Self { w: other.w - self.w, u: other.u - self.u }
    }

    /// The point that is some times a displacement away.
    pub(super) fn plus(self, times: f64, way: Self) -> Self {
        Self { w: self.w + times * way.w, u: self.u + times * way.u }
    }

    /// The length of a displacement.
    pub(super) fn length(self) -> f64 {
        math::hypotenuse(self.w, self.u)
    }

    /// The distance from another point.
    pub(crate) fn distance(self, other: Self) -> f64 {
        self.to(other).length()
    }

    /// The displacement of length 1 in the same direction.
    pub(super) fn unit(self) -> Self {
        let length = self.length();
        Self { w: self.w / length, u: self.u / length }
    }

    /// A quarter turn to the left, from w towards u.
    pub(super) fn left(self) -> Self {
        Self { w: -self.u, u: self.w }
    }

    /// How far one displacement leads along another one of length 1.
    pub(super) fn along(self, other: Self) -> f64 {
        self.w * other.w + self.u * other.u
    }

    /// Positive if the other displacement turns left from this one, negative if it turns right.
    pub(crate) fn turn_to(self, other: Self) -> f64 {
        self.w * other.u - self.u * other.w
    }

    /// The point in the middle between two.
    pub(super) fn middle(self, other: Self) -> Self {
        Self { w: (self.w + other.w) / 2.0, u: (self.u + other.u) / 2.0 }
    }
}

/// The axes of a cycle: which axis is its travel axis, and in which direction each of both counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    /// Whether X is the travel axis and Z the depth axis.
    pub(crate) across: bool,
    /// 1 or -1: the sense in which w counts.
    pub(crate) travel: f64,
    /// 1 or -1: the sense in which u counts.
    pub(crate) depth: f64,
}

impl Frame {
    /// A point as the cycle looks at it.
    pub(crate) fn of(self, point: Point) -> Point {
        let Point { w, u } = if self.across { Point { w: point.u, u: point.w } } else { point };
        Point { w: self.travel * w, u: self.depth * u }
    }

    /// A point of the cycle as the profile is read: w is Z and u is X.
    pub(crate) fn read(self, point: Point) -> Point {
        let Point { w, u } = Point { w: self.travel * point.w, u: self.depth * point.u };
        if self.across { Point { w: u, u: w } } else { Point { w, u } }
    }

    /// 1 if a turn to the left is one to the left in the cycle, too, and -1 if it is one to the right.
    pub(crate) fn sense(self) -> f64 {
        let swapped = if self.across { -1.0 } else { 1.0 };
        swapped * self.travel * self.depth
    }
}
