//! A piece of a profile: a line or an arc.

use super::ROUNDING;
use super::point::{Frame, Point};
use crate::math;

/// A move of a profile from one point to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    pub(crate) start: Point,
    pub(crate) end: Point,
    pub(crate) curve: Curve,
}

/// The form of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Curve {
    /// Straight.
    Line,
    /// An arc whose radius does not reach its end. It is never cut.
    NoCircle,
    /// Round.
    Arc {
        centre: Point,
        /// 1 for a turn to the left, from w towards u, and -1 for one to the right.
        sense: f64,
    },
}

/// Whether two values are nearly equal, and not equal.
pub(crate) fn is_tied(one: f64, other: f64) -> bool {
    let apart = (one - other).abs();
    apart > 0.0 && apart <= ROUNDING
}

impl Piece {
    /// The distance from the start to the end.
    pub(crate) fn chord(&self) -> f64 {
        self.start.distance(self.end)
    }

    /// The same piece in the axes of a cycle.
    pub(crate) fn within(&self, frame: Frame) -> Self {
        let curve = match self.curve {
            Curve::Line | Curve::NoCircle => self.curve,
            Curve::Arc { centre, sense } => {
                Curve::Arc { centre: frame.of(centre), sense: sense * frame.sense() }
            }
        };
        Self { start: frame.of(self.start), end: frame.of(self.end), curve }
    }

    /// The direction of the piece at its start.
    pub(crate) fn leaves(&self) -> Point {
        self.direction_at(self.start)
    }

    /// The direction of the piece at its end.
    pub(super) fn arrives(&self) -> Point {
        self.direction_at(self.end)
    }

    fn direction_at(&self, point: Point) -> Point {
        match self.curve {
            Curve::Line | Curve::NoCircle => self.start.to(self.end).unit(),
            Curve::Arc { centre, sense } => {
                let left = centre.to(point).unit().left();
                Point { w: sense * left.w, u: sense * left.u }
            }
        }
    }

    /// How far around its centre an arc leads, radians: more than 0 and up to a full turn. Zero for a line.
    pub(super) fn sweep(&self) -> f64 {
        self.sweep_to(self.end)
    }

    /// How far around its centre the arc leads on its way to a point in this direction.
    fn sweep_to(&self, point: Point) -> f64 {
        let Curve::Arc { centre, sense } = self.curve else { return 0.0 };
        let (from, to) = (centre.to(self.start), centre.to(point));
        let turned = sense * math::angle(from.turn_to(to), from.w * to.w + from.u * to.u);
        if turned < 0.0 { turned + math::TURN } else { turned }
    }

    /// The point of the circle of an arc in a direction, if it is between the ends of the arc.
    fn inside(&self, towards: Point) -> Option<Point> {
        let Curve::Arc { centre, .. } = self.curve else { return None };
        let point = centre.plus(centre.distance(self.start), towards);
        let is_end = [self.start, self.end].iter().any(|end| end.distance(point) <= ROUNDING);
        (!is_end && self.sweep_to(point) < self.sweep()).then_some(point)
    }

    /// The points, besides both ends, where the piece reaches furthest along the travel axis, back and forth.
    pub(super) fn furthest_inside(&self) -> impl Iterator<Item = Point> + use<> {
        let ways = [Point { w: 1.0, u: 0.0 }, Point { w: -1.0, u: 0.0 }];
        ways.map(|way| self.inside(way)).into_iter().flatten()
    }

    /// The highest point of an arc, if it is between its ends.
    pub(crate) fn highest_inside(&self) -> Option<Point> {
        self.inside(Point { w: 0.0, u: 1.0 })
    }

    /// The depth of its lowest point.
    pub(crate) fn lowest(&self) -> f64 {
        let ends = self.start.u.min(self.end.u);
        self.inside(Point { w: 0.0, u: -1.0 }).map_or(ends, |lowest| lowest.u.min(ends))
    }

    /// Whether it is an arc whose lowest point is between its ends.
    pub(crate) fn is_lowest_inside(&self) -> bool {
        self.inside(Point { w: 0.0, u: -1.0 }).is_some()
    }

    /// Whether it sinks below its start somewhere, by more than rounding. All others rise.
    pub(crate) fn falls(&self) -> bool {
        self.lowest() < self.start.u - ROUNDING
    }

    /// Whether it is an arc that starts at the highest point of its circle.
    pub(crate) fn starts_at_top(&self) -> bool {
        let Curve::Arc { centre, .. } = self.curve else { return false };
        (self.start.w - centre.w).abs() <= ROUNDING && self.start.u > centre.u
    }

    /// Its part up to one of its points, and the rest.
    pub(crate) fn split(&self, point: Point) -> (Self, Self) {
        (Self { end: point, ..*self }, Self { start: point, ..*self })
    }

    /// The point of a falling piece, on its way down, that has a depth between those of its start and its lowest point.
    pub(crate) fn sinking_at(&self, depth: f64) -> Point {
        match self.curve {
            Curve::Line | Curve::NoCircle => self.on_line(depth),
            Curve::Arc { .. } => self.on_circle(depth, self.start, -1.0),
        }
    }

    /// The point on its way up that has a depth, if there is one. An end whose depth differs by rounding has it.
    pub(crate) fn rising_at(&self, depth: f64) -> Option<Point> {
        let is_at = |end: Point| (depth - end.u).abs() <= ROUNDING;
        if !self.falls() && is_at(self.start) {
            return Some(self.start);
        }
        let from = self.lowest();
        if self.end.u <= from + ROUNDING || depth < from {
            return None;
        }
        if is_at(self.end) {
            return Some(self.end);
        }
        (depth < self.end.u).then(|| match self.curve {
            Curve::Line | Curve::NoCircle => self.on_line(depth),
            Curve::Arc { .. } => self.on_circle(depth, self.end, 1.0),
        })
    }

    /// The point of a line that has a depth. The ends are exact.
    fn on_line(&self, depth: f64) -> Point {
        if depth >= self.start.u.max(self.end.u) || depth <= self.start.u.min(self.end.u) {
            let at_start = (depth - self.start.u).abs() < (depth - self.end.u).abs();
            return if at_start { self.start } else { self.end };
        }
        let part = (depth - self.start.u) / (self.end.u - self.start.u);
        Point { w: self.start.w + part * (self.end.w - self.start.w), u: depth }
    }

    /// The point of an arc's circle that has a depth, where the arc moves towards greater depths if `way` is 1 and
    /// towards smaller ones if it is -1. An end of this depth is exact.
    fn on_circle(&self, depth: f64, end: Point, way: f64) -> Point {
        let Curve::Arc { centre, sense } = self.curve else { return end };
        if (depth - end.u).abs() <= 0.0 {
            return end;
        }
        let half = math::other_leg(centre.distance(end), (depth - centre.u).abs());
        Point { w: centre.w + way * sense * half, u: depth }
    }
}
