//! The offset of a profile: in steps that are short enough, each followed by joining neighbours.

use alloc::vec::Vec;

use gaugeblock_vocabulary::FaultKind;

use crate::limits::Limit;
use crate::math;

use super::super::refusal::{Refusal, refuse};
use super::super::vector::Vector;
use super::piece::{Arc, Curve, Piece, ROUNDING};
use super::rounding::SHORTEST;

/// The ends of two pieces differ by more than this in travel where an arc joins them; program units.
const GAP: f64 = 0.01;
/// The radii of both ends of an arc differ by no more than this; program units.
const CIRCLE: f64 = 1e-6;
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
        if self.steps == 1 && !self.pieces.iter().all(ends_on_its_circle) {
            return open("an arc that ends elsewhere than its radius, with a distance");
        }
        let step = self.left.min(longest_step(&self.pieces));
        let mut joined = moved_and_joined(&self.pieces, step * self.side, self.joins_parallels)?;
        self.left -= step;
        drop_short(&mut joined, self.joins_parallels)?;
        if joined.iter().any(Moved::is_turned_over) {
            return open("a profile with a piece too short for its offset");
        }
        if joined.len() > self.pieces_max {
            return Err(Refusal::LimitExceeded(Limit::ProfileMoves));
        }
        self.pieces.clear();
        self.pieces.extend(joined.iter().map(|moved| moved.piece));
        Ok(self.left <= 0.0)
    }
}

/// Ends the run at what `docs/turning.md` leaves open.
fn open<T>(why: &str) -> Result<T, Refusal> {
    Err(Refusal::Unspecified(why.into()))
}

/// Whether both ends of an arc have one radius.
fn ends_on_its_circle(piece: &Piece) -> bool {
    let Some(arc) = piece.as_arc() else { return true };
    let [from, to] = [piece.from, piece.to].map(|end| end.minus(arc.centre).length());
    (from - to).abs() <= CIRCLE
}

/// The longest step: half of the shortest chord, and of the least radius.
fn longest_step(pieces: &[Piece]) -> f64 {
    let of = |piece: &Piece| piece.chord().min(piece.radius().unwrap_or(f64::INFINITY)) / 2.0;
    pieces.iter().map(of).fold(f64::INFINITY, f64::min)
}

/// A piece of a step.
#[derive(Clone, Copy, Debug)]
struct Moved {
    /// The part between its joints.
    piece: Piece,
    /// The piece before its ends were joined, which has a direction.
    whole: Piece,
}

impl Moved {
    fn new(whole: Piece) -> Self {
        Self { piece: whole, whole }
    }

    /// Whether its joints have passed each other, so that it runs backwards.
    fn is_turned_over(&self) -> bool {
        let Self { piece, whole } = self;
        match whole.curve {
            Curve::Line | Curve::Traverse => {
                piece.to.minus(piece.from).dot(whole.start_direction()) < 0.0
            }
            Curve::Arc(arc) => {
                let turned = |from: Vector, to: Vector| {
                    from.minus(arc.centre).angle_to(to.minus(arc.centre)) * arc.sense
                };
                whole.sweep() - turned(whole.from, piece.from) + turned(whole.to, piece.to) < 0.0
            }
        }
    }
}

/// The pieces at a distance to the left, joined.
fn moved_and_joined(
    pieces: &[Piece],
    distance: f64,
    joins_parallels: bool,
) -> Result<Vec<Moved>, Refusal> {
    let mut joined: Vec<Moved> = Vec::with_capacity(pieces.len());
    let mut before: Option<&Piece> = None;
    for piece in pieces {
        let mut next = Moved::new(parallel(piece, distance));
        if let (Some(before), Some(last)) = (before, joined.last_mut()) {
            let corner = Corner {
                point: piece.from,
                ends: before.end_direction(),
                begins: piece.start_direction(),
                distance,
                joins_parallels,
            };
            let joint = corner.join(last, &mut next)?;
            joined.extend(joint);
        }
        joined.push(next);
        before = Some(piece);
    }
    Ok(joined)
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

/// Where two pieces met before a step.
struct Corner {
    point: Vector,
    /// The direction of the first one at its end.
    ends: Vector,
    /// The direction of the second one at its start.
    begins: Vector,
    /// The step, to the left.
    distance: f64,
    joins_parallels: bool,
}

impl Corner {
    /// Joins both pieces: an arc comes between them, or they end and begin at their intersection.
    fn join(&self, last: &mut Moved, next: &mut Moved) -> Result<Option<Moved>, Refusal> {
        let turn = self.ends.cross(self.begins);
        if turn.abs() <= ROUNDING && self.ends.dot(self.begins) < 0.0 {
            return open("an offset of moves that go back on themselves");
        }
        let (ends, begins) = (last.whole.to, next.whole.from);
        if turn * self.distance < 0.0 && (ends.p - begins.p).abs() > GAP {
            let sense = if self.distance > 0.0 { -1.0 } else { 1.0 };
            let curve = Curve::Arc(Arc { centre: self.point, sense });
            return Ok(Some(Moved::new(Piece { from: ends, to: begins, curve })));
        }
        // Tangent curves still meet, and their intersection would lose half of the digits.
        let is_arc = last.whole.as_arc().or(next.whole.as_arc()).is_some();
        let point = if is_arc && ends.minus(begins).length() <= ROUNDING {
            begins
        } else {
            intersection(&last.whole, &next.whole, self.point, self.joins_parallels)?
        };
        (last.piece.to, next.piece.from) = (point, point);
        Ok(None)
    }
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
            open("an offset of two arcs that meet in a corner")
        }
    }
}

fn two_lines(first: &Piece, second: &Piece, joins_parallels: bool) -> Result<Vector, Refusal> {
    let (along, across) = (first.start_direction(), second.start_direction());
    let turn = along.cross(across);
    if turn.abs() <= 1e-12 && along.dot(across) < 0.0 {
        return open("an offset of moves that go back on themselves");
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
        return open("an offset in which a line misses an arc");
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

/// Drops pieces that are too short; their neighbours end and begin at their intersection. The first point and the last
/// one are not moved, so that the pieces at them have to stay. What `rs274` does after an arc is open. Before an arc it
/// is open, too, unless nothing is left of the piece.
fn drop_short(pieces: &mut Vec<Moved>, joins_parallels: bool) -> Result<(), Refusal> {
    let mut place = 0_usize;
    while let Some(dropped) = pieces.get(place).copied() {
        if dropped.piece.chord() >= SHORTEST {
            place = place.saturating_add(1);
            continue;
        }
        let before = place.checked_sub(1).filter(|_| place.saturating_add(1) < pieces.len());
        let Some(before) = before else {
            return open("a first or last piece that its offset makes too short");
        };
        pieces.remove(place);
        let is_arc =
            |place: usize| pieces.get(place).is_some_and(|moved| moved.whole.as_arc().is_some());
        let has_length = dropped.piece.chord() > ROUNDING;
        if !joins_parallels && (is_arc(before) || is_arc(place) && has_length) {
            return open("a piece next to an arc that its offset makes too short");
        }
        if let Some([last, next]) = pieces.get_mut(before..).and_then(|rest| rest.get_mut(..2)) {
            let middle = dropped.piece.from.plus(dropped.piece.to).times(0.5);
            let point = intersection(&last.whole, &next.whole, middle, joins_parallels)?;
            (last.piece.to, next.piece.from) = (point, point);
        }
        // The one before may be too short now.
        place = before;
    }
    Ok(())
}
