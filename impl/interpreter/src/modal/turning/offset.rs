//! The offset of a profile: in steps that are short enough, each followed by joining neighbours.

use alloc::vec::Vec;

use gaugeblock_vocabulary::FaultKind;

use crate::limits::Limit;
use crate::math;

use super::super::refusal::{Refusal, refuse};
use super::super::vector::Vector;
use super::piece::{Arc, Curve, Piece};
use super::rounding::SHORTEST;

/// The ends of two pieces differ by more than this in travel where an arc joins them; program units.
const GAP: f64 = 0.01;
/// Most steps of an offset.
const STEPS_MAX: u32 = 100_000;

/// An offset under way.
#[derive(Clone, Debug)]
pub(super) struct Offset {
    pub(super) pieces: Vec<Piece>,
    /// 1 to the left, -1 to the right.
    side: f64,
    /// The distance that is left.
    left: f64,
    steps: u32,
    pieces_max: usize,
    joins_parallels: bool,
}

impl Offset {
    /// An offset to the left, or with a negative distance to the right.
    pub(super) fn new(
        pieces: &[Piece],
        distance: f64,
        (pieces_max, joins_parallels): (u32, bool),
    ) -> Self {
        let side = if distance < 0.0 { -1.0 } else { 1.0 };
        let pieces_max = usize::try_from(pieces_max).unwrap_or(usize::MAX).saturating_mul(2);
        Self {
            pieces: pieces.to_vec(),
            side,
            left: distance.abs(),
            steps: 0,
            pieces_max,
            joins_parallels,
        }
    }

    /// Makes a step; whether the offset is complete then.
    pub(super) fn step(&mut self) -> Result<bool, Refusal> {
        if self.left <= 0.0 {
            return Ok(true);
        }
        self.steps = self.steps.saturating_add(1);
        if self.steps > STEPS_MAX {
            return Err(Refusal::LimitExceeded(Limit::ProfileMoves));
        }
        let step = self.left.min(longest_step(&self.pieces));
        let shifted: Vec<Piece> =
            self.pieces.iter().map(|piece| parallel(piece, step * self.side)).collect();
        let mut joined: Vec<Piece> = Vec::with_capacity(shifted.len());
        for (before, next) in self.pieces.iter().zip(&shifted) {
            let mut next = *next;
            if let Some(last) = joined.last_mut()
                && let Some(joint) =
                    join(last, &mut next, (before.from, step * self.side), self.joins_parallels)?
            {
                joined.push(joint);
            }
            joined.push(next);
        }
        self.left -= step;
        check_turned_over(&joined)?;
        drop_short(&mut joined, self.joins_parallels)?;
        if joined.len() > self.pieces_max {
            return Err(Refusal::LimitExceeded(Limit::ProfileMoves));
        }
        self.pieces = joined;
        Ok(self.left <= 0.0)
    }
}

/// The longest step: half of the shortest chord, and of the least radius.
fn longest_step(pieces: &[Piece]) -> f64 {
    let of = |piece: &Piece| piece.chord().min(piece.radius().unwrap_or(f64::INFINITY)) / 2.0;
    pieces.iter().map(of).fold(f64::INFINITY, f64::min)
}

/// A piece moved to the left, or with a negative distance to the right.
fn parallel(piece: &Piece, distance: f64) -> Piece {
    match piece.curve {
        Curve::Line | Curve::Traverse => {
            let shift = piece.start_direction().quarter(1.0).times(distance);
            Piece { from: piece.from.plus(shift), to: piece.to.plus(shift), curve: piece.curve }
        }
        Curve::Arc(arc) => {
            let shifted = |point: Vector| {
                let out = point.minus(arc.centre).unit().times(-arc.sense * distance);
                point.plus(out)
            };
            Piece { from: shifted(piece.from), to: shifted(piece.to), curve: piece.curve }
        }
    }
}

/// Joins two pieces that met in a corner and were moved by a distance: an arc comes between them, or they end and
/// begin at their intersection.
fn join(
    last: &mut Piece,
    next: &mut Piece,
    (corner, distance): (Vector, f64),
    joins_parallels: bool,
) -> Result<Option<Piece>, Refusal> {
    let (ends, begins) = (last.end_direction(), next.start_direction());
    let is_outer = ends.cross(begins) * distance < 0.0;
    if is_outer && (last.to.p - next.from.p).abs() > GAP {
        let sense = if distance > 0.0 { -1.0 } else { 1.0 };
        let curve = Curve::Arc(Arc { centre: corner, sense });
        return Ok(Some(Piece { from: last.to, to: next.from, curve }));
    }
    let point = intersection(last, next, corner, joins_parallels)?;
    (last.to, next.from) = (point, point);
    Ok(None)
}

/// The intersection of two curves next to a point.
fn intersection(
    first: &Piece,
    second: &Piece,
    near: Vector,
    joins_parallels: bool,
) -> Result<Vector, Refusal> {
    match (first.as_arc(), second.as_arc()) {
        (None, None) => two_lines(first, second, joins_parallels),
        (None, Some(_)) => line_and_arc(first, second, (near, second.start_direction())),
        (Some(_), None) => line_and_arc(second, first, (near, first.end_direction().times(-1.0))),
        (Some(_), Some(_)) => {
            if first.to.minus(second.from).length() <= 1e-6 {
                return Ok(first.to.plus(second.from).times(0.5));
            }
            Err(Refusal::Unsupported("an offset of two arcs that meet in a corner".into()))
        }
    }
}

fn two_lines(first: &Piece, second: &Piece, joins_parallels: bool) -> Result<Vector, Refusal> {
    let (along, across) = (first.start_direction(), second.start_direction());
    let turn = along.cross(across);
    if turn.abs() <= 1e-12 && along.dot(across) < 0.0 {
        return Err(Refusal::Unsupported("an offset of moves that go back on themselves".into()));
    }
    if turn.abs() <= 1e-12 && joins_parallels && first.to.minus(second.from).length() <= 1e-6 {
        return Ok(first.to);
    }
    if turn.abs() <= 1e-12 {
        return refuse(FaultKind::Gouging, "lines of a profile that are parallel");
    }
    let reach = second.from.minus(first.from).cross(across) / turn;
    Ok(first.from.plus(along.times(reach)))
}

/// The crossing of a line and an arc that is next to a point; of two that are equally far from it the one on the arc,
/// which leads away from the point in a direction.
fn line_and_arc(
    line: &Piece,
    arc: &Piece,
    (near, away): (Vector, Vector),
) -> Result<Vector, Refusal> {
    let centre = arc.as_arc().map_or(near, |arc| arc.centre);
    let radius = arc.radius().unwrap_or(0.0);
    let along = line.start_direction();
    let foot = line.from.plus(along.times(centre.minus(line.from).dot(along)));
    let height = foot.minus(centre).length();
    let square = (radius - height) * (radius + height);
    if square < -1e-6 {
        return Err(Refusal::Unsupported("an offset in which a line misses an arc".into()));
    }
    let half = math::sqrt(square.max(0.0));
    let crossings = [-half, half].map(|half| foot.plus(along.times(half)));
    let [one, other] = crossings;
    let further = one.minus(near).length() - other.minus(near).length();
    let is_one = if further.abs() <= 1e-9 {
        one.minus(near).dot(away) >= other.minus(near).dot(away)
    } else {
        further < 0.0
    };
    Ok(if is_one { one } else { other })
}

/// Ends the run where a step has turned a piece over: a pit that is too narrow, or a spike.
fn check_turned_over(pieces: &[Piece]) -> Result<(), Refusal> {
    let is_turned = |piece: &Piece| piece.to.p < piece.from.p - SHORTEST;
    if pieces.iter().any(is_turned) {
        return Err(Refusal::Unsupported("a profile with a pit too narrow for its offset".into()));
    }
    Ok(())
}

/// Drops pieces that are too short; their neighbours end and begin at their intersection.
fn drop_short(pieces: &mut Vec<Piece>, joins_parallels: bool) -> Result<(), Refusal> {
    let mut place = 0;
    while let Some(piece) = pieces.get(place).copied() {
        if piece.chord() >= SHORTEST {
            place = place.saturating_add(1);
            continue;
        }
        pieces.remove(place);
        let Some(before) = place.checked_sub(1) else { continue };
        if let Some([last, next]) = pieces.get_mut(before..).and_then(|rest| rest.get_mut(..2)) {
            let middle = piece.from.plus(piece.to).times(0.5);
            let point = intersection(last, next, middle, joins_parallels)?;
            (last.to, next.from) = (point, point);
        }
    }
    Ok(())
}
