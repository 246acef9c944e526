//! The profile at a distance: each piece parallel to its own, corners joined.

use super::piece::{Curve, Piece};
use super::point::Point;
use super::{ROUNDING, SHORTEST, SHORTEST_JOIN, open};
use crate::math;
use crate::rs274::refusal::StepError;

/// The most steps in which a distance is applied.
const MOST_STEPS: u32 = 10_000;

/// Whether a positive distance is to the left of the pieces after the lead, towards greater u. `rises` says which side
/// that is if the lead and the profile are in line: whether the profile ends no lower than it starts.
///
/// Rules turning.finishing-side and turning.roughing-distance. A positive distance is towards the start position.
///
/// # Errors
/// One piece alone: which side that is remains open.
pub(crate) fn left_of(lead: &Piece, pieces: &[Piece], rises: bool) -> Result<bool, StepError> {
    let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else { return Ok(rises) };
    if pieces.len() == 1 {
        return Err(open("the side of the distance from a profile of one piece"));
    }
    let (approach, ahead) = (lead.start.to(first.start), first.start.to(last.start));
    let turn = ahead.turn_to(approach);
    if turn.abs() > 0.0 && turn.abs() <= ROUNDING {
        return Err(open("the side of the distance where the lead is in line within rounding"));
    }
    Ok(if turn == 0.0 { rises } else { turn < 0.0 })
}

/// The pieces at a distance to their left; a negative one is to their right.
///
/// The distance is applied in steps of at most half the chord of the shortest piece and half the radius of the smallest
/// arc. The pieces that result from a step are those of the next one.
///
/// # Errors
/// What is open: pieces that a step turns over, corners of two arcs, arcs that do not end on their circle.
pub(crate) fn offset(pieces: &[Piece], distance: f64) -> Result<Vec<Piece>, StepError> {
    let mut pieces = pieces.to_vec();
    let mut left = distance.abs();
    if left > 0.0 {
        pieces.iter().try_for_each(check_circle)?;
    }
    for _ in 0..MOST_STEPS {
        if left <= 0.0 {
            return Ok(pieces);
        }
        let most = pieces.iter().map(longest_step).fold(left, f64::min);
        pieces = step(&pieces, most.copysign(distance))?;
        left -= most;
    }
    Err(open("a distance from the profile that takes more steps than are made here"))
}

/// An arc ends at its radius.
fn check_circle(piece: &Piece) -> Result<(), StepError> {
    let Curve::Arc { centre, .. } = piece.curve else { return Ok(()) };
    if (centre.distance(piece.start) - centre.distance(piece.end)).abs() > LEAST_CORNER {
        return Err(open("an arc that ends elsewhere than at its radius, with a distance"));
    }
    Ok(())
}

/// Distance between two offset ends, active length unit, up to which a corner is tangent.
const LEAST_CORNER: f64 = 1e-6;

/// Half of the chord, and half of the radius of an arc.
fn longest_step(piece: &Piece) -> f64 {
    let chord = piece.chord() / 2.0;
    match piece.curve {
        Curve::Line => chord,
        Curve::Arc { centre, .. } => chord.min(centre.distance(piece.start) / 2.0),
    }
}

/// One step: each piece is moved, then neighbours are joined. Neither the first nor the last point is extended.
fn step(pieces: &[Piece], distance: f64) -> Result<Vec<Piece>, StepError> {
    let moved: Vec<Piece> = pieces.iter().map(|piece| shift(piece, distance)).collect();
    let mut joined: Vec<Piece> = moved.first().copied().into_iter().collect();
    for (pair, next) in pieces.windows(2).zip(&moved[1..]) {
        let corner = pair[1].start;
        let mut next = *next;
        let last = joined.last_mut().expect("offset: a first piece is there");
        if is_outer(pair, last.end, next.start, distance) {
            let sense = -distance.signum();
            let round = Curve::Arc { centre: corner, sense };
            let join = Piece { start: last.end, end: next.start, curve: round };
            joined.extend([join, next]);
            continue;
        }
        let point = meeting(last, &next, corner)?;
        last.end = point;
        next.start = point;
        joined.push(next);
    }
    without_short(&mut joined)?;
    pieces_keep_direction(pieces, &joined)?;
    Ok(joined)
}

/// A piece at a distance to its left: a parallel line, or an arc about the same centre.
fn shift(piece: &Piece, distance: f64) -> Piece {
    let away = |point: Point, direction: Point| point.plus(distance, direction.left());
    let (start, end) = (away(piece.start, piece.leaves()), away(piece.end, piece.arrives()));
    Piece { start, end, ..*piece }
}

/// Whether a corner turns away from the side of the offset so that an arc about it joins both ends.
fn is_outer(pair: &[Piece], end: Point, start: Point, distance: f64) -> bool {
    let turn = pair[0].arrives().turn_to(pair[1].leaves());
    turn * distance < 0.0 && (start.w - end.w).abs() > SHORTEST_JOIN
}

/// The point where two offset pieces intersect, the one next to their corner.
fn meeting(before: &Piece, next: &Piece, corner: Point) -> Result<Point, StepError> {
    let is_line = |piece: &Piece| piece.curve == Curve::Line;
    if is_line(before) && is_line(next) {
        return crossing(before, next);
    }
    if before.end.distance(next.start) <= LEAST_CORNER {
        return Ok(if is_line(next) { next.start } else { before.end });
    }
    match (before.curve, next.curve) {
        (Curve::Line, Curve::Arc { centre, .. }) => on_circle(before, next, centre, corner),
        (Curve::Arc { centre, .. }, Curve::Line) => on_circle(next, before, centre, corner),
        (_, _) => Err(open("two arcs that meet in a corner, with a distance")),
    }
}

/// The point where two lines intersect; where one goes on in the direction of the other, the point where they meet.
fn crossing(before: &Piece, next: &Piece) -> Result<Point, StepError> {
    let (along, other) = (before.leaves(), next.leaves());
    let turn = along.turn_to(other);
    if turn.abs() <= ROUNDING {
        let meet = before.end.distance(next.start) <= LEAST_CORNER;
        return if meet { Ok(before.end) } else { Err(open("parallel pieces, with a distance")) };
    }
    let way = before.start.to(next.start).turn_to(other) / turn;
    Ok(before.start.plus(way, along))
}

/// The point next to a corner where a line crosses the circle of an arc.
fn on_circle(line: &Piece, arc: &Piece, centre: Point, corner: Point) -> Result<Point, StepError> {
    let along = line.leaves();
    let foot = line.start.plus(line.start.to(centre).along(along), along);
    let (radius, apart) = (centre.distance(arc.start), centre.distance(foot));
    if apart > radius + LEAST_CORNER {
        return Err(open("offset pieces that do not meet at their corner"));
    }
    let half = math::other_leg(radius.max(apart), apart);
    let candidates = [foot.plus(half, along), foot.plus(-half, along)];
    let [one, other] = candidates.map(|point| point.distance(corner));
    Ok(if one <= other { candidates[0] } else { candidates[1] })
}

/// Drops pieces that have become too short; their neighbours intersect.
fn without_short(pieces: &mut Vec<Piece>) -> Result<(), StepError> {
    let mut place = 0;
    while place < pieces.len() {
        if pieces[place].chord() >= SHORTEST {
            place += 1;
            continue;
        }
        if place == 0 || place + 1 == pieces.len() {
            return Err(open("a first or last piece that the distance makes too short"));
        }
        let dropped = pieces.remove(place);
        let middle = dropped.start.middle(dropped.end);
        let point = meeting(&pieces[place - 1], &pieces[place], middle)?;
        pieces[place - 1].end = point;
        pieces[place].start = point;
    }
    Ok(())
}

/// Refuses to say what becomes of pieces that a step turns over.
fn pieces_keep_direction(before: &[Piece], after: &[Piece]) -> Result<(), StepError> {
    let is_turned_over = |piece: &Piece| match piece.curve {
        Curve::Line => false,
        Curve::Arc { .. } => piece.sweep() > math::TURN * 0.75,
    };
    let lines = |pieces: &[Piece]| -> Vec<Point> {
        let lines = pieces.iter().filter(|piece| piece.curve == Curve::Line);
        lines.map(Piece::leaves).collect()
    };
    let (from, to) = (lines(before), lines(after));
    let same = |to: &Point| from.iter().any(|from| from.along(*to) > 1.0 - LEAST_CORNER);
    if after.iter().any(is_turned_over) || !to.iter().all(same) {
        return Err(open("pieces that a step towards the distance turns over"));
    }
    Ok(())
}
