//! A queued segment as one element, or several segments merged into one, before its corners are known.

use crate::error::NotQueued;
use crate::feed_path::{FeedPath, feed_path_ratios};
use crate::limits::{Limits, squared};
use crate::math;
use crate::parameters::Axes;
use crate::path_element::{Circle, FeedBasis, PathElement};
use crate::segment::{Feed, Path, PathControl, Segment};
use crate::vector::{cross, dot, norm};

/// A shorter segment moves nothing: rounding leaves as much. The next segment includes it.
const ZERO_LENGTH_MM: f64 = 1e-10;

/// Feeds that differ by less than this ratio are equal.
const FEED_TOLERANCE_RATIO: f64 = 1e-12;

/// A segment from corner to corner, or several merged ones.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NominalSegment {
    /// All of it, with its acceleration model.
    pub(crate) whole: PathElement,
    /// p' at its ends.
    pub(crate) start_tangent: Axes,
    pub(crate) end_tangent: Axes,
    /// What may happen at its end.
    pub(crate) path_control: PathControl,
    /// The axes along which the feed is measured, and the greatest ratio of that path to the parameter.
    pub(crate) feed_path: FeedPath,
    pub(crate) feed_path_ratio: f64,
    /// The length that the corner at its start uses.
    pub(crate) start_trim: f64,
    /// The lengths of the first and the last segment that are merged in it: a blend may end at their midpoints.
    pub(crate) start_length: f64,
    pub(crate) end_length: f64,
    /// Whether several segments are merged in it, and how far it deviates from them at most, millimetres.
    pub(crate) is_merged: bool,
    pub(crate) merge_deviation: f64,
    /// Whether its start must stay where it is.
    pub(crate) is_separate: bool,
}

/// A segment after its end is known.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ResolvedSegment {
    Moves,
    /// It moves nothing.
    ZeroLength,
    /// A stop for so many seconds.
    Dwell(f64),
}

/// Reads a segment that begins at a position. If it moves, it is written to `merged`.
pub(crate) fn resolve(
    segment: &Segment,
    (merged, start): (&mut NominalSegment, &Axes),
    limits: &Limits,
) -> Result<ResolvedSegment, NotQueued> {
    let whole = &mut merged.whole;
    whole.begin_at(start);
    whole.smoothing = limits.smoothing;
    match segment.path {
        Path::Dwell { seconds } if seconds >= 0.0 && seconds.is_finite() => {
            return Ok(ResolvedSegment::Dwell(seconds));
        }
        Path::Dwell { .. } => return Err(NotQueued::Malformed),
        Path::Straight { end } => set_line(whole, &end)?,
        Path::Arc { end, centre, normal, angle } => set_arc(whole, &end, &centre, &normal, angle)?,
    }
    let tolerated = match segment.path_control {
        PathControl::Within(tolerance) => tolerance >= 0.0,
        PathControl::ExactStop | PathControl::ExactPath | PathControl::BetweenMidpoints => true,
    };
    let (feed_path, ratios) = feed_path_ratios(whole);
    (merged.feed_path, merged.feed_path_ratio) = (feed_path, ratios.1);
    if !tolerated || !set_feed(whole, segment.feed, ratios) {
        return Err(NotQueued::Malformed);
    }
    if whole.length <= ZERO_LENGTH_MM {
        return Ok(ResolvedSegment::ZeroLength);
    }
    whole.number = segment.number;
    whole.probing = segment.probing;
    if whole.circle.is_none() {
        limits.assign_line_model(whole);
    } else {
        limits.assign_model(whole);
    }
    let may_move = whole.start_limit_sq > 0.0 && whole.start_limit_sq < f64::INFINITY;
    if !may_move {
        return Err(NotQueued::Malformed);
    }
    merged.start_tangent = whole.tangent;
    merged.end_tangent = whole.tangent;
    if whole.circle.is_some() {
        merged.start_tangent = whole.tangent_at(0.0);
        merged.end_tangent =
            whole.tangent_at(whole.length).map(|rate| rate / whole.end_speed_ratio);
    }
    merged.path_control =
        if segment.probing { PathControl::ExactStop } else { segment.path_control };
    (merged.start_trim, merged.merge_deviation, merged.is_merged) = (0.0, 0.0, false);
    (merged.start_length, merged.end_length) = (whole.length, whole.length);
    Ok(ResolvedSegment::Moves)
}

impl NominalSegment {
    /// Whether both have the same feed, except for rounding.
    #[inline]
    pub(crate) fn has_same_feed(&self, next: &Self) -> bool {
        let (one, other) = (&self.whole, &next.whole);
        let near = (one.feed - other.feed).abs() <= FEED_TOLERANCE_RATIO * one.feed.min(other.feed);
        one.feed_basis == other.feed_basis && (near || one.feed.to_bits() == other.feed.to_bits())
    }

    /// The factor, at most 1, of its feed between its own direction and that of a segment next to it, where p' is
    /// `tangent`. Each feed is kept by its own measure: millimetres along the axes, or degrees.
    pub(crate) fn feed_ratio_next_to(&self, other: &Self, tangent: &Axes) -> f64 {
        // Between two directions the path has no more of the feed's axes than at one of them.
        let there = if self.feed_path == other.feed_path {
            other.feed_path_ratio
        } else {
            self.feed_path.part_of(tangent)
        };
        self.feed_path_ratio / self.feed_path_ratio.max(there)
    }

    /// The highest squared speed at which it is ever run, for overrides up to 2.
    pub(crate) fn max_speed_sq(&self) -> f64 {
        match self.whole.feed_basis {
            FeedBasis::PerSecond => self.whole.start_limit_sq.min(squared(2.0 * self.whole.feed)),
            FeedBasis::Rapid | FeedBasis::PerTurn => self.whole.start_limit_sq,
        }
    }
}

pub(crate) fn set_line(whole: &mut PathElement, end: &Axes) -> Result<(), NotQueued> {
    whole.end = *end;
    let mut sum = 0.0;
    let motion = whole.tangent.iter_mut().zip(&whole.origin).zip(end);
    for ((rate, start), end) in motion {
        *rate = end - start;
        sum += *rate * *rate;
    }
    // A length that is NaN or infinite is refused.
    whole.length = math::sqrt(sum);
    if !whole.length.is_finite() {
        return Err(NotQueued::Malformed);
    }
    if sum > 0.0 {
        let inverse = 1.0 / whole.length;
        whole.tangent = whole.tangent.map(|value| value * inverse);
    }
    whole.axis_count = used_axis_count(&whole.tangent);
    Ok(())
}

/// The circle goes through the start. Where the end is not on it, the difference is spread evenly.
fn set_arc(
    whole: &mut PathElement,
    end: &Axes,
    centre: &[f64; 3],
    normal: &[f64; 3],
    angle: f64,
) -> Result<(), NotQueued> {
    let start = whole.origin;
    let numbers = end.iter().chain(centre).chain(normal);
    if !numbers.chain([&angle]).all(|value| value.is_finite()) {
        return Err(NotQueued::Malformed);
    }
    let mut radius = [0.0; 3];
    for ((radius, start), centre) in radius.iter_mut().zip(&start).zip(centre) {
        *radius = start - centre;
    }
    let height = dot(&radius, normal);
    for (radius, normal) in radius.iter_mut().zip(normal) {
        *radius -= height * normal;
    }
    let sense = if angle < 0.0 { -1.0 } else { 1.0 };
    let across = cross(normal, &radius).map(|value| sense * value);
    let (sine, cosine) = math::sin_cos(angle.abs());
    let size = math::sqrt(dot(&radius, &radius));
    if size <= 0.0 || angle.abs() <= 0.0 {
        return Err(NotQueued::Malformed);
    }
    let mut last = [0.0; 3];
    for ((last, end), centre) in last.iter_mut().zip(end).zip(centre) {
        *last = end - centre;
    }
    let rise = dot(&last, normal);
    let grown = math::sqrt((dot(&last, &last) - rise * rise).max(0.0)) / size;
    // The part that is not on the circle: the helix and other axes.
    let mut even = *end;
    for (even, start) in even.iter_mut().zip(&start) {
        *even -= start;
    }
    for ((even, along), across) in even.iter_mut().zip(&radius).zip(&across) {
        *even -= grown * (along * cosine + across * sine) - along;
    }
    let turned = size * math::hypotenuse(angle, grown - 1.0);
    let length = math::hypotenuse(turned, norm(&even));
    for (origin, radius) in whole.origin.iter_mut().zip(&radius) {
        *origin -= radius;
    }
    whole.tangent = even.map(|value| value / length);
    let (angle_rate, growth) = (angle.abs() / length, (grown - 1.0) / length);
    whole.circle = Some(Circle { cosine: radius, sine: across, angle_rate, growth });
    whole.axis_count = used_axis_count(&whole.tangent);
    (whole.end, whole.length) = (*end, length);
    whole.end_speed_ratio = norm(&whole.tangent_at(length));
    Ok(())
}

/// Sets the parameter's speed for a feed, given the ratios of the path that it is measured along. Returns whether the
/// feed is positive.
fn set_feed(whole: &mut PathElement, feed: Feed, (least, most): (f64, f64)) -> bool {
    let (feed_basis, speed) = match feed {
        Feed::Rapid => (FeedBasis::Rapid, f64::INFINITY),
        Feed::PerSecond(feed) => (FeedBasis::PerSecond, feed / most),
        Feed::InTime(seconds) => (FeedBasis::PerSecond, whole.length / seconds * least / most),
        Feed::PerTurn(feed) => (FeedBasis::PerTurn, feed / most),
    };
    whole.feed_basis = feed_basis;
    whole.feed = speed;
    let has_no_length = whole.length <= 0.0;
    has_no_length || speed > 0.0
}

/// How many leading axes include all that move.
fn used_axis_count(rate: &Axes) -> usize {
    let last = rate.iter().rposition(|rate| rate.abs() > 0.0);
    last.map_or(0, |last| last.saturating_add(1)).max(3)
}
