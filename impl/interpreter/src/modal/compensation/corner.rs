//! The corner between two compensated moves: which kind it is, where both curves cross, and whether the cutter fits.

use core::f64::consts::{PI, TAU};

use gaugeblock_vocabulary::FaultKind;

use super::super::refusal::{Refusal, refuse};
use super::LastMove;
use super::plane::{Arc, Curve, Cutter, Segment, Vector};

/// A corner is tangent up to this angle, radians.
const TANGENT: f64 = 0.05;
/// An arc may come out longer by this than it is programmed, radians.
const LONGER: f64 = 0.001;
/// Angles below this are rounding, radians.
const ROUNDING: f64 = 1e-9;

/// The kind of a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Corner {
    /// The path goes straight on.
    Tangent,
    /// The path turns towards the cutter: both curves are cut off where they cross.
    Inner,
    /// The path turns away from the cutter: a joining move leads round.
    Outer,
}

impl Corner {
    /// The corner between a move and the next one.
    pub(super) fn between(before: &Segment, next: &Segment, cutter: &Cutter) -> Self {
        let turn = before.end_direction().angle_to(next.start_direction()) * cutter.side;
        let turn = if turn < -TANGENT { turn + TAU } else { turn };
        let arc = next.as_arc().or_else(|| before.as_arc());
        let bend = arc.map_or(1.0, |arc| arc.bend(cutter));
        if turn <= TANGENT {
            Self::Tangent
        } else if turn < PI - bend * TANGENT {
            Self::Inner
        } else {
            Self::Outer
        }
    }
}

/// Where the compensated curves of two moves cross at an inner corner.
pub(super) fn intersection(
    before: &Segment,
    next: &Segment,
    cutter: &Cutter,
) -> Result<Vector, Refusal> {
    let crossing = match (&before.curve, &next.curve) {
        (Curve::Line { direction }, Curve::Line { direction: second }) => {
            let sum = direction.plus(*second).quarter(cutter.side);
            let scale = cutter.radius / (1.0 + direction.dot(*second));
            Some(next.from.plus(sum.times(scale)))
        }
        (Curve::Line { direction }, Curve::Arc(arc)) => {
            line_and_circle(before.offset_end(cutter), *direction, arc, cutter, 1.0)
        }
        (Curve::Arc(arc), Curve::Line { direction }) => {
            line_and_circle(next.offset_start(cutter), *direction, arc, cutter, -1.0)
        }
        (Curve::Arc(arc), Curve::Arc(second)) => two_circles(arc, second, cutter),
    };
    match crossing.filter(|point| point.is_finite()) {
        Some(point) => Ok(point),
        None => refuse(FaultKind::Gouging, "the compensated paths at a corner do not cross"),
    }
}

/// Where a line through `point` crosses a compensated arc. Of two crossings it is the later one along the line where
/// the centre is on the cutter's side and `order` is 1, or neither of both.
fn line_and_circle(
    point: Vector,
    direction: Vector,
    arc: &Arc,
    cutter: &Cutter,
    order: f64,
) -> Option<Vector> {
    let radius = arc.offset_radius(cutter);
    let to_centre = arc.centre.minus(point);
    let along = to_centre.dot(direction);
    let aside = to_centre.minus(direction.times(along)).length();
    let square = (radius - aside) * (radius + aside);
    let half_chord = (square >= 0.0).then(|| crate::math::sqrt(square))?;
    Some(point.plus(direction.times(along + half_chord * order * arc.bend(cutter))))
}

/// Where two compensated arcs cross: on the left of the way between their centres, or on the right.
fn two_circles(first: &Arc, second: &Arc, cutter: &Cutter) -> Option<Vector> {
    let way = second.centre.minus(first.centre);
    let distance = way.length();
    let (radius, other) = (first.offset_radius(cutter), second.offset_radius(cutter));
    let along = (distance + (radius - other) * (radius + other) / distance) / 2.0;
    let square = (radius - along) * (radius + along);
    let height = (square >= 0.0).then(|| crate::math::sqrt(square))?;
    let left = cutter.side * first.bend(cutter) * second.bend(cutter);
    let direction = way.unit();
    Some(first.centre.plus(direction.times(along)).plus(direction.quarter(left).times(height)))
}

impl LastMove {
    /// Refuses the move if the corner before it has left nothing of it, where it ends at `end`. The entry is not
    /// checked.
    pub(super) fn check_fit(&self, end: Vector) -> Result<(), Refusal> {
        let fits = self.is_entry
            || match &self.segment.curve {
                Curve::Line { direction } => {
                    end.minus(self.start).dot(*direction) >= -self.rounding()
                }
                Curve::Arc(arc) => {
                    let programmed = match arc.sweep(arc.to_start, arc.to_end) {
                        sweep if sweep < ROUNDING => TAU,
                        sweep => sweep,
                    };
                    let sweep = arc.sweep(self.start.minus(arc.centre), end.minus(arc.centre));
                    sweep <= programmed + LONGER || sweep > TAU - ROUNDING
                }
            };
        if fits {
            return Ok(());
        }
        refuse(FaultKind::Gouging, "the cutter does not fit between two inner corners")
    }

    /// A length that is rounding at these coordinates.
    fn rounding(&self) -> f64 {
        let largest = self.start.p.abs().max(self.start.q.abs()).max(1.0);
        largest * 1e-14
    }
}
