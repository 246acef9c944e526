//! The corner between two segments: a stop, a smooth transition, a break of the tangent, or a blend.

use crate::limits::{Limits, SMOOTH_BREAK_MAX_RAD, least, squared};
use crate::math;
use crate::nominal_segment::NominalSegment;
use crate::parameters::Axes;
use crate::path_element::{AccelerationModel, FeedBasis, PathElement};
use crate::segment::PathControl;
use crate::vector::{norm, norm_of};

/// From this change of direction on, an exact path stops at the corner.
const EXACT_PATH_BREAK_MAX_RAD: f64 = 0.05;
/// How many times the speed of a tangent break is bisected.
const SPEED_BISECTIONS: u32 = 12;
/// The share of an arc's acceleration that a tangent break next to it may use. The whole arc is slower for it.
const ARC_BREAK_USE_RATIO: f64 = 0.075;
/// The share of the acceleration that a blend may cost where its length is free.
const BLEND_ACCELERATION_RATIO: f64 = 0.05;
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
/// For how many cycles a segment must last for that, at its own speed or at the other one's.
const UNEQUAL_FEED_CYCLES_MIN: f64 = 0.25;
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
    /// A blend may use up to `most` of each segment, and with `half` at most half of each.
    Blend { most: f64, half: bool },
}

/// The change of the unit tangent from one segment to the next.
pub(crate) fn tangent_change(before: &NominalSegment, after: &NominalSegment) -> Axes {
    let mut change = after.start_tangent;
    for (change, before) in change.iter_mut().zip(&before.end_tangent) {
        *change -= before;
    }
    change
}

impl Corner {
    /// The corner between two segments. A parabola that uses d of both segments misses the corner by d·|change|/4, and
    /// so does a blended arc.
    #[inline]
    pub(crate) fn between(
        before: &NominalSegment,
        after: &NominalSegment,
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
            | (PathControl::BetweenMidpoints, PathControl::Within(tolerance)) => (tolerance, true),
            (PathControl::Within(tolerance), _) => (tolerance, false),
            (PathControl::BetweenMidpoints, _) => (f64::INFINITY, true),
        };
        // A blend between midpoints refers to the midpoints of programmed segments, not of merged ones.
        if half && (before.is_merged || after.is_merged) {
            return Self::Stop;
        }
        // A blend has one feed. Feeds per second and per revolution cannot be compared in advance.
        let bases = [before.whole.feed_basis, after.whole.feed_basis];
        if bases.contains(&FeedBasis::PerTurn) && bases.contains(&FeedBasis::PerSecond) {
            return Self::Stop;
        }
        // A blend that is long enough to cost no speed need not be longer.
        let fastest = before.max_speed_sq().min(after.max_speed_sq());
        let fastest = match bases {
            [FeedBasis::PerTurn, FeedBasis::Rapid] => {
                fastest.min(squared(ASSUMED_SPINDLE_SPEED * before.whole.feed))
            }
            [FeedBasis::Rapid, FeedBasis::PerTurn] => {
                fastest.min(squared(ASSUMED_SPINDLE_SPEED * after.whole.feed))
            }
            [FeedBasis::PerSecond, _] | [_, FeedBasis::PerSecond]
                if !before.has_same_feed(after) && costs_time(before, after, limits) =>
            {
                fastest.min(requested_speed_sq(before)).min(requested_speed_sq(after))
            }
            _ => fastest,
        };
        let enough =
            fastest / (2.0 * BLEND_ACCELERATION_RATIO * least(&limits.acceleration, &change, axes));
        // Two blended arcs that take a cycle each do not crowd it, whatever is left of the segments between their
        // corners.
        let arcs = before.whole.circle.is_some() || after.whole.circle.is_some();
        let enough = if arcs { enough.max(math::sqrt(fastest) * limits.cycle) } else { enough };
        let most = (4.0 * TOLERANCE_USE_RATIO * tolerance / break_angle).min(enough);
        let most = most.min(blended_arc_length_max(before)).min(blended_arc_length_max(after));
        if most > 0.0 { Self::Blend { most, half } } else { Self::Stop }
    }
}

/// A corner of an exact path that is passed without a stop.
///
/// On an exact path every commanded point is on the path, and one point is commanded per cycle. Between two points the
/// velocity may jump at a corner if it could have changed by as much in that time. The acceleration seen in samples is
/// a mean over two cycles in which the middle counts most (a triangle of height 1/h), so a jump J counts at most as
/// J/h.
///
/// Let each jump be spread evenly over a time T about its corner, where these times do not overlap: T is at most a
/// cycle h, and at most the time to the next corner. Then the spread jump counts as much as the jump itself, except
/// for the one that contains the middle: J/h against J/h·(1 - T/4h). If J ≤ c·T, this is c/4·T/h too little, and
/// leaving another c/3 within T makes up for it, since T·(1 - T/4h)/3 ≥ T/4. So an axis with limit a keeps it if along
/// the path it is given a - 4c/3 within T. With c ≤ a/2 the chord misses a corner between two samples by J·h/4 ≤
/// a·h²/8, no more than a motion with constant acceleration does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct TangentBreak {
    /// The square of the speed at which it may be passed.
    junction_limit_sq: f64,
    /// The length of half of T on each segment, millimetres.
    pub(crate) half_length: f64,
    /// The share of the acceleration that remains there.
    acceleration_ratio: f64,
}

impl TangentBreak {
    fn between(
        before: &NominalSegment,
        after: &NominalSegment,
        change: &Axes,
        limits: &Limits,
    ) -> Self {
        let h = limits.cycle;
        // Per axis c·|direction of the jump|, which bounds the speed times T.
        let jump = 0.5 * least(&limits.planned, change, change.len());
        let rounds = before.whole.circle.is_some() || after.whole.circle.is_some();
        let jump = if rounds { ARC_BREAK_USE_RATIO * jump } else { jump };
        // The most that the speed rises within a cycle: the way to the next corner takes at least length / (speed +
        // rise).
        let (one, other) =
            (max_tangential_acceleration(before), max_tangential_acceleration(after));
        let rise = one.max(other) * h;
        let length = before.whole.length.min(after.whole.length);
        let used = |speed: f64| speed * (1.0 / h).max((speed + rise) / length) / jump;
        // A hold may take two cycles more to stop than with all of the acceleration, so little may be missing.
        let use_max = |speed: f64| {
            let cycles = 2.0 * one.min(other) * h / speed;
            1.5 * cycles / (1.0 + cycles)
        };
        let fits = |speed: f64| used(speed) <= use_max(speed).min(1.0);
        let mut speed = math::sqrt(before.max_speed_sq().min(after.max_speed_sq()));
        if !fits(speed) {
            let mut low = 0.0;
            for _ in 0..SPEED_BISECTIONS {
                let middle = 0.5 * (low + speed);
                if fits(middle) { low = middle } else { speed = middle }
            }
            speed = low;
        }
        let used = if rounds { ARC_BREAK_USE_RATIO * used(speed) } else { used(speed) };
        let near = 0.5 * h * (speed + 0.25 * rise);
        Self {
            junction_limit_sq: squared(speed),
            half_length: near,
            acceleration_ratio: 1.0 - used * 2.0 / 3.0,
        }
    }

    /// The last part of the segment before the corner.
    pub(crate) fn end(&self, segment: &NominalSegment, given: f64) -> PathElement {
        self.reduced(segment.whole.part(segment.whole.length - given, segment.whole.length))
    }

    /// The first part of the segment after the corner.
    pub(crate) fn start(&self, segment: &NominalSegment, given: f64) -> PathElement {
        let element = self.reduced(segment.whole.part(0.0, given));
        PathElement {
            junction_limit_sq: self.junction_limit_sq,
            segment_start: Some(0.0),
            ..element
        }
    }

    fn reduced(&self, mut element: PathElement) -> PathElement {
        element.has_tangent_break = true;
        match &mut element.model {
            AccelerationModel::Constant { acceleration } => {
                *acceleration *= self.acceleration_ratio;
            }
            AccelerationModel::Arc { acceleration, planned } => {
                *acceleration *= self.acceleration_ratio;
                *planned *= self.acceleration_ratio;
                element.start_limit_sq *= self.acceleration_ratio;
                element.end_limit_sq = element.start_limit_sq;
                element.speed_limit = math::sqrt(element.start_limit_sq);
            }
            AccelerationModel::Blend { .. }
            | AccelerationModel::BlendedArc { .. }
            | AccelerationModel::Dwell(_) => {}
        }
        element
    }
}

/// The greatest acceleration along a segment.
fn max_tangential_acceleration(segment: &NominalSegment) -> f64 {
    match segment.whole.model {
        AccelerationModel::Constant { acceleration }
        | AccelerationModel::Arc { acceleration, .. } => acceleration,
        AccelerationModel::Blend { .. }
        | AccelerationModel::BlendedArc { .. }
        | AccelerationModel::Dwell(_) => 0.0,
    }
}

/// The greatest length of an arc that may be blended.
fn blended_arc_length_max(segment: &NominalSegment) -> f64 {
    segment
        .whole
        .circle
        .map_or(f64::INFINITY, |circle| BLENDED_ARC_ANGLE_MAX_RAD / circle.angle_rate)
}

/// Whether a longer blend takes more time, since all of it is as slow as the slower of two feeds. Then it is only as
/// long as the programmed feed needs. Between short segments a long blend saves an element, of which too many would
/// fit into a cycle.
#[inline(never)]
fn costs_time(before: &NominalSegment, after: &NominalSegment, limits: &Limits) -> bool {
    let (one, other) = (requested_speed_sq(before), requested_speed_sq(after));
    let most = math::max(one, other);
    let short = math::min(before.whole.length, after.whole.length);
    math::min(one, other) < UNEQUAL_FEED_RATIO_MAX * most
        && squared(short) > squared(UNEQUAL_FEED_CYCLES_MIN * limits.cycle) * most
}

/// The square of the speed of a segment at an override of 1.
fn requested_speed_sq(segment: &NominalSegment) -> f64 {
    match segment.whole.feed_basis {
        FeedBasis::PerSecond => segment.whole.start_limit_sq.min(squared(segment.whole.feed)),
        FeedBasis::Rapid | FeedBasis::PerTurn => segment.whole.start_limit_sq,
    }
}

/// How much of each segment a blend uses, given what is available: equal lengths, or nearly equal ones between lines.
/// At the end of an arc the parameter may run a little slower or faster than the path; then the lengths are equal
/// along the path.
pub(crate) fn corner_lengths(
    most: f64,
    (before, after): (f64, f64),
    lines: bool,
    exit: f64,
) -> (f64, f64) {
    let (before, after) = (most.min(before), most.min(after));
    let short = before.min(after);
    let near = lines && before.max(after) <= PARABOLA_SIDE_RATIO_MAX * short;
    if near {
        (before, after)
    } else {
        let end = short / exit.max(1.0);
        (end, end * exit)
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
    blend.segment_start = Some(d);
    (blend.feed, blend.feed_basis) = (after.whole.feed, after.whole.feed_basis);
    (blend.number, blend.index) = (after.whole.number, after.whole.index);
    blend.probing = after.whole.probing;
    limits.assign_model(blend);
    // Between the two directions a blend has no more of the feed's path than the larger of its two segments.
    let most = before.feed_path_ratio.max(after.feed_path_ratio);
    blend.feed *= after.feed_path_ratio / most;
    take_slower_feed(blend, &before.whole, before.whole.feed * before.feed_path_ratio / most);
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
    element.feed *= (segment.feed_path_ratio / after.feed_path_ratio).min(1.0);
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
    element.feed *= (segment.feed_path_ratio / before.feed_path_ratio).min(1.0);
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
