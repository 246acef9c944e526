//! Determines when each corner of the path is passed, and when the motion may have rested there.

use super::matching::Matching;
use super::record::Record;
use crate::math;
use crate::motion::route::{Corner, CornerTolerance, Route};
use crate::motion::vector::{AxisVector, distance, from_segment};

/// The pass of a corner: the samples that match points on both sides of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CornerPass {
    /// The first sample that matches the corner or a point after it.
    pub(super) first: usize,
    /// The last sample that matches the corner or a point before it; the one before `first` if no sample matches both
    /// sides.
    pub(super) last: usize,
    /// First and last sample at the corner.
    pub(super) at: Option<(usize, usize)>,
    /// Whether a later sample matches only points after the corner: then the corner was certainly passed.
    pub(super) passed: bool,
    /// If the motion ran back and came to the corner again: the first sample of the last time, and the first and last
    /// sample at the corner then.
    again: Option<(usize, Option<(usize, usize)>)>,
    /// The same, if it is unknown on which of both legs the motion was before it ran back.
    perhaps: Option<(usize, Option<(usize, usize)>)>,
}

impl CornerPass {
    /// The samples between which the corner is passed, each with the one after it.
    pub(super) fn pairs(&self, record: &Record<'_>) -> impl Iterator<Item = usize> + use<> {
        let samples = record.len();
        (self.first.saturating_sub(1)..=self.last).filter(move |sample| sample + 1 < samples)
    }

    /// The last time that the motion comes to the corner before it continues.
    pub(super) fn latest(self) -> Self {
        self.again.map_or(self, |(first, at)| Self { first, at, again: None, ..self })
    }

    /// The times that may be the last one before the motion continues.
    pub(super) fn times(self) -> impl Iterator<Item = Self> {
        let perhaps = self.perhaps.map(|(first, at)| Self { first, at, ..self });
        std::iter::once(self.latest()).chain(perhaps)
    }

    /// Whether an abort ends the record before a sample matches only points after the corner. The requests at the
    /// corner may not have been executed then.
    pub(super) fn is_aborted(self, record: &Record<'_>) -> bool {
        record.requests.aborted.is_some() && self.last + 1 == record.len()
    }

    /// First and last sample of each stay at the corner.
    pub(super) fn stays<'a>(
        self,
        record: &'a Record<'_>,
        corner: &'a AxisVector,
    ) -> impl Iterator<Item = (usize, usize)> + 'a {
        let is_at = move |sample: &usize| record.is_at(*sample, corner);
        let mut next = self.first;
        std::iter::from_fn(move || {
            let first = (next..=self.last).find(is_at)?;
            let last = (first..=self.last).take_while(is_at).last()?;
            next = last + 1;
            Some((first, last))
        })
    }

    /// First and last of the samples that may be the nearest one, of those from one to another, if there are any.
    pub(super) fn near_within(
        &self,
        record: &Record<'_>,
        corner: &Corner,
        (since, until): (usize, usize),
    ) -> (usize, usize) {
        let (first, last) = (self.first.max(since), self.last.min(until.saturating_sub(1)));
        if self.at.is_some() || first > last + 1 {
            return self.near(record, corner);
        }
        Self { first, last, ..*self }.near(record, corner)
    }

    /// The sample that is nearest to the corner; the last one at it.
    pub(super) fn nearest(&self, record: &Record<'_>, corner: &AxisVector) -> usize {
        if let Some((_, last)) = self.at {
            return last;
        }
        let away = |sample: &usize| distance(&record.point(*sample), corner);
        let near = self.first.saturating_sub(1)..=self.after(record);
        near.min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(self.first)
    }

    /// First and last of the samples that may be the nearest one.
    ///
    /// Between two samples the motion may have been as near, since it is at most a·h²/8 from their chord. If the motion
    /// comes near more than once, a time counts if its distance is at most the least one plus the distance to the next
    /// sample, or at most the tolerance of the corner.
    fn near(&self, record: &Record<'_>, corner: &Corner) -> (usize, usize) {
        let missed = match corner.tolerance {
            CornerTolerance::Within(tolerance) => tolerance,
            CornerTolerance::BetweenMidpoints => f64::INFINITY,
            CornerTolerance::Rest | CornerTolerance::Exact => 0.0,
        };
        let exact = missed <= 0.0;
        let corner = &corner.at;
        let nearest = self.nearest(record, corner);
        let (mut first, mut last) = (nearest, nearest);
        if self.at.is_some() && exact {
            let later = self.stays(record, corner).last().map_or(nearest, |stay| stay.1);
            return (first, later);
        }
        let place = |sample: usize| record.point(sample);
        let away = |sample: usize| distance(&place(sample), corner);
        let least = away(nearest);
        let inner = record.len().saturating_sub(2);
        for sample in self.first.saturating_sub(1).max(1)..=self.after(record).min(inner) {
            let way = [sample - 1, sample].map(|from| distance(&place(from), &place(from + 1)));
            let nearer = away(sample) < away(sample - 1) && away(sample) <= away(sample + 1);
            let again = nearer && away(sample) <= missed.max(least + way[0].max(way[1]));
            let between = [sample - 1, sample].iter().any(|from| {
                let ends = [*from, from + 1].map(away);
                let near = from_segment(&place(*from), &place(from + 1), corner);
                away(sample) <= ends[0].min(ends[1]) && near <= least + record.bulge
            });
            if again || between {
                (first, last) = (first.min(sample), last.max(sample));
            }
        }
        (first, last)
    }

    /// The first sample that matches only points after the corner; the last sample if there is none.
    pub(super) fn after(&self, record: &Record<'_>) -> usize {
        (self.last + 1).min(record.len() - 1)
    }
}

/// The first visit of each corner, `None` for one that is not reached.
///
/// A sample can match points on both sides of a corner, and the documents allow either. A visit is therefore a span of
/// samples; requests at the corner must be executed within it. The work is linear in samples and corners as long as a
/// sample matches few legs.
pub(super) fn corner_passes(
    record: &Record<'_>,
    route: &Route<'_>,
    matching: &Matching,
) -> Vec<Option<CornerPass>> {
    let end = record.len();
    let mut corner_passes = Vec::with_capacity(route.corners.len());
    let mut first = 0;
    for (number, corner) in route.corners.iter().enumerate() {
        let is_at = |sample: usize| record.is_at(sample, &corner.at);
        let legs = |sample: usize| matching.legs(sample);
        let can_be_behind = |sample: usize| {
            legs(sample).1 >= number && number < route.legs.len()
                || is_at(sample) && matching.ended(sample) >= number
        };
        let can_be_before =
            |sample: usize| legs(sample).0 < number || is_at(sample) && legs(sample).0 <= number;
        while first < end && !can_be_behind(first) {
            first += 1;
        }
        if first == end {
            corner_passes.push(None);
            continue;
        }
        let mut after = first;
        while after < end && can_be_before(after) {
            after += 1;
        }
        let at_since = |first: usize| {
            let from = (first..after).find(|sample| is_at(*sample))?;
            let run = (from..after).take_while(|sample| is_at(*sample));
            Some((from, run.last().unwrap_or(from)))
        };
        let at = at_since(first);
        let back = (first..after).rev().find(|sample| !can_be_behind(*sample));
        // A motion that may have been after the corner may have begun the next leg.
        let begun = |back: &usize| (first..*back).any(|s| can_be_behind(s) && !is_at(s));
        let again = back.filter(|back| !begun(back)).map(|back| (back + 1, at_since(back + 1)));
        let returns = (first..after).rev().find(|sample| record.backwards.at(*sample));
        let returns = returns.filter(|back| again.is_none() && back + 1 < after);
        let perhaps = returns.map(|back| (back + 1, at_since(back + 1)));
        let last = after.saturating_sub(1);
        let passed = after < end || at.is_some();
        corner_passes.push(Some(CornerPass { first, last, at, passed, again, perhaps }));
    }
    corner_passes
}

/// The time that passes at least from a sample to rest at a point, or from such rest to it: from rest an axis is
/// a·t²/2 away after t.
pub(super) fn to_rest(record: &Record<'_>, sample: usize, corner: &AxisVector) -> f64 {
    let point = record.point(sample);
    let away = |axis: usize| {
        let off = ((point[axis] - corner[axis]).abs() - record.slack).max(0.0);
        if off > 0.0 {
            math::square_root(2.0 * off / record.envelope.acceleration[axis])
        } else {
            0.0
        }
    };
    (0..9).map(away).fold(0.0, f64::max)
}

/// The time from rest at a point to rest at another one, at least.
fn between_rests(record: &Record<'_>, one: &AxisVector, other: &AxisVector) -> f64 {
    let away = |axis: usize| {
        let way = (one[axis] - other[axis]).abs();
        if way > 0.0 {
            2.0 * math::square_root(way / record.envelope.acceleration[axis])
        } else {
            0.0
        }
    };
    (0..9).map(away).fold(0.0, f64::max)
}

/// Rest at one corner after the other, each between two samples.
///
/// All axes rest at the same moment, so that the slowest one decides how long before and after it a sample must be.
/// Several rests between the same samples share the time between these.
pub(super) struct Rests<'r, 'a> {
    record: &'r Record<'a>,
    /// The sample after which the motion rested last, the time from that sample to this rest, and where it was.
    before: Option<(usize, f64, AxisVector)>,
}

impl<'r, 'a> Rests<'r, 'a> {
    pub(super) fn of(record: &'r Record<'a>) -> Self {
        Self { record, before: None }
    }

    /// The time that is needed at least between a sample and the next one for rest at a point in between.
    fn needed(&self, sample: usize, corner: &AxisVector) -> (f64, f64) {
        let until = match &self.before {
            Some((same, spent, place)) if *same == sample => {
                spent + between_rests(self.record, place, corner)
            }
            _ => to_rest(self.record, sample, corner),
        };
        (until, until + to_rest(self.record, sample + 1, corner))
    }

    /// The first pair of samples of a visit between which there can be rest, or the one that comes nearest to that;
    /// and the time that it needs between its samples.
    pub(super) fn next(&mut self, pass: CornerPass, corner: &AxisVector) -> Option<(usize, f64)> {
        let earliest = self.before.map_or(0, |(sample, ..)| sample);
        let mut best: Option<(usize, f64, f64)> = None;
        for sample in pass.pairs(self.record).filter(|sample| *sample >= earliest) {
            let (until, needed) = self.needed(sample, corner);
            if best.is_none_or(|(_, _, least)| needed < least) {
                best = Some((sample, until, needed));
            }
            if self.fits(needed) {
                break;
            }
        }
        let (sample, until, needed) = best?;
        self.before = Some((sample, until, *corner));
        Some((sample, needed))
    }

    /// Whether a time is no longer than from one sample to the next.
    pub(super) fn fits(&self, needed: f64) -> bool {
        needed <= self.record.period * (1.0 + 1e-9)
    }
}

/// First and last sample after which there can be rest at a corner.
pub(super) fn rest_after(
    record: &Record<'_>,
    pass: CornerPass,
    corner: &AxisVector,
) -> Option<(usize, usize)> {
    let rests = Rests::of(record);
    let mut fitting =
        pass.pairs(record).filter(|sample| rests.fits(rests.needed(*sample, corner).1));
    let first = fitting.next()?;
    Some((first, fitting.last().unwrap_or(first)))
}
