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
        Curve::Line | Curve::NoCircle => chord,
        Curve::Arc { centre, .. } => chord.min(centre.distance(piece.start) / 2.0),
    }
}

/// A piece of a step, cut or extended at its neighbours.
struct Part {
    /// The piece at its distance, before its neighbours cut or extend it. It has a direction.
    whole: Piece,
    start: Point,
    end: Point,
}

impl Part {
    fn of(whole: Piece) -> Self {
        Self { whole, start: whole.start, end: whole.end }
    }

    fn is_arc(&self) -> bool {
        matches!(self.whole.curve, Curve::Arc { .. })
    }

    fn piece(&self) -> Piece {
        Piece { start: self.start, end: self.end, ..self.whole }
    }

    /// Whether it leads from its end to its start: it is so short that its neighbours pass one another.
    fn is_turned_over(&self) -> bool {
        match self.whole.curve {
            Curve::Line | Curve::NoCircle => {
                self.start.to(self.end).along(self.whole.leaves()) < 0.0
            }
            // It would lead around the rest of its circle.
            Curve::Arc { .. } => self.piece().sweep() > self.whole.sweep() + math::TURN / 2.0,
        }
    }
}

/// One step: each piece is moved, then neighbours are joined. Neither the first nor the last point is extended.
fn step(pieces: &[Piece], distance: f64) -> Result<Vec<Piece>, StepError> {
    let mut parts: Vec<Part> = Vec::with_capacity(pieces.len());
    for (place, piece) in pieces.iter().enumerate() {
        let mut next = Part::of(shift(piece, distance));
        if let Some(last) = parts.last_mut() {
            let pair = &pieces[place - 1..=place];
            if is_outer(pair, [last.whole.end, next.whole.start], distance)? {
                let round = Curve::Arc { centre: piece.start, sense: -distance.signum() };
                let whole = Piece { start: last.end, end: next.start, curve: round };
                parts.push(Part::of(whole));
            } else {
                let point = meeting(&last.whole, &next.whole, piece.start)?;
                last.end = point;
                next.start = point;
            }
        }
        parts.push(next);
    }
    without_short(&mut parts)?;
    if parts.iter().any(Part::is_turned_over) {
        return Err(open("pieces that a step towards the distance turns over"));
    }
    Ok(parts.iter().map(Part::piece).collect())
}

/// A piece at a distance to its left: a parallel line, or an arc about the same centre.
fn shift(piece: &Piece, distance: f64) -> Piece {
    let away = |point: Point, direction: Point| point.plus(distance, direction.left());
    let (start, end) = (away(piece.start, piece.leaves()), away(piece.end, piece.arrives()));
    Piece { start, end, ..*piece }
}

/// Whether a corner turns away from the side of the offset, so that an arc about it joins both moved pieces.
fn is_outer(pair: &[Piece], ends: [Point; 2], distance: f64) -> Result<bool, StepError> {
    let (from, to) = (pair[0].arrives(), pair[1].leaves());
    let turn = from.turn_to(to);
    if turn.abs() <= ROUNDING && from.along(to) < 0.0 {
        return Err(open("moves that go back on themselves, with a distance"));
    }
    Ok(turn * distance < 0.0 && (ends[1].w - ends[0].w).abs() > SHORTEST_JOIN)
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

/// Drops pieces that have become too short; their neighbours intersect, and may be too short then. After an arc this is
/// open, and in front of one, too, unless nothing is left of the piece.
fn without_short(parts: &mut Vec<Part>) -> Result<(), StepError> {
    while let Some(place) = parts.iter().position(|part| part.piece().chord() < SHORTEST) {
        if place == 0 || place + 1 == parts.len() {
            return Err(open("a first or last piece that the distance makes too short"));
        }
        let has_length = parts[place].piece().chord() > ROUNDING;
        if parts[place - 1].is_arc() || parts[place + 1].is_arc() && has_length {
            return Err(open("a piece next to an arc that the distance makes too short"));
        }
        let dropped = parts.remove(place);
        let middle = dropped.start.middle(dropped.end);
        let point = meeting(&parts[place - 1].whole, &parts[place].whole, middle)?;
        parts[place - 1].end = point;
        parts[place].start = point;
    }
    Ok(())
}
