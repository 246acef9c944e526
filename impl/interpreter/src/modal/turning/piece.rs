//! Pieces of a profile: lines and arcs in a plane. Where it matters the first coordinate grows in the direction of
//! travel, and the second one grows out of the work.

use core::f64::consts::{PI, TAU};

use crate::math;

use super::super::vector::Vector;

/// Angles and coordinates that differ by less are equal: rounding.
pub(super) const ROUNDING: f64 = 1e-9;

/// A piece of a profile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) from: Vector,
    pub(super) to: Vector,
    pub(super) curve: Curve,
}

/// The curve of a piece.
#[derive(Clone, Copy, Debug)]
pub(super) enum Curve {
    Line,
    /// A line of G0. Only a planted fault distinguishes it from other lines.
    Traverse,
    Arc(Arc),
}

/// The circle of an arc.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    pub(super) centre: Vector,
    /// 1 counterclockwise, -1 clockwise.
    pub(super) sense: f64,
}

impl Piece {
    pub(super) fn line(from: Vector, to: Vector) -> Self {
        Self { from, to, curve: Curve::Line }
    }

    pub(super) fn chord(&self) -> f64 {
        self.to.minus(self.from).length()
    }

    /// Its arc, where it is one.
    pub(super) fn as_arc(&self) -> Option<Arc> {
        match self.curve {
            Curve::Arc(arc) => Some(arc),
            Curve::Line | Curve::Traverse => None,
        }
    }

    /// Whether it is an arc whose radius does not reach its end.
    pub(super) fn has_no_circle(&self) -> bool {
        self.as_arc().is_some_and(|arc| arc.centre.p.is_nan())
    }

    /// The radius of an arc.
    pub(super) fn radius(&self) -> Option<f64> {
        self.as_arc().map(|arc| self.from.minus(arc.centre).length())
    }

    /// The direction at the start, of length 1.
    pub(super) fn start_direction(&self) -> Vector {
        self.direction_at(self.from)
    }

    /// The direction at the end, of length 1.
    pub(super) fn end_direction(&self) -> Vector {
        self.direction_at(self.to)
    }

    fn direction_at(&self, point: Vector) -> Vector {
        match self.curve {
            Curve::Line | Curve::Traverse => self.to.minus(self.from).unit(),
            Curve::Arc(arc) => point.minus(arc.centre).unit().quarter(arc.sense),
        }
    }

    /// The same piece with its points moved; `flip` is -1 where that turns the plane over.
    pub(super) fn mapped(&self, map: impl Fn(Vector) -> Vector, flip: f64) -> Self {
        let curve = match self.curve {
            Curve::Line | Curve::Traverse => self.curve,
            Curve::Arc(arc) => Curve::Arc(Arc { centre: map(arc.centre), sense: arc.sense * flip }),
        };
        Self { from: map(self.from), to: map(self.to), curve }
    }

    /// Whether it never runs against the direction of travel.
    pub(super) fn travels(&self) -> bool {
        if self.to.p < self.from.p - ROUNDING {
            return false;
        }
        let Curve::Arc(arc) = self.curve else { return true };
        let forward = |point: Vector| -arc.sense * (point.q - arc.centre.q) >= -1e-6;
        forward(self.from) && forward(self.to) && self.sweep() <= PI + 1e-3
    }

    /// The angle of an arc from its start to its end: radians, above 0 up to a full turn.
    pub(super) fn sweep(&self) -> f64 {
        let Curve::Arc(arc) = self.curve else { return 0.0 };
        let angle = self.from.minus(arc.centre).angle_to(self.to.minus(arc.centre)) * arc.sense;
        if angle <= ROUNDING { angle + TAU } else { angle }
    }

    /// The point at which an arc is deepest or highest, if that is inside of it; the arc never runs against travel.
    fn turning_point(&self) -> Option<Vector> {
        let arc = self.as_arc()?;
        let is_inside =
            self.from.p < arc.centre.p - ROUNDING && arc.centre.p < self.to.p - ROUNDING;
        let depth = arc.centre.q - arc.sense * self.radius()?;
        is_inside.then_some(Vector { p: arc.centre.p, q: depth })
    }

    /// The highest point, if it is inside of the piece.
    pub(super) fn highest_inside(&self) -> Option<Vector> {
        self.turning_point().filter(|_| self.as_arc().is_some_and(|arc| arc.sense < 0.0))
    }

    /// The lowest point, if it is inside of the piece.
    pub(super) fn lowest_inside(&self) -> Option<Vector> {
        self.turning_point().filter(|_| self.as_arc().is_some_and(|arc| arc.sense > 0.0))
    }

    /// The least depth of it; its highest point is not inside of it.
    pub(super) fn lowest(&self) -> f64 {
        let ends = self.from.q.min(self.to.q);
        self.lowest_inside().map_or(ends, |point| ends.min(point.q))
    }

    /// Whether it sinks below its start.
    pub(super) fn falls(&self) -> bool {
        self.lowest() < self.from.q
    }

    /// The point of its falling half at a depth from that of its start down to its least one.
    pub(super) fn falling_at(&self, depth: f64) -> Vector {
        if depth >= self.from.q {
            return self.from;
        }
        match self.curve {
            Curve::Line | Curve::Traverse => self.on_line(depth),
            Curve::Arc(arc) => self.on_arc(arc, depth, -arc.sense),
        }
    }

    /// The point of its rising half at a depth, where it has one.
    pub(super) fn rising_at(&self, depth: f64) -> Option<Vector> {
        let rises_from = if self.falls() {
            if self.to.q <= self.lowest() {
                return None;
            }
            self.lowest()
        } else {
            self.from.q
        };
        if !(rises_from..=self.to.q).contains(&depth) {
            return None;
        }
        if !self.falls() && depth <= self.from.q {
            return Some(self.from);
        }
        if depth >= self.to.q {
            return Some(self.to);
        }
        Some(match self.curve {
            Curve::Line | Curve::Traverse => self.on_line(depth),
            Curve::Arc(arc) => self.on_arc(arc, depth, arc.sense),
        })
    }

    fn on_line(&self, depth: f64) -> Vector {
        let share = (depth - self.from.q) / (self.to.q - self.from.q);
        Vector { p: self.from.p + (self.to.p - self.from.p) * share, q: depth }
    }

    /// The point of a circle at a depth: in travel direction from its centre where `side` is 1, or against it where
    /// that is -1.
    fn on_arc(&self, arc: Arc, depth: f64, side: f64) -> Vector {
        let radius = self.radius().unwrap_or(0.0);
        let height = depth - arc.centre.q;
        let half = math::sqrt(((radius - height) * (radius + height)).max(0.0));
        Vector { p: arc.centre.p + side * half, q: depth }
    }
}
