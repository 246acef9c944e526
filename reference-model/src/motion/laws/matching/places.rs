//! Selects one matching point for each sample.

use super::rows::{Match, MatchForm, Reach};
use super::{Matcher, Place};
use crate::motion::recording::Paged;
use crate::motion::vector::distance;

/// The difference below which distances, or sums of their squares, count as equal.
const SAME: f64 = 1e-12;

/// A point of a piece, as the last step of a sequence of points.
#[derive(Clone, Copy, Debug)]
struct Step {
    /// The sum of the squared distances of all samples so far from their points.
    cost: f64,
    /// The point of the previous sample, as an index in that sample's row.
    before: usize,
}

impl Matcher<'_> {
    /// What each sample is matched with. The points are the sequence, in the order of the path, with the least sum of
    /// squared distances from the samples. The nearest point of a single sample would be misleading if the tolerance is
    /// large: a sample near the end of a blend can be nearer to the beginning of the path.
    pub(super) fn matches(&self) -> Paged<MatchForm> {
        let storage = self.measure.recording.storage();
        // For each reach the reach of the sample before, as an index in that sample's row.
        let mut origins = self.rows.counts(storage);
        let (mut earlier, mut before): (Vec<Reach>, Vec<Step>) = (Vec::new(), Vec::new());
        for sample in 0..self.rows.len() {
            let row = self.rows.get(sample);
            before = self.steps(sample, &row, (&earlier, &before));
            for (place, step) in before.iter().enumerate() {
                origins.set(self.rows.place(sample, place), step.before);
            }
            earlier = row;
        }
        let mut chosen = Cheapest::default().with(&before, 0).place;
        let mut next: Option<(usize, Place)> = None;
        let mut matches = Paged::filled(MatchForm, storage, self.rows.len());
        for sample in (0..self.rows.len()).rev() {
            let row = self.rows.get(sample);
            let Some(reach) = row.get(chosen).copied() else { break };
            let free = self.measure.backwards.at(sample + 1);
            let limit = next.filter(|(piece, _)| *piece == reach.piece && !free);
            let limit = limit.map_or(1.0, |(_, place)| place.part);
            let place = Place {
                leg: self.pieces[reach.piece].leg,
                part: self.away(sample, reach, limit).1,
            };
            next = Some((reach.piece, place));
            let leg = |reach: &Reach| self.pieces[reach.piece].leg;
            let legs = (row.first().map_or(0, leg), row.last().map_or(0, leg));
            let ends = row.last().is_some_and(|reach| reach.high >= 1.0 - 1e-9);
            matches.set(sample, Match { place, legs, ends });
            chosen = origins.get(self.rows.place(sample, chosen));
        }
        matches
    }

    /// Those to a sample's points, from those to the points of the sample before.
    fn steps(
        &self,
        sample: usize,
        row: &[Reach],
        (earlier, before): (&[Reach], &[Step]),
    ) -> Vec<Step> {
        let all = Cheapest::default().with(before, 0);
        let free = self.measure.backwards.at(sample);
        let mut so_far = Cheapest::default();
        let step = |reach: &Reach| {
            let reached = earlier.partition_point(|earlier| earlier.piece <= reach.piece);
            so_far = so_far.with(&before[..reached], so_far.seen);
            let from = if free || reached == 0 { all } else { so_far };
            let away = self.away(sample, *reach, 1.0).0;
            let cost = if before.is_empty() { 0.0 } else { from.cost };
            Step { cost: cost + away * away, before: from.place }
        };
        row.iter().map(step).collect()
    }

    /// The distance of a sample from the matching points of a piece, up to a parameter, and the parameter of the
    /// nearest point.
    fn away(&self, sample: usize, reach: Reach, limit: f64) -> (f64, f64) {
        let point = self.measure.recording.point(sample);
        let curve = self.curves[self.pieces[reach.piece].leg];
        let part = curve.nearest(&point, reach.low, reach.high.min(limit).max(reach.low));
        (distance(&curve.at(part), &point), part)
    }
}

/// The cheapest of some steps, the last one where several are.
#[derive(Clone, Copy, Debug)]
struct Cheapest {
    place: usize,
    cost: f64,
    /// How many there were to choose from.
    seen: usize,
}

impl Default for Cheapest {
    fn default() -> Self {
        Self { place: 0, cost: f64::INFINITY, seen: 0 }
    }
}

impl Cheapest {
    /// That of some more: those of a row from a place on.
    fn with(mut self, row: &[Step], from: usize) -> Self {
        for (place, step) in row.iter().enumerate().skip(from) {
            if step.cost <= self.cost + SAME {
                (self.place, self.cost) = (place, step.cost);
            }
        }
        Self { seen: row.len(), ..self }
    }
}
