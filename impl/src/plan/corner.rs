//! What becomes of the corner between two legs: a stop, nothing, or a blend of lengths taken from both.

use super::leg::{Leg, norm};
use super::limits::{Limits, SMOOTH, least, squared};
use super::parameters::Axes;
use super::piece::{Pace, Piece};
use super::segment::Blend;
use crate::math;

/// How far an exact path may be left where its direction breaks by less than [`BREAK`], millimetres: arcs that are written
/// with five decimals never meet quite smoothly.
const EXACT: f64 = 1e-6;
/// The change of direction from which an exact path comes to rest, radians.
const BREAK: f64 = 0.05;
/// The share of the acceleration that a blend may cost where it has the length to choose.
const COST: f64 = 0.05;
/// The angle of an arc that is bent for a corner at most, radians: its acceleration is bounded over the whole of that.
const ROUND: f64 = 0.1;
/// How much of a tolerance is used: rounding has the rest.
const KEPT: f64 = 1.0 - 1e-9;
/// How unequal the two sides of a parabola may be; beyond, a line remains on the longer one.
const UNEQUAL: f64 = 1.1;

/// What may be done at a corner, before the lengths of its legs are shared out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Corner {
    #[default]
    Stop,
    /// The legs meet smoothly.
    Smooth,
    /// A blend may take so much of each leg, and not more than half of it if `half`.
    Blend { most: f64, half: bool },
}

/// The break of direction from one leg to the next.
pub(super) fn turn(before: &Leg, after: &Leg) -> Axes {
    let mut turn = after.first;
    for (turn, before) in turn.iter_mut().zip(&before.last) {
        *turn -= before;
    }
    turn
}

impl Corner {
    /// A parabola that takes d of both legs misses the corner by d·|turn|/4, and so does an arc that is bent.
    pub(super) fn between(before: &Leg, after: &Leg, limits: &Limits) -> Self {
        let turn = turn(before, after);
        let blend = stricter(before.blend, after.blend);
        let break_ = norm(&turn);
        if break_ < SMOOTH {
            return if blend == Blend::ExactStop { Self::Stop } else { Self::Smooth };
        }
        let (tolerance, half) = match blend {
            Blend::ExactStop => return Self::Stop,
            Blend::ExactPath if break_ > BREAK => return Self::Stop,
            Blend::ExactPath => (EXACT, false),
            Blend::Within(tolerance) => (tolerance, false),
            Blend::BetweenMidpoints => (f64::INFINITY, true),
        };
        // A blend that is long enough to cost nothing need not be longer.
        let fastest = pressing(before).min(pressing(after));
        let enough = fastest / (2.0 * COST * least(&limits.acceleration, &turn, turn.len()));
        let most = (4.0 * KEPT * tolerance / break_).min(enough);
        let most = most.min(round(before)).min(round(after));
        if most > 0.0 { Self::Blend { most, half } } else { Self::Stop }
    }
}

/// The most of an arc that is bent for a corner.
fn round(leg: &Leg) -> f64 {
    leg.whole.circle.map_or(f64::INFINITY, |circle| ROUND / circle.turn)
}

/// The highest square of speed that a leg is ever run at, overrides up to 2.
fn pressing(leg: &Leg) -> f64 {
    match leg.whole.pace {
        Pace::Second => leg.whole.ceiling.min(squared(2.0 * leg.whole.feed)),
        Pace::Rapid | Pace::Turn => leg.whole.ceiling,
    }
}

/// How much of each leg a blend takes, given what there is: equal lengths, or nearly so between lines.
pub(super) fn share(most: f64, (before, after): (f64, f64), lines: bool) -> (f64, f64) {
    let (before, after) = (most.min(before), most.min(after));
    let short = before.min(after);
    let near = lines && before.max(after) <= UNEQUAL * short;
    if near { (before, after) } else { (short, short) }
}

/// The parabola between two lines that takes d of the first and e of the second.
pub(super) fn parabola(before: &Leg, after: &Leg, (d, e): (f64, f64), limits: &Limits) -> Piece {
    let mut blend = after.whole;
    blend.length = 2.0 * d;
    blend.exit = e / d;
    blend.axes = before.whole.axes.max(after.whole.axes);
    blend.origin = before.whole.end;
    blend.rate = before.last;
    let ends = blend.end.iter_mut().zip(&before.whole.end).zip(&after.first);
    for ((end, corner), direction) in ends {
        *end = corner + e * direction;
    }
    for ((origin, bend), (from, to)) in
        blend.origin.iter_mut().zip(&mut blend.bend).zip(before.last.iter().zip(&after.first))
    {
        *origin -= d * from;
        *bend = (blend.exit * to - from) / blend.length;
    }
    blend.begins = Some(d);
    limits.rule(&mut blend);
    slower(&mut blend, &before.whole);
    blend.feed /= blend.exit.max(1.0);
    blend
}

/// The last d of the leg before a corner, bent by half of its turn.
pub(super) fn bent_end(leg: &Leg, turn: &Axes, d: f64, limits: &Limits) -> Piece {
    let length = leg.whole.length;
    let mut piece = leg.whole.part(length - d, length);
    for ((bend, end), turn) in piece.bend.iter_mut().zip(&mut piece.end).zip(turn) {
        *bend += turn / (2.0 * d);
        *end += turn * d / 4.0;
    }
    finish(&mut piece, turn, d, limits);
    piece
}

/// The first d of the leg after a corner, bent by the other half.
pub(super) fn bent_start(leg: &Leg, turn: &Axes, d: f64, limits: &Limits) -> Piece {
    let mut piece = leg.whole.part(0.0, d);
    for (((origin, rate), bend), turn) in
        piece.origin.iter_mut().zip(&mut piece.rate).zip(&mut piece.bend).zip(turn)
    {
        *origin += turn * d / 4.0;
        *rate -= turn / 2.0;
        *bend += turn / (2.0 * d);
    }
    piece.begins = Some(0.0);
    finish(&mut piece, turn, d, limits);
    piece
}

/// An arc that is bent may be a little longer than it was, and its feed is along the path.
fn finish(piece: &mut Piece, turn: &Axes, d: f64, limits: &Limits) {
    let last = turn.iter().rposition(|turn| turn.abs() > 0.0);
    piece.axes = piece.axes.max(last.map_or(0, |last| last.saturating_add(1)));
    let turned = piece.circle.map_or(0.0, |circle| circle.turn * d);
    piece.feed /= math::sqrt(1.0 + turned * norm(turn));
    limits.rule(piece);
}

/// What may happen at a corner between two modes: a leg that is to be exact is so from its beginning.
fn stricter(before: Blend, after: Blend) -> Blend {
    match (before, after) {
        (Blend::Within(_) | Blend::BetweenMidpoints, Blend::ExactStop | Blend::ExactPath) => {
            Blend::ExactPath
        }
        _ => before,
    }
}

/// A blend has the slower of both feeds.
fn slower(blend: &mut Piece, other: &Piece) {
    if other.pace != Pace::Rapid && (blend.pace == Pace::Rapid || other.feed < blend.feed) {
        blend.feed = other.feed;
        blend.pace = other.pace;
    }
}
