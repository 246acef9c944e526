//! The entry: the first move after compensation was switched on leads from where the tool is to the path.

use gaugeblock_vocabulary::FaultKind;

use super::super::refusal::{Refusal, refuse};
use super::plane::{Arc, Cutter, Segment, Vector};

/// The arc of an entry: it has the programmed direction where it ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct EntryArc {
    pub(super) centre: Vector,
    /// Whether it bends the other way than the programmed one.
    pub(super) is_turned_over: bool,
}

/// Refuses an entry that is too short. The manual accepts a length of R, which is refused here, as by LinuxCNC.
pub(super) fn check_entry(segment: &Segment, cutter: &Cutter) -> Result<(), Refusal> {
    let short = segment.to.minus(segment.from).length() <= cutter.radius;
    let small =
        segment.as_arc().is_some_and(|arc| arc.bend(cutter) > 0.0 && arc.radius <= cutter.radius);
    if short || small {
        return refuse(FaultKind::Gouging, "an entry that is not longer than the cutter's radius");
    }
    Ok(())
}

impl EntryArc {
    /// The arc from the programmed start of `segment` to the end of its compensated curve.
    pub(super) fn new(segment: &Segment, arc: &Arc, end: Vector) -> Result<Self, Refusal> {
        let way = segment.from.minus(end);
        let height = -way.dot(way) / (2.0 * way.dot(arc.to_end));
        let centre = end.minus(arc.to_end.times(height));
        if !centre.is_finite() {
            return refuse(FaultKind::Gouging, "an entry by an arc that would be straight");
        }
        Ok(Self { centre, is_turned_over: height < 0.0 })
    }
}
