//! The entry: the first move after compensation was switched on leads from where the tool is to the path.

use gaugeblock_vocabulary::FaultKind;

use crate::faults::{PlantedFault, planted};

use super::super::refusal::{Refusal, refuse};
use super::super::vector::Vector;
use super::path::LastMove;
use super::plane::{Arc, Circle, Cutter, Segment};

/// Refuses an entry that is too short. One of the length R is long enough, except for `rs274`.
pub(super) fn check_entry(
    segment: &Segment,
    cutter: &Cutter,
    emulates_rs274: bool,
) -> Result<(), Refusal> {
    let length = segment.to.minus(segment.from).length();
    let least = if planted(PlantedFault::EntryNeedsDiameter) { 2.0 } else { 1.0 } * cutter.radius;
    let short = length < least || emulates_rs274 && length <= least;
    let small = !planted(PlantedFault::TightArcAccepted)
        && segment
            .as_arc()
            .is_some_and(|arc| arc.bend(cutter) > 0.0 && arc.radius <= cutter.radius);
    if short || small {
        return refuse(FaultKind::Gouging, "an entry that is too short for the cutter's radius");
    }
    Ok(())
}

impl LastMove {
    /// Whether it is an entry whose circle leads it to its end against the programmed direction.
    pub(super) fn is_turned_over(&self) -> bool {
        let (Some(circle), Some(arc)) = (&self.circle, self.segment.as_arc()) else { return false };
        self.is_entry && self.end.minus(circle.centre).dot(arc.to_end) < 0.0
    }
}

/// The circle of an entry by an arc. It leads from the programmed start of `segment` to the end of its compensated
/// curve, and has the programmed direction there; where the start is on the other side of that end it has the opposite one.
pub(super) fn entry_circle(
    segment: &Segment,
    arc: &Arc,
    end: Vector,
    cutter: &Cutter,
) -> Result<Circle, Refusal> {
    let way = segment.from.minus(end);
    let height = -way.dot(way) / (2.0 * way.dot(arc.to_end));
    let centre = end.minus(arc.to_end.times(height));
    if !centre.is_finite() {
        return refuse(FaultKind::Gouging, "an entry by an arc that would be straight");
    }
    Ok(Circle { centre, radius: height.abs(), bend: arc.bend(cutter) })
}
