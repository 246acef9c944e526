//! Geometry in the plane of compensation: the programmed curve of a move, and the one at a distance of R from it.

use crate::quirks;

use super::super::coordinates::Conversion;
use super::super::vector::Vector;

/// The cutter of the compensation in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) struct Cutter {
    /// R, active length unit: half of the diameter, without its sign.
    pub(super) radius: f64,
    /// s: 1 with the cutter on the left of the path, -1 on the right. A negative diameter changes it (NIST B.4).
    pub(super) side: f64,
    /// 0 to 9; 0 and 9 shift nothing.
    pub(super) orientation: u8,
    /// Whether normals are computed from angles.
    by_angles: bool,
}

/// A move in the plane, as programmed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    /// P.
    pub(super) from: Vector,
    /// Q.
    pub(super) to: Vector,
    pub(super) curve: Curve,
}

/// The curve of a move.
#[derive(Clone, Copy, Debug)]
pub(super) enum Curve {
    /// A straight line.
    Line {
        /// Its direction, of length 1.
        direction: Vector,
    },
    /// A part of a circle.
    Arc(Arc),
}

/// The circle of a compensated arc.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circle {
    pub(super) centre: Vector,
    /// r.
    pub(super) radius: f64,
    /// k: 1 with the centre of the programmed arc on the cutter's side, or else -1.
    pub(super) bend: f64,
}

/// An arc.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    pub(super) centre: Vector,
    /// g: 1 counterclockwise, -1 clockwise.
    pub(super) sense: f64,
    /// u0: from the centre to the start, of length 1.
    pub(super) to_start: Vector,
    /// u1: from the centre to the end, of length 1.
    pub(super) to_end: Vector,
    /// The distance of the end from the centre.
    pub(super) radius: f64,
}

impl Cutter {
    /// No cutter: its radius is zero.
    pub(in super::super) const NONE: Self =
        Self { radius: 0.0, side: 1.0, orientation: 0, by_angles: false };

    /// The cutter of a diameter, active length unit.
    pub(super) fn new(diameter: f64, is_left: bool, orientation: u8) -> Self {
        let side = if is_left == (diameter >= 0.0) { 1.0 } else { -1.0 };
        Self { radius: diameter.abs() / 2.0, side, orientation, by_angles: false }
    }

    /// Whether it moves anything.
    pub(in super::super) fn has_radius(&self) -> bool {
        self.radius > 0.0
    }

    /// Whether it is the same cutter, apart from what conversions of units have changed.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let difference = (self.radius - other.radius).abs();
        self.side * other.side > 0.0
            && self.orientation == other.orientation
            && difference <= 1e-9 * self.radius
    }

    /// As `rs274` computes with it: the last bits of angles decide the sign of a zero.
    pub(super) fn emulating_rs274(self) -> Self {
        Self { by_angles: true, ..self }
    }

    /// With its radius in another length unit.
    pub(in super::super) fn converted(self, by: Conversion) -> Self {
        Self { radius: by.of(self.radius), ..self }
    }

    /// The vector that the orientation adds to all points, in the coordinates of ZX.
    pub(super) fn shift(&self) -> Vector {
        let (x, z) = match self.orientation {
            1 => (-1.0, 1.0),
            2 => (-1.0, -1.0),
            3 => (1.0, -1.0),
            4 => (1.0, 1.0),
            5 => (0.0, 1.0),
            6 => (-1.0, 0.0),
            7 => (0.0, -1.0),
            8 => (1.0, 0.0),
            _ => return Vector::default(),
        };
        Vector { p: z * self.radius, q: x * self.radius }
    }

    /// The normal of an arc on the cutter's side, R long, from an angle: towards the centre or away from it.
    fn radial(&self, arc: &Arc, from_centre: Vector) -> Vector {
        let Vector { p, q } = from_centre.times(-arc.bend(self));
        let [p, q] = quirks::direction([p, q]);
        Vector { p, q }.times(self.radius)
    }

    /// The normal of a direction on the cutter's side, R long.
    fn offset(&self, direction: Vector) -> Vector {
        if self.by_angles {
            let [p, q] = quirks::normal([direction.p, direction.q], self.side > 0.0);
            return Vector { p, q }.times(self.radius);
        }
        direction.quarter(self.side).times(self.radius)
    }
}

impl Circle {
    /// Lengths in another unit.
    pub(super) fn converted(self, by: Conversion) -> Self {
        Self { centre: self.centre.converted(by), radius: by.of(self.radius), ..self }
    }
}

impl Arc {
    /// k: 1 with the centre on the cutter's side, or else -1.
    pub(super) fn bend(&self, cutter: &Cutter) -> f64 {
        self.sense * cutter.side
    }

    /// r: the radius of the compensated arc.
    pub(super) fn offset_radius(&self, cutter: &Cutter) -> f64 {
        self.radius - self.bend(cutter) * cutter.radius
    }

    /// The angle in the arc's own sense from one direction to another, radians from 0 up to a full turn.
    pub(super) fn sweep(&self, from: Vector, to: Vector) -> f64 {
        let angle = self.sense * from.angle_to(to);
        if angle < 0.0 { angle + core::f64::consts::TAU } else { angle }
    }
}

impl Segment {
    /// A straight move between two points that differ.
    pub(super) fn line(from: Vector, to: Vector) -> Self {
        Self { from, to, curve: Curve::Line { direction: to.minus(from).unit() } }
    }

    /// An arc.
    pub(super) fn arc(from: Vector, to: Vector, centre: Vector, sense: f64) -> Self {
        let radius = to.minus(centre).length();
        let (to_start, to_end) = (from.minus(centre).unit(), to.minus(centre).unit());
        Self { from, to, curve: Curve::Arc(Arc { centre, sense, to_start, to_end, radius }) }
    }

    /// Its arc, if it is one.
    pub(super) fn as_arc(&self) -> Option<&Arc> {
        match &self.curve {
            Curve::Arc(arc) => Some(arc),
            Curve::Line { .. } => None,
        }
    }

    /// The circle of its compensated curve, if it is an arc.
    pub(super) fn circle(&self, cutter: &Cutter) -> Option<Circle> {
        let arc = self.as_arc()?;
        let (radius, bend) = (arc.offset_radius(cutter), arc.bend(cutter));
        Some(Circle { centre: arc.centre, radius, bend })
    }

    /// Its direction where it starts.
    pub(super) fn start_direction(&self) -> Vector {
        match &self.curve {
            Curve::Line { direction } => *direction,
            Curve::Arc(arc) => arc.to_start.quarter(arc.sense),
        }
    }

    /// Its direction where it ends.
    pub(super) fn end_direction(&self) -> Vector {
        match &self.curve {
            Curve::Line { direction } => *direction,
            Curve::Arc(arc) => arc.to_end.quarter(arc.sense),
        }
    }

    /// Where its compensated curve starts.
    pub(super) fn offset_start(&self, cutter: &Cutter) -> Vector {
        if let (Some(arc), true) = (self.as_arc(), cutter.by_angles) {
            return self.from.plus(cutter.radial(arc, arc.to_start));
        }
        self.from.plus(cutter.offset(self.start_direction()))
    }

    /// Where its compensated curve ends.
    pub(super) fn offset_end(&self, cutter: &Cutter) -> Vector {
        if let (Some(arc), true) = (self.as_arc(), cutter.by_angles) {
            return self.to.plus(cutter.radial(arc, arc.to_end));
        }
        self.to.plus(cutter.offset(self.end_direction()))
    }

    /// Converts lengths to another unit.
    pub(super) fn convert(&mut self, by: Conversion) {
        self.from = self.from.converted(by);
        self.to = self.to.converted(by);
        if let Curve::Arc(arc) = &mut self.curve {
            arc.centre = arc.centre.converted(by);
            arc.radius = by.of(arc.radius);
        }
    }
}
