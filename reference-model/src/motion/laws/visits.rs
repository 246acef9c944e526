//! When each corner of the path is passed.

use super::matching::Matching;
use super::record::Record;
use crate::motion::route::Route;
use crate::motion::vector::distance;

/// By so many samples a corner may seem to be passed too early: what a motion can be from a chord is granted to it.
pub(super) const EARLY: usize = 3;

/// How a corner is passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Visit {
    /// The last sample before it; the first of all where the motion starts there.
    pub(super) before: usize,
    /// The first sample after it; the last of all where it ends there.
    pub(super) after: usize,
    /// First and last sample at it.
    pub(super) at: Option<(usize, usize)>,
}

impl Visit {
    /// The sample that is nearest to the corner; the last one at it.
    pub(super) fn nearest(
        &self,
        record: &Record<'_>,
        corner: &crate::motion::vector::Nine,
    ) -> usize {
        if let Some((_, last)) = self.at {
            return last;
        }
        let away = |sample: usize| distance(&record.points[sample], corner);
        let mut nearest =
            if away(self.before) < away(self.after) { self.before } else { self.after };
        while nearest + 1 < record.points.len() && away(nearest + 1) < away(nearest) {
            nearest += 1;
        }
        while nearest > 0 && away(nearest - 1) < away(nearest) {
            nearest -= 1;
        }
        nearest
    }
}

/// The first visit of each corner, `None` for one that is not reached. Linear in samples and corners.
pub(super) fn visits(
    record: &Record<'_>,
    route: &Route<'_>,
    matching: &Matching,
) -> Vec<Option<Visit>> {
    let last = record.points.len() - 1;
    let mut visits = Vec::with_capacity(route.corners.len());
    let mut after = 0;
    for (number, corner) in route.corners.iter().enumerate() {
        let beyond = |sample: usize| {
            matching.places[sample].leg >= number && !record.is_at(sample, &corner.at)
        };
        while after <= last && !beyond(after) {
            after += 1;
        }
        // Where legs cover each other a sample shortly before the corner stands for a point behind it as well.
        let near = after..=(after + EARLY).min(last);
        if let Some(at) = near.rev().find(|sample| record.is_at(*sample, &corner.at)) {
            after = at;
            while after <= last && record.is_at(after, &corner.at) {
                after += 1;
            }
        }
        let mut before = after.min(last + 1);
        while before > 0 && record.is_at(before - 1, &corner.at) {
            before -= 1;
        }
        let at = (before < after).then(|| (before, after - 1));
        let reached = at.is_some() || after <= last;
        let visit = Visit { before: before.saturating_sub(1), after: after.min(last), at };
        visits.push(reached.then_some(visit));
        // The next corner may be reached while the last samples of this one are still near it.
        after = before;
    }
    visits
}
