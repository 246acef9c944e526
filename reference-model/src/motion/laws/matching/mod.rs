//! Matches each sample with a point of the path.
//!
//! Samples are matched by progress. A sample matches a point that is within tolerance of it and not before the point of
//! the previous sample; each corner between them must be within tolerance of the chord between the two samples. A path
//! that crosses itself or reverses is therefore followed in order; the nearest point of the whole path would be wrong.
//!
//! For each sample the set of all matching points is kept, as an interval on each piece of the path (the free space of
//! two curves, which also gives their Fréchet distance). If the set becomes empty, part of the path was missed, and
//! matching continues from the nearest point. A last pass removes points from which no later sample can be reached.
//!
//! The work is linear in samples times pieces within tolerance of a sample. What is known of each sample is in pages.

mod leading;
mod places;
mod rows;

use std::collections::BTreeSet;

use super::backwards::Backwards;
use crate::motion::curve::Curve;
use crate::motion::recording::{Paged, Recording};
use crate::motion::route::{CornerTolerance, Route};
use crate::motion::vector::{AxisVector, distance, from_segment};
use gaugeblock_vocabulary::motion::PathMode;
pub(super) use rows::Place;
use rows::{MatchForm, Reach, Rows};

/// Pieces after and before the last match in which a point is searched for a sample that matches none.
const AHEAD: usize = 256;
const BEHIND: usize = 16;

/// A stretch of a leg: a line, half of one, or at most a quarter of a circle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// The leg.
    pub(super) leg: usize,
    /// Its parameter where the piece starts and ends.
    from: f64,
    to: f64,
    /// The greatest distance of a matching sample from the piece.
    tolerance: f64,
    /// The greatest distance of the piece's end from the chord between the samples before and after it.
    gate: f64,
}

/// A part of the path that the samples do not follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Missed {
    /// A sample is too far from the path.
    Path,
    /// No sample is near the corner of this number.
    Corner(usize),
    /// The leg of this number was left out.
    Leg(usize),
    /// The middle of the leg of this number was left out: a corner may be rounded only up to it.
    Middle(usize),
    /// The path was followed backwards.
    Order,
}

/// Something that was missed: when, what, by how much, and how much was allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Miss {
    pub(super) sample: usize,
    pub(super) what: Missed,
    pub(super) distance: f64,
    pub(super) allowed: f64,
}

/// Samples matched to a route.
#[derive(Debug)]
pub(super) struct Matching {
    matches: Paged<MatchForm>,
    rows: Rows,
    pieces: Vec<Piece>,
    /// What was missed, in order.
    pub(super) missed: Vec<Miss>,
}

impl Matching {
    /// The best matching point of a sample.
    pub(super) fn place(&self, sample: usize) -> Place {
        self.matches.get(sample).place
    }

    /// First and last leg with a point that matches a sample.
    pub(super) fn legs(&self, sample: usize) -> (usize, usize) {
        self.matches.get(sample).legs
    }

    /// The number of legs that may have ended at a sample: those before its last leg, and that leg if its end matches.
    pub(super) fn ended(&self, sample: usize) -> usize {
        let found = self.matches.get(sample);
        found.legs.1 + usize::from(found.ends)
    }

    /// The corners that a sample can be passing: it is between the middles of the legs before and after the corner. In
    /// order.
    pub(super) fn corners(&self, sample: usize) -> Vec<usize> {
        let row = self.rows.get(sample);
        let mut corners: Vec<usize> =
            row.iter().flat_map(|reach| corners(&self.pieces[reach.piece], reach)).collect();
        corners.dedup();
        corners
    }
}

/// The corners between the middles of whose legs some points of a piece are: one, but both of its leg where the piece
/// leads over the middle.
fn corners(piece: &Piece, reach: &Reach) -> std::ops::RangeInclusive<usize> {
    let first = piece.leg + usize::from(reach.low >= 0.5 && piece.from >= 0.5);
    let last = piece.leg + usize::from(piece.to > 0.5);
    first..=last
}

/// The samples, and the bounds of their errors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measure<'a> {
    pub(super) recording: &'a Recording,
    /// The greatest error of a position by the rounding of written numbers.
    pub(super) slack: f64,
    /// The greatest distance of the motion from the chord between two samples.
    pub(super) bulge: f64,
    /// Where the path may be followed backwards.
    pub(super) backwards: &'a Backwards,
    /// Whether the samples must reach the end of the path.
    pub(super) finished: bool,
}

struct Matcher<'a> {
    measure: Measure<'a>,
    curves: Vec<&'a Curve>,
    pieces: Vec<Piece>,
    /// The least distance of each piece's end to the chords so far.
    closest: Vec<f64>,
    rows: Rows,
    /// The samples that match no point which can be reached from those of the previous sample.
    lost: BTreeSet<usize>,
    missed: Vec<Miss>,
}

impl<'a> Matcher<'a> {
    fn new(measure: Measure<'a>, curves: Vec<&'a Curve>, pieces: Vec<Piece>) -> Self {
        let closest = vec![f64::INFINITY; pieces.len()];
        let rows = Rows::new(measure.recording.storage());
        Self { measure, curves, pieces, closest, rows, lost: BTreeSet::new(), missed: Vec::new() }
    }
}

/// Matches samples to a route that has a leg.
pub(super) fn matched(route: &Route<'_>, measure: Measure<'_>) -> Matching {
    let curves = route.legs.iter().map(|leg| &leg.curve).collect();
    let mut matcher = Matcher::new(measure, curves, pieces(route));
    matcher.forward();
    matcher.lead();
    let matches = matcher.matches();
    let Matcher { rows, pieces, missed, .. } = matcher;
    Matching { matches, rows, pieces, missed }
}

/// Whether points lead along curves in order, within a tolerance, and pass each of their ends.
pub(in crate::motion) fn follows(points: &[AxisVector], curves: &[Curve], tolerance: f64) -> bool {
    let piece = |leg: usize| Piece { leg, from: 0.0, to: 1.0, tolerance, gate: tolerance };
    let quarters = |leg: usize, curve: &Curve| {
        let quarters = (curve.angle().abs() / std::f64::consts::FRAC_PI_2).ceil().max(1.0);
        let mut parts = Vec::new();
        let mut done = 0.0;
        while done < quarters {
            let (from, to) = (done / quarters, (done + 1.0) / quarters);
            parts.push(Piece { from, to, ..piece(leg) });
            done += 1.0;
        }
        parts
    };
    let pieces: Vec<Piece> =
        curves.iter().enumerate().flat_map(|(leg, curve)| quarters(leg, curve)).collect();
    // An arc is farther from the chord between two points than its ends are.
    let bulge = tolerance;
    let (recording, backwards) = (Recording::of_points(points), Backwards::default());
    let measure = Measure {
        recording: &recording,
        slack: 0.0,
        bulge,
        backwards: &backwards,
        finished: false,
    };
    let mut matcher = Matcher::new(measure, curves.iter().collect(), pieces);
    let starts = matcher.free(0, &points[0]).is_some_and(|reach| reach.low <= 0.0);
    matcher.forward();
    starts && matcher.missed.is_empty()
}

fn pieces(route: &Route<'_>) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for (number, leg) in route.legs.iter().enumerate() {
        let between = leg.element.mode == PathMode::BetweenMidpoints;
        let quarters = (leg.curve.angle().abs() / std::f64::consts::FRAC_PI_2).ceil();
        let quarters =
            if between { 2.0 * (quarters / 2.0).ceil().max(1.0) } else { quarters.max(1.0) };
        let mut done = 0.0;
        while done < quarters {
            let to = (done + 1.0) / quarters;
            let gate = if to >= 1.0 {
                gate(route, number + 1)
            } else if between && (to - 0.5).abs() < 1e-9 {
                0.0
            } else {
                leg.tolerance
            };
            let from = done / quarters;
            pieces.push(Piece { leg: number, from, to, tolerance: leg.tolerance, gate });
            done += 1.0;
        }
    }
    pieces
}

fn gate(route: &Route<'_>, corner: usize) -> f64 {
    match route.corners[corner].tolerance {
        CornerTolerance::Rest | CornerTolerance::Exact => 0.0,
        CornerTolerance::Within(tolerance) => tolerance,
        CornerTolerance::BetweenMidpoints => {
            let near = |leg: usize| route.legs.get(leg).map_or(0.0, |leg| leg.curve.length());
            near(corner - 1).max(near(corner))
        }
    }
}

impl Matcher<'_> {
    fn forward(&mut self) {
        if self.measure.recording.is_empty() {
            return;
        }
        let first = self.measure.recording.point(0);
        let start = self.free(0, &first).filter(|reach| reach.low <= self.pieces[0].from);
        let start = start.unwrap_or(Reach { piece: 0, low: 0.0, high: 0.0 });
        let mut before = vec![start];
        self.rows.push(&before);
        for sample in 1..self.measure.recording.len() {
            let mut row = self.step(sample, &before);
            if row.is_empty() {
                row = vec![self.recover(sample, &before)];
                self.lost.insert(sample);
            }
            self.rows.push(&row);
            before = row;
        }
        self.end(before.last());
    }

    /// The chord from the sample before to this one.
    fn chord(&self, sample: usize) -> (AxisVector, AxisVector) {
        (self.measure.recording.point(sample - 1), self.measure.recording.point(sample))
    }

    /// The points of a piece that are within tolerance of a point.
    fn free(&self, piece: usize, point: &AxisVector) -> Option<Reach> {
        let at = &self.pieces[piece];
        let tolerance = at.tolerance + self.measure.slack;
        let (low, high) = self.curves[at.leg].within(point, tolerance, at.from, at.to)?;
        Some(Reach { piece, low, high })
    }

    /// The points that match a sample, from those of the previous sample.
    fn step(&mut self, sample: usize, before: &[Reach]) -> Vec<Reach> {
        let (from, point) = self.chord(sample);
        let mut row: Vec<Reach> = Vec::new();
        let mut known = before.iter().peekable();
        let first = before.first().map_or(0, |reach| reach.piece);
        let mut enters = false;
        for piece in first..self.pieces.len() {
            let here = known.next_if(|reach| reach.piece == piece);
            let start =
                if enters { Some(self.pieces[piece].from) } else { here.map(|reach| reach.low) };
            if start.is_none() && known.peek().is_none() {
                break;
            }
            if let Some(low) = start {
                let free = self.free(piece, &point).filter(|reach| reach.high >= low);
                row.extend(free.map(|reach| Reach { low: reach.low.max(low), ..reach }));
            }
            enters = start.is_some()
                && passes(
                    &self.pieces[piece],
                    &self.curves,
                    &mut self.closest[piece],
                    (&from, &point),
                    &self.measure,
                );
        }
        if self.measure.backwards.at(sample) {
            let back = self.step_back(sample, before);
            row.extend(back);
            row.sort_by(|a, b| {
                (a.piece, a.low).partial_cmp(&(b.piece, b.low)).unwrap_or(std::cmp::Ordering::Equal)
            });
            row.dedup_by(|later, earlier| {
                let same = later.piece == earlier.piece;
                if same {
                    earlier.high = earlier.high.max(later.high);
                }
                same
            });
        }
        row
    }

    /// The same where the path is followed backwards.
    fn step_back(&self, sample: usize, before: &[Reach]) -> Vec<Reach> {
        let (from, point) = self.chord(sample);
        let mut row = Vec::new();
        let mut known = before.iter().rev().peekable();
        let last = before.last().map_or(0, |reach| reach.piece);
        let mut enters = false;
        for piece in (0..=last).rev() {
            let here = known.next_if(|reach| reach.piece == piece);
            let start =
                if enters { Some(self.pieces[piece].to) } else { here.map(|reach| reach.high) };
            if start.is_none() && known.peek().is_none() {
                break;
            }
            if let Some(high) = start {
                let free = self.free(piece, &point).filter(|reach| reach.low <= high);
                row.extend(free.map(|reach| Reach { high: reach.high.min(high), ..reach }));
            }
            let mut closest = f64::INFINITY;
            enters = start.is_some()
                && piece > 0
                && passes(
                    &self.pieces[piece - 1],
                    &self.curves,
                    &mut closest,
                    (&from, &point),
                    &self.measure,
                );
        }
        row
    }

    /// A sample that stands for no point: says what was missed, and goes on from the nearest point.
    fn recover(&mut self, sample: usize, before: &[Reach]) -> Reach {
        let (from, point) = self.chord(sample);
        let (first, last) = (before[0], before[before.len() - 1]);
        let mut best = (f64::INFINITY, last);
        let ahead = (last.piece + AHEAD).min(self.pieces.len() - 1);
        let order =
            (first.piece..=ahead).chain((first.piece.saturating_sub(BEHIND)..first.piece).rev());
        for piece in order {
            let at = &self.pieces[piece];
            let part = self.curves[at.leg].nearest(&point, at.from, at.to);
            let away = distance(&self.curves[at.leg].at(part), &point);
            let excess = (away - at.tolerance - self.measure.slack).max(0.0);
            let steps = 1e-12 * away.max(1.0);
            if excess < best.0 - steps {
                best = (excess, Reach { piece, low: part, high: part });
            }
        }
        let (excess, reach) = best;
        let at = self.pieces[reach.piece];
        let may_go_back = self.measure.backwards.at(sample);
        let back = !may_go_back && (reach.piece, reach.high) < (first.piece, first.low);
        if excess > 0.0 {
            let allowed = at.tolerance;
            let near = self.curves[at.leg].at(reach.low);
            self.missed.push(Miss {
                sample,
                what: Missed::Path,
                distance: distance(&near, &point),
                allowed,
            });
            if back {
                // It strays from the path and is judged for that alone; progress is not lost by it.
                return Reach { piece: first.piece, low: first.low, high: first.low };
            }
        } else if back {
            let moved = distance(&from, &point);
            self.missed.push(Miss { sample, what: Missed::Order, distance: moved, allowed: 0.0 });
        }
        for piece in first.piece..reach.piece {
            self.skip(sample, piece, first.piece);
        }
        reach
    }

    /// Says that the end of a piece was passed too far away, unless a chord was near it before.
    fn skip(&mut self, sample: usize, piece: usize, first: usize) {
        let at = self.pieces[piece];
        let (from, to) = self.chord(sample);
        let end = self.curves[at.leg].at(at.to);
        self.closest[piece] = self.closest[piece].min(from_segment(&from, &to, &end));
        let allowed = at.gate;
        let distance = (self.closest[piece] - self.measure.bulge).max(0.0);
        if distance <= allowed + self.measure.slack {
            return;
        }
        let what = if at.to < 1.0 {
            if at.gate == 0.0 { Missed::Middle(at.leg) } else { return }
        } else if piece > first {
            Missed::Leg(at.leg)
        } else {
            Missed::Corner(at.leg + 1)
        };
        self.missed.push(Miss { sample, what, distance, allowed });
    }

    /// Whatever lies between the last sample and the end of the path was left out, but for a leg whose end is within
    /// its tolerance: that the path ends exactly is another law's.
    fn end(&mut self, last: Option<&Reach>) {
        let sample = self.measure.recording.len() - 1;
        let Some(last) = last else { return };
        let point = self.measure.recording.point(sample);
        for piece in last.piece..self.pieces.len() {
            let at = self.pieces[piece];
            let away = distance(&self.curves[at.leg].end(), &point);
            let allowed = at.gate.max(at.tolerance) + self.measure.slack + self.measure.bulge;
            if at.to >= 1.0 && away > allowed {
                let what = Missed::Leg(at.leg);
                self.missed.push(Miss { sample, what, distance: away, allowed: 0.0 });
            }
        }
    }
}

/// Whether a chord passes the end of a piece within tolerance.
fn passes(
    piece: &Piece,
    curves: &[&Curve],
    closest: &mut f64,
    chord: (&AxisVector, &AxisVector),
    measure: &Measure<'_>,
) -> bool {
    let end = curves[piece.leg].at(piece.to);
    let away = from_segment(chord.0, chord.1, &end);
    *closest = closest.min(away);
    away <= piece.gate + measure.bulge + measure.slack
}
