//! The corner between two segments: a stop, a smooth transition, a break of the tangent, or a blend.

use crate::limits::{Limits, SMOOTH_BREAK_MAX_RAD, least, squared};
use crate::math;
use crate::nominal_segment::NominalSegment;
use crate::parameters::Axes;
use crate::path_element::{AccelerationModel, FeedBasis, PathElement};
use crate::round_corner::{ROUND_CHANGE_MIN, RoundCorner};
use crate::segment::PathControl;
use crate::tangent_break::TangentBreak;
use crate::vector::{norm, norm_of};

/// From this change of direction on, an exact path stops at the corner.
const EXACT_PATH_BREAK_MAX_RAD: f64 = 0.05;
/// The share of the acceleration that a blend may cost where its length is free, and where a longer one costs time. An
/// override of 2 takes four times as much.
const BLEND_ACCELERATION_RATIO: f64 = 0.05;
const SLOW_BLEND_ACCELERATION_RATIO: f64 = 0.2;
/// The spindle speed, in revolutions per second, that decides how long a blend with a rapid move is. The real speed is
/// not known when the blend is made; up to four times as much costs nothing.
const ASSUMED_SPINDLE_SPEED: f64 = 10.0;
/// The greatest angle of an arc that is blended at a corner: its acceleration is bounded over all of it.
const BLENDED_ARC_ANGLE_MAX_RAD: f64 = 0.1;
/// The share of a tolerance that is used; the rest is for rounding.
const TOLERANCE_USE_RATIO: f64 = 1.0 - 1e-9;
/// A blend that turns by less than this, and that is longer than an axis moves from rest in the second number of
/// cycles, may be split, so that the motion can speed up and slow down in it.
const FLAT_BLEND_ANGLE_MAX_RAD: f64 = 0.2;
const SPLIT_BLEND_CYCLES_MIN: f64 = 4.0;
/// Two feeds are unequal, where that decides the length of a blend, if the squared speeds have at most this ratio.
const UNEQUAL_FEED_RATIO_MAX: f64 = 0.9;
/// Rounding of the ratio of the path that the feed is measured along to the length.
const FEED_PATH_RATIO_ROUNDING: f64 = 1e-9;
/// For how many cycles a segment must last for that: at its own speed or at the other one's, or at the blend's.
const UNEQUAL_FEED_CYCLES_MIN: f64 = 0.25;
const SLOW_BLEND_CYCLES_MIN: f64 = 2.0;
/// How unequal the two sides of a parabola may be. Beyond, a line remains on the longer side. A feed limit makes the
/// parabola slower by this ratio, but chords with rounded ends are never quite equal, and the remaining lines would
/// fill a cycle with tiny elements.
const PARABOLA_SIDE_RATIO_MAX: f64 = 1.02;

/// What is possible at a corner, before the lengths of its segments are divided.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum Corner {
    #[default]
    Stop,
    /// The segments meet tangentially.
    Smooth,
    /// The path is exact, and its direction changes so little that the motion need not stop.
    TangentBreak(TangentBreak),
    /// A blend may use up to `most` of each segment, and with `half` at most half of each. It may also be round.
    Blend { most: f64, half: bool, may_be_round: bool },
}

/// The change of the unit tangent from one segment to the next.
#[inline]
pub(crate) fn tangent_change(before: &NominalSegment, after: &NominalSegment) -> Axes {
    let mut change = after.start_tangent;
    for (change, before) in change.iter_mut().zip(&before.end_tangent) {
        *change -= before;
    }
    change
}

impl Corner {
    /// The corner between two segments; writes `round` if it may be round. A parabola that uses d of both segments
    /// misses the corner by d·|change|/4, and so does a blended arc.
    #[inline]
    pub(crate) fn between(
        before: &NominalSegment,
        after: &NominalSegment,
        round: &mut RoundCorner,
        limits: &Limits,
    ) -> Self {
        let blend = stricter(before.path_control, after.path_control);
        // The most frequent case, known without a square root.
        if blend == PathControl::ExactStop {
            return Self::Stop;
        }
        let axes = before.whole.axis_count.max(after.whole.axis_count);
        let change = tangent_change(before, after);
        let break_angle = norm_of(&change, axes);
        if break_angle < SMOOTH_BREAK_MAX_RAD {
            return Self::Smooth;
        }
        if limits.rests_at_corners {
            return Self::Stop;
        }
        let (tolerance, half) = match (blend, after.path_control) {
            (PathControl::ExactStop, _) => return Self::Stop,
            (PathControl::ExactPath, _) if break_angle > EXACT_PATH_BREAK_MAX_RAD => {
                return Self::Stop;
            }
            (PathControl::ExactPath, _) => {
                return Self::TangentBreak(TangentBreak::between(before, after, &change, limits));
            }
            // Each segment deviates by at most its own tolerance.
            (PathControl::Within(one), PathControl::Within(other)) => {
                ((one - before.merge_deviation).min(other - after.merge_deviation), false)
            }
            (PathControl::Within(tolerance), PathControl::BetweenMidpoints)
            | (PathControl::BetweenMidpoints, PathControl::Within(tolerance)) => {
                (tolerance - before.merge_deviation - after.merge_deviation, true)
            }
            (PathControl::Within(tolerance), _) => (tolerance, false),
            (PathControl::BetweenMidpoints, _) => (f64::INFINITY, true),
        };
        // A blend has one feed. Feeds per second and per revolution cannot be compared in advance.
        let bases = [before.whole.feed_basis, after.whole.feed_basis];
        if bases.contains(&FeedBasis::PerTurn) && bases.contains(&FeedBasis::PerSecond) {
            return Self::Stop;
        }
        // A blend that is long enough to cost no speed need not be longer.
        let fastest = before.max_speed_sq().min(after.max_speed_sq());
        let is_slow = bases.contains(&FeedBasis::PerSecond)
            && !has_same_feed_path(before, after)
            && costs_time(before, after, limits);
        let fastest = match bases {
            [FeedBasis::PerTurn, FeedBasis::Rapid] => {
                fastest.min(squared(ASSUMED_SPINDLE_SPEED * before.whole.feed))
            }
            [FeedBasis::Rapid, FeedBasis::PerTurn] => {
                fastest.min(squared(ASSUMED_SPINDLE_SPEED * after.whole.feed))
            }
            _ if is_slow => fastest.min(blend_speed_sq(before, after)),
            _ => fastest,
        };
        let share = if is_slow { SLOW_BLEND_ACCELERATION_RATIO } else { BLEND_ACCELERATION_RATIO };
        let turning = least(&limits.acceleration, &change, axes);
        let enough = fastest / (2.0 * share * turning);
        // Two blended arcs that take a cycle each do not crowd it, whatever is left of the segments between their
        // corners.
        let arcs = before.whole.circle.is_some() || after.whole.circle.is_some();
        let enough = if arcs { enough.max(math::sqrt(fastest) * limits.cycle) } else { enough };
        let allowed = 4.0 * TOLERANCE_USE_RATIO * tolerance / break_angle;
        let most = allowed.min(enough);
        let most = most.min(blended_arc_length_max(before)).min(blended_arc_length_max(after));
        if most <= 0.0 {
            return Self::Stop;
        }
        let mut may_be_round = false;
        if break_angle >= ROUND_CHANGE_MIN
            && !(arcs || is_slow || axes > 3)
            && bases == [FeedBasis::PerSecond; 2]
        {
            // Without a tolerance the feed alone decides how far the path is left.
            let most = if half { most } else { f64::INFINITY };
            let feed_sq = blend_speed_sq(before, after);
            // Where the axes cannot keep the feed on a parabola, an arc takes more time.
            if feed_sq < 2.0 * allowed.min(most) * turning {
                may_be_round = round.write(
                    (before, after),
                    (&change, break_angle),
                    (math::sqrt(feed_sq), TOLERANCE_USE_RATIO * tolerance, most),
                    limits,
                );
            }
        }
        Self::Blend { most, half, may_be_round }
    }
}

/// The greatest length of an arc that may be blended.
fn blended_arc_length_max(segment: &NominalSegment) -> f64 {
    segment
        .whole
        .circle
        .map_or(f64::INFINITY, |circle| BLENDED_ARC_ANGLE_MAX_RAD / circle.angle_rate)
}

/// Whether both have the same feed along the same part of the path, except for rounding: then a blend has it, too.
#[inline]
fn has_same_feed_path(before: &NominalSegment, after: &NominalSegment) -> bool {
    let apart = (before.feed_path_ratio - after.feed_path_ratio).abs();
    before.has_same_feed(after)
        && before.feed_path == after.feed_path
        && apart <= FEED_PATH_RATIO_ROUNDING
}

/// Whether a longer blend takes more time, since all of it is slower than one of its segments. Then it is only as long
/// as the programmed feed needs. A long blend between short segments saves an element, and only a few elements fit
/// into a cycle; that is worth the time only where the blend takes few cycles.
#[inline(never)]
fn costs_time(before: &NominalSegment, after: &NominalSegment, limits: &Limits) -> bool {
    let most = math::max(requested_speed_sq(before, 1.0), requested_speed_sq(after, 1.0));
    let short = math::min(before.whole.length, after.whole.length);
    let blend = blend_speed_sq(before, after);
    blend < UNEQUAL_FEED_RATIO_MAX * most
        && squared(short)
            > math::min(
                squared(UNEQUAL_FEED_CYCLES_MIN * limits.cycle) * most,
                squared(SLOW_BLEND_CYCLES_MIN * limits.cycle) * blend,
            )
}

/// The square of the speed of a blend at an override of 1.
fn blend_speed_sq(before: &NominalSegment, after: &NominalSegment) -> f64 {
    let one = before.feed_ratio_next_to(after, &after.start_tangent);
    let other = after.feed_ratio_next_to(before, &before.end_tangent);
    math::min(requested_speed_sq(before, one), requested_speed_sq(after, other))
}

/// The square of the speed of a segment at an override of 1, where its feed has this factor.
fn requested_speed_sq(segment: &NominalSegment, feed_ratio: f64) -> f64 {
    match segment.whole.feed_basis {
        FeedBasis::PerSecond => {
            segment.whole.start_limit_sq.min(squared(segment.whole.feed * feed_ratio))
        }
        FeedBasis::Rapid | FeedBasis::PerTurn => segment.whole.start_limit_sq,
    }
}

/// What a corner uses of the segment before it and of the one after it, and whether it is round.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct CornerForm {
    pub(crate) before: f64,
    pub(crate) after: f64,
    pub(crate) is_round: bool,
}

impl CornerForm {
    /// The form of a blend, given what is available of its segments: equal lengths, or nearly equal ones between
    /// lines. At the end of an arc the parameter may run a little slower or faster than the path; then the lengths are
    /// equal along the path.
    pub(crate) fn of_blend(
        (most, round): (f64, Option<&RoundCorner>),
        (before, after): (f64, f64),
        lines: bool,
        exit: f64,
    ) -> Self {
        if let Some(round) = round {
            let available = before.min(after);
            let length = round.length_max.min(available);
            if round.is_faster(length, most.min(available)) {
                return Self { before: length, after: length, is_round: true };
            }
        }
        let (before, after) = (most.min(before), most.min(after));
        let short = before.min(after);
        let near = lines && before.max(after) <= PARABOLA_SIDE_RATIO_MAX * short;
        let (before, after) = if near {
            (before, after)
        } else {
            let end = short / exit.max(1.0);
            (end, end * exit)
        };
        Self { before, after, is_round: false }
    }
}

/// Writes the parabola between two lines that uses d of the first and e of the second.
#[inline]
pub(crate) fn write_parabola(
    (before, after): (&NominalSegment, &NominalSegment),
    (d, e): (f64, f64),
    limits: &Limits,
    blend: &mut PathElement,
) {
    let exit = e / d;
    let (mut origin, mut end, mut bend) = (before.whole.end, before.whole.end, Axes::default());
    for (end, direction) in end.iter_mut().zip(&after.start_tangent) {
        *end += e * direction;
    }
    let directions = before.end_tangent.iter().zip(&after.start_tangent);
    for ((origin, bend), (from, to)) in origin.iter_mut().zip(&mut bend).zip(directions) {
        *origin -= d * from;
        *bend = (exit * to - from) / (2.0 * d);
    }
    // Its blend limits are computed when it has its model.
    blend.begin_at(&origin);
    (blend.tangent, blend.curvature, blend.end) = (before.end_tangent, bend, end);
    (blend.length, blend.end_speed_ratio) = (2.0 * d, exit);
    blend.axis_count = before.whole.axis_count.max(after.whole.axis_count);
    blend.smoothing = after.whole.smoothing;
    blend.segment_start = Some(d);
    (blend.feed, blend.feed_basis) = (after.whole.feed, after.whole.feed_basis);
    (blend.number, blend.index) = (after.whole.number, after.whole.index);
    blend.probing = after.whole.probing;
    limits.assign_model(blend);
    blend.feed *= after.feed_ratio_next_to(before, &before.end_tangent);
    let other = before.whole.feed * before.feed_ratio_next_to(after, &after.start_tangent);
    take_slower_feed(blend, &before.whole, other);
    blend.feed /= blend.end_speed_ratio.max(1.0);
}

/// Where a parabola is split into two elements with models of their own. A long flat blend between two slow corners
/// can then speed up and slow down. Where different axes limit the speed at both ends, each end gets its own limit.
/// `None` where nothing is gained, or where a half would take less than a cycle.
#[inline]
pub(crate) fn split_place(blend: &PathElement, limits: &Limits) -> Option<f64> {
    let AccelerationModel::Blend { steady_speed_sq } = blend.model else { return None };
    let axes = squared(blend.speed_limit);
    let (requested, requested_max) = match blend.feed_basis {
        FeedBasis::PerSecond => (squared(blend.feed), squared(2.0 * blend.feed)),
        FeedBasis::Rapid | FeedBasis::PerTurn => (f64::INFINITY, f64::INFINITY),
    };
    let flat =
        norm_of(&blend.curvature, blend.axis_count) * blend.length <= FLAT_BLEND_ANGLE_MAX_RAD;
    if !flat && axes >= steady_speed_sq.min(requested) {
        return None;
    }
    let along = least(&limits.acceleration, &blend.tangent, blend.axis_count);
    let far = math::sqrt(axes.min(requested_max).min(steady_speed_sq)) * limits.cycle;
    if blend.length < 2.0 * far
        || blend.length < along * squared(SPLIT_BLEND_CYCLES_MIN * limits.cycle)
    {
        return None;
    }
    Some(blend.segment_start.unwrap_or(0.5 * blend.length))
}

/// The last d of the segment before a corner, bent by half of the change of direction.
pub(crate) fn blended_end(
    (segment, after): (&NominalSegment, &NominalSegment),
    change: &Axes,
    d: f64,
    limits: &Limits,
) -> PathElement {
    let length = segment.whole.length;
    let mut element = segment.whole.part(length - d, length);
    // Where the radius of an arc changes, |p'| is not quite 1 at its end.
    let exit = segment.whole.end_speed_ratio;
    for ((bend, end), change) in element.curvature.iter_mut().zip(&mut element.end).zip(change) {
        *bend += exit * change / (2.0 * d);
        *end += exit * change * d / 4.0;
    }
    element.feed *= segment.feed_ratio_next_to(after, &after.start_tangent);
    finish_blended_arc(&mut element, change, d, limits);
    element
}

/// The first d of the segment after a corner, bent by the other half.
pub(crate) fn blended_start(
    (before, segment): (&NominalSegment, &NominalSegment),
    change: &Axes,
    d: f64,
    limits: &Limits,
) -> PathElement {
    let mut element = segment.whole.part(0.0, d);
    for (((origin, rate), bend), change) in
        element.origin.iter_mut().zip(&mut element.tangent).zip(&mut element.curvature).zip(change)
    {
        *origin += change * d / 4.0;
        *rate -= change / 2.0;
        *bend += change / (2.0 * d);
    }
    element.segment_start = Some(0.0);
    element.feed *= segment.feed_ratio_next_to(before, &before.end_tangent);
    finish_blended_arc(&mut element, change, d, limits);
    element
}

/// Adapts axes and feed: a blended arc may be a little longer than the arc was, and its feed is along the path.
fn finish_blended_arc(element: &mut PathElement, change: &Axes, d: f64, limits: &Limits) {
    let last = change.iter().rposition(|change| change.abs() > 0.0);
    element.axis_count = element.axis_count.max(last.map_or(0, |last| last.saturating_add(1)));
    let turned = element.circle.map_or(0.0, |circle| circle.angle_rate * d);
    element.feed /= math::sqrt(1.0 + turned * norm(change));
    limits.assign_model(element);
}

/// The path control at a corner: a segment that must be exact is exact from its beginning.
fn stricter(before: PathControl, after: PathControl) -> PathControl {
    match (before, after) {
        (
            PathControl::Within(_) | PathControl::BetweenMidpoints,
            PathControl::ExactStop | PathControl::ExactPath,
        ) => PathControl::ExactPath,
        _ => before,
    }
}

/// Gives a blend the slower of both feeds.
fn take_slower_feed(blend: &mut PathElement, other: &PathElement, feed: f64) {
    blend.is_partly_rapid =
        blend.feed_basis == FeedBasis::Rapid || other.feed_basis == FeedBasis::Rapid;
    if other.feed_basis != FeedBasis::Rapid
        && (blend.feed_basis == FeedBasis::Rapid || feed < blend.feed)
    {
        blend.feed = feed;
        blend.feed_basis = other.feed_basis;
    }
}
