//! The corner between two compensated moves: which kind it is, where both curves cross, and whether the cutter fits.

use core::f64::consts::{PI, TAU};

use gaugeblock_vocabulary::FaultKind;

use crate::faults::{PlantedFault, planted};
use crate::math;

use super::super::refusal::{Refusal, refuse};
use super::super::vector::Vector;
use super::path::LastMove;
use super::plane::{Circle, Curve, Cutter, Segment};

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
        let is_mitred = arc.is_none() && planted(PlantedFault::OutsideCornerMitred);
        if turn <= TANGENT {
            Self::Tangent
        } else if turn < PI - bend * TANGENT {
            if planted(PlantedFault::InsideCornerToEnd) { Self::Tangent } else { Self::Inner }
        } else if is_mitred {
            Self::Inner
        } else {
            Self::Outer
        }
    }
}

/// Where the compensated curves of two moves cross at an inner corner.
pub(super) fn intersection(
    before: &LastMove,
    next: &Segment,
    cutter: &Cutter,
) -> Result<Vector, Refusal> {
    let (direction, second) = (before.segment.end_direction(), next.start_direction());
    let crossing = match (&before.circle, next.circle(cutter)) {
        (None, None) => {
            let scale = cutter.radius / (1.0 + direction.dot(second));
            Some(next.from.plus(direction.plus(second).quarter(cutter.side).times(scale)))
        }
        (None, Some(circle)) => {
            let point = before.segment.offset_end(cutter);
            line_and_circle(point, direction, &circle, circle.bend)
        }
        (Some(circle), None) => {
            line_and_circle(next.offset_start(cutter), second, circle, -circle.bend)
        }
        (Some(circle), Some(other)) => two_circles(circle, &other, cutter.side),
    };
    match crossing.filter(|point| point.is_finite()) {
        Some(point) => Ok(point),
        None => refuse(FaultKind::Gouging, "the compensated paths at a corner do not cross"),
    }
}

/// Where a line through `point` crosses a circle: the later one of both crossings along the line where `order` is 1,
/// the earlier one where it is -1.
fn line_and_circle(
    point: Vector,
    direction: Vector,
    circle: &Circle,
    order: f64,
) -> Option<Vector> {
    let to_centre = circle.centre.minus(point);
    let along = to_centre.dot(direction);
    let aside = to_centre.minus(direction.times(along)).length();
    let square = (circle.radius - aside) * (circle.radius + aside);
    let half_chord = (square >= 0.0).then(|| math::sqrt(square))?;
    Some(point.plus(direction.times(along + half_chord * order)))
}

/// Where two compensated arcs cross: on the left of the way between their centres, or on the right.
fn two_circles(first: &Circle, second: &Circle, side: f64) -> Option<Vector> {
    let way = second.centre.minus(first.centre);
    let distance = way.length();
    let (sum, difference) = (first.radius + second.radius, first.radius - second.radius);
    let along = (distance + difference * sum / distance) / 2.0;
    let square = (first.radius - along) * (first.radius + along);
    let height = (square >= 0.0).then(|| math::sqrt(square))?;
    let direction = way.unit();
    let left = side * first.bend * second.bend;
    let aside = direction.quarter(left).times(height);
    Some(first.centre.plus(direction.times(along)).plus(aside))
}

impl LastMove {
    /// Refuses the move if the corner before it has left nothing of it, where it ends at `end`. The entry is not
    /// checked, nor a move after a stop before an inner corner.
    pub(super) fn check_fit(&self, end: Vector) -> Result<(), Refusal> {
        let fits = !self.has_to_fit
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
