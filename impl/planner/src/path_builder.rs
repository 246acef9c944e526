//! From segments to pieces: what a new segment does to the end of the path that is queued.
//!
//! A segment may go on in the last leg, where both are over within a cycle. The last two legs are open. A corner gets
//! what it can use of its legs, at least half of each; how much the corner after it leaves is known when that one is,
//! and the corner is then made anew. A path that has been promised to the motion is never changed so that it could
//! not be kept to: then the corner keeps the form it has, a stop at worst.

use crate::corner::{
    Corner, blended_end, blended_start, corner_lengths, split_place, tangent_change, write_parabola,
};
use crate::limits::{Limits, squared};
use crate::look_ahead::{LookAhead, axes_allow};
use crate::math;
use crate::motion::MotionState;
use crate::nominal_segment::NominalSegment;
use crate::parameters::Axes;
use crate::path_element::{AccelerationModel, BlendLimits, FeedBasis, PathElement};
use crate::ring::Ring;
use crate::segment::PathControl;

/// So many pieces may be touched in a cycle, by a limit of speed where they are short.
const ELEMENTS_PER_CROWDED_CYCLE: u64 = 3;
/// A leg that is shorter when its corners have taken theirs is left out, millimetres.
const ELEMENT_LENGTH_MIN_MM: f64 = 1e-12;
/// How much of a leg that begins smoothly or at rest its end may take.
const END_TRIM_RATIO_MAX: f64 = 0.96875;

/// A leg whose end may still change.
#[derive(Clone, Copy, Debug, Default)]
struct OpenSegment {
    segment: NominalSegment,
    /// The number of its first own piece, and whether the corners have left it one.
    first_element: u64,
    has_element: bool,
    /// The corner before it.
    corner: Corner,
    /// How much of the leg before it and of itself that corner has.
    corner_lengths: (f64, f64),
}

/// The end of the path.
#[derive(Debug)]
pub(crate) struct PathBuilder {
    /// Where the last segment ends.
    pub(crate) end: Axes,
    /// The last two legs and room for a new one; `turn` is where the older one lies.
    open_segments: [OpenSegment; 3],
    oldest: u8,
    /// How many of them there are since the path last closed.
    open_count: u8,
}

/// What a change of the path is made with.
#[derive(Debug)]
pub(crate) struct PathEdit<'a> {
    pub(crate) elements: &'a mut Ring<PathElement>,
    pub(crate) look_ahead: &'a mut LookAhead,
    pub(crate) motion: &'a MotionState,
    pub(crate) limits: &'a Limits,
    /// The first piece that has been changed, or that has been lowered for it.
    pub(crate) first_changed: u64,
    /// Whether the motion is still faster than it is planned, since an override has been lowered: what is planned
    /// says nothing of it then.
    pub(crate) motion_exceeds_plan: bool,
}

impl PathBuilder {
    pub(crate) fn new(end: Axes) -> Self {
        Self { end, open_segments: [OpenSegment::default(); 3], oldest: 0, open_count: 0 }
    }

    /// The path ends at rest here, for what comes next.
    pub(crate) fn close(&mut self) {
        self.open_count = 0;
    }

    /// The corner after the last leg comes to rest, if it is not made yet.
    pub(crate) fn stop_at_end(&mut self) {
        let (_, last, _) = in_order(&mut self.open_segments, self.oldest);
        last.segment.path_control = PathControl::ExactStop;
    }

    /// Whether one of the last legs follows the spindle, of which pieces may have been made anew.
    pub(crate) fn follows_spindle(&self) -> bool {
        self.open_segments.iter().any(|open| open.segment.whole.feed_basis == FeedBasis::PerTurn)
    }

    /// Seconds of rest at the end of the path.
    pub(crate) fn dwell(&mut self, seconds: f64, edit: &mut PathEdit<'_>) {
        let mut rest = PathElement {
            origin: self.end,
            end: self.end,
            end_speed_ratio: 1.0,
            ..PathElement::default()
        };
        rest.model = AccelerationModel::Dwell(seconds);
        rest.axis_count = self.end.len();
        edit.elements.push(&rest);
        self.close();
    }

    /// Where the next leg is to be written, and where it begins.
    pub(crate) fn new_segment(&mut self) -> (&mut NominalSegment, &Axes) {
        let (_, _, next) = in_order(&mut self.open_segments, self.oldest);
        (&mut next.segment, &self.end)
    }

    /// Adds the leg that was written.
    #[inline]
    pub(crate) fn add(&mut self, edit: &mut PathEdit<'_>) {
        edit.first_changed = u64::MAX;
        let (before, last, next) = in_order(&mut self.open_segments, self.oldest);
        self.end = next.segment.whole.end;
        if self.open_count > 0 && merge_next(before, last, next, edit) {
            return;
        }
        next.corner = Corner::Stop;
        if self.open_count > 0 {
            next.corner = Corner::between(&last.segment, &next.segment, edit.limits);
        }
        let made = match next.corner {
            Corner::Stop => false,
            Corner::Smooth | Corner::TangentBreak(_) | Corner::Blend { .. } => {
                self.open_count > 1 && enlarge_previous_corner(before, last, next, edit)
                    || make_corner(last, next, edit)
            }
        };
        if !made {
            next.corner = Corner::Stop;
            next.corner_lengths = (0.0, 0.0);
            next.segment.start_trim = 0.0;
            next.first_element = edit.elements.end();
            push_own_element(next, 0.0, edit);
            update_look_ahead(edit);
        }
        self.oldest = if self.oldest == 2 { 0 } else { self.oldest.saturating_add(1) };
        self.open_count = self.open_count.saturating_add(1).min(2);
    }
}

/// The leg before the last, the last and the next.
fn in_order(
    segments: &mut [OpenSegment; 3],
    oldest: u8,
) -> (&mut OpenSegment, &mut OpenSegment, &mut OpenSegment) {
    let [one, two, three] = segments;
    match oldest {
        0 => (one, two, three),
        1 => (two, three, one),
        _ => (three, one, two),
    }
}

/// Makes one leg of the last and the next, where both are over within a cycle, and the corner before it anew.
fn merge_next(
    before: &mut OpenSegment,
    last: &mut OpenSegment,
    next: &OpenSegment,
    edit: &mut PathEdit<'_>,
) -> bool {
    if !last.segment.can_merge_with(&next.segment, edit.limits) {
        return false;
    }
    let old = *last;
    if !last.segment.merge(&next.segment, edit.limits) {
        last.segment = old.segment;
        return false;
    }
    if last.corner == Corner::Stop {
        let motion = edit.motion;
        let begun = motion.at > last.first_element
            || motion.at == last.first_element && (motion.x > 0.0 || motion.speed > 0.0);
        if begun {
            last.segment = old.segment;
        } else {
            push_own_element(last, 0.0, edit);
            update_look_ahead(edit);
        }
        return !begun;
    }
    last.corner = Corner::between(&before.segment, &last.segment, edit.limits);
    let given = provisional_lengths(before, last);
    if last.corner == Corner::Stop || !can_end_earlier(before, given.0, edit) {
        *last = old;
        return false;
    }
    remake_corner_and_next(before, last, given, edit);
    if is_accepted(edit) {
        return true;
    }
    *last = old;
    remake_corner(before, last, edit);
    push_own_element(last, 0.0, edit);
    update_look_ahead(edit);
    edit.first_changed = u64::MAX;
    false
}

/// Makes the corner before the last leg anew where it may have more, and then the one before the next.
#[inline]
fn enlarge_previous_corner(
    before: &mut OpenSegment,
    last: &mut OpenSegment,
    next: &mut OpenSegment,
    edit: &mut PathEdit<'_>,
) -> bool {
    let Corner::Blend { most, half: false } = last.corner else { return false };
    let length = last.segment.whole.length;
    let left = match next.corner {
        Corner::Blend { most, .. } => length - most,
        Corner::TangentBreak(tangent_break) => length - tangent_break.half_length.min(0.5 * length),
        Corner::Stop | Corner::Smooth => length * END_TRIM_RATIO_MAX,
    };
    let after = left.max(0.5 * length);
    let given = corner_lengths(
        most,
        (available_length(before), after),
        are_lines(&before.segment, &last.segment),
        before.segment.whole.end_speed_ratio,
    );
    if given.0 <= last.corner_lengths.0 * (1.0 + 1e-9) || !can_end_earlier(before, given.0, edit) {
        return false;
    }
    let old = last.corner_lengths;
    last.corner_lengths = given;
    remake_corner(before, last, edit);
    remake_corner_and_next(last, next, provisional_lengths(last, next), edit);
    if is_accepted(edit) {
        return true;
    }
    last.corner_lengths = old;
    remake_corner(before, last, edit);
    push_own_element(last, 0.0, edit);
    update_look_ahead(edit);
    false
}

/// Makes the corner between the last leg and the next.
fn make_corner(last: &mut OpenSegment, next: &mut OpenSegment, edit: &mut PathEdit<'_>) -> bool {
    let given = provisional_lengths(last, next);
    if !can_end_earlier(last, given.0, edit) {
        return false;
    }
    remake_corner_and_next(last, next, given, edit);
    if is_accepted(edit) {
        return true;
    }
    push_own_element(last, 0.0, edit);
    update_look_ahead(edit);
    false
}

/// What a form of the path has lowered is computed anew for the one that takes its place.
fn update_look_ahead(edit: &mut PathEdit<'_>) -> u64 {
    let places = (edit.first_changed, edit.motion.at);
    edit.first_changed = edit.look_ahead.recompute(edit.elements, places, edit.limits);
    edit.first_changed
}

/// Whether the motion can keep to a changed path.
fn is_accepted(edit: &mut PathEdit<'_>) -> bool {
    let changed = edit.first_changed;
    let first = update_look_ahead(edit);
    if edit.motion_exceeds_plan {
        return axes_allow(edit.elements, edit.motion, changed, edit.limits);
    }
    first > edit.motion.at.saturating_add(1) || edit.motion.can_follow(edit.elements, edit.limits)
}

/// Whether a leg can end so much earlier: it must not be over.
fn can_end_earlier(open: &OpenSegment, given: f64, edit: &PathEdit<'_>) -> bool {
    let left = open.segment.whole.length - open.segment.start_trim - given;
    let motion = edit.motion;
    motion.at < open.first_element
        || motion.at == open.first_element
            && open.has_element
            && motion.x < left - ELEMENT_LENGTH_MIN_MM
}

/// How much of a leg is left for the corner at its end.
fn available_length(open: &OpenSegment) -> f64 {
    match open.corner {
        Corner::TangentBreak(_) | Corner::Blend { .. } => {
            open.segment.whole.length - open.segment.start_trim
        }
        Corner::Stop | Corner::Smooth => open.segment.whole.length * END_TRIM_RATIO_MAX,
    }
}

fn are_lines(before: &NominalSegment, after: &NominalSegment) -> bool {
    before.whole.circle.is_none() && after.whole.circle.is_none()
}

/// The lengths that a corner has before the one after it is known.
fn provisional_lengths(last: &OpenSegment, next: &OpenSegment) -> (f64, f64) {
    match next.corner {
        Corner::Stop | Corner::Smooth => (0.0, 0.0),
        Corner::TangentBreak(tangent_break) => {
            // Half of a leg is left for the corner at its other end, and nothing is where that one begins at rest.
            let half = |segment: &NominalSegment| {
                tangent_break.half_length.min(0.5 * segment.whole.length)
            };
            (half(&last.segment).min(available_length(last)), half(&next.segment))
        }
        Corner::Blend { most, half } => {
            let before = available_length(last);
            let before = if half { before.min(0.5 * last.segment.whole.length) } else { before };
            let rooms = (before, 0.5 * next.segment.whole.length);
            corner_lengths(
                most,
                rooms,
                are_lines(&last.segment, &next.segment),
                last.segment.whole.end_speed_ratio,
            )
        }
    }
}

/// Makes the end of a leg anew and the corner after it.
fn remake_corner(before: &mut OpenSegment, last: &mut OpenSegment, edit: &mut PathEdit<'_>) {
    push_own_element(before, last.corner_lengths.0, edit);
    push_corner(&before.segment, last, edit);
}

/// Makes the end of the last leg anew, the corner after it, and the next leg.
fn remake_corner_and_next(
    last: &mut OpenSegment,
    next: &mut OpenSegment,
    given: (f64, f64),
    edit: &mut PathEdit<'_>,
) {
    next.corner_lengths = given;
    remake_corner(last, next, edit);
    push_own_element(next, 0.0, edit);
}

/// The leg's own piece, from its first corner to so much before its end; whatever lies from there on is forgotten.
fn push_own_element(open: &mut OpenSegment, given: f64, edit: &mut PathEdit<'_>) {
    edit.elements.truncate(open.first_element);
    edit.first_changed = edit.first_changed.min(open.first_element);
    let whole = &open.segment.whole;
    let (from, to) = (open.segment.start_trim, whole.length - given);
    open.has_element = to - from > ELEMENT_LENGTH_MIN_MM;
    if !open.has_element {
        return;
    }
    let Some(element) = edit.elements.append() else { return };
    *element = *whole;
    if from > 0.0 || given > 0.0 {
        element.cut(from, to);
    }
    match open.corner {
        Corner::Stop => (element.junction_limit_sq, element.segment_start) = (0.0, Some(0.0)),
        Corner::Smooth => element.segment_start = Some(0.0),
        Corner::TangentBreak(_) | Corner::Blend { .. } => {}
    }
    limit_crowded_speed(edit.elements.end(), edit);
}

fn push_corner(before: &NominalSegment, after: &mut OpenSegment, edit: &mut PathEdit<'_>) {
    after.segment.start_trim = 0.0;
    let (d, e) = after.corner_lengths;
    if let Corner::TangentBreak(tangent_break) = &after.corner {
        push(&tangent_break.end(before, d), edit);
        push(&tangent_break.start(&after.segment, e), edit);
        after.segment.start_trim = e;
    }
    if let Corner::Blend { .. } = after.corner {
        if are_lines(before, &after.segment) {
            push_blend((before, &after.segment), (d, e), edit);
        } else {
            let change = tangent_change(before, &after.segment);
            push(&blended_end((before, &after.segment), &change, d, edit.limits), edit);
            push(&blended_start((before, &after.segment), &change, e, edit.limits), edit);
        }
        after.segment.start_trim = e;
    }
    after.first_element = edit.elements.end();
}

/// Appends the blend of two lines.
fn push_blend(
    (before, after): (&NominalSegment, &NominalSegment),
    given: (f64, f64),
    edit: &mut PathEdit<'_>,
) {
    let Some(blend) = edit.elements.append() else { return };
    write_parabola((before, after), given, edit.limits, blend);
    let middle = split_place(blend, edit.limits);
    let first = edit.elements.end().wrapping_sub(1);
    if let Some(middle) = middle
        && let Some(second) = edit.elements.append_copy()
    {
        second.cut(middle, second.length);
        second.segment_start = Some(0.0);
        edit.limits.assign_model(second);
        if let Some(first) = edit.elements.get_mut(first) {
            first.cut(0.0, middle);
            edit.limits.assign_model(first);
        }
        finish_element(first, edit);
        finish_element(first.wrapping_add(1), edit);
    } else {
        finish_element(first, edit);
    }
}

fn push(element: &PathElement, edit: &mut PathEdit<'_>) {
    edit.elements.push(element);
    finish_element(edit.elements.end().wrapping_sub(1), edit);
}

/// What a piece gets once it has its place.
fn finish_element(place: u64, edit: &mut PathEdit<'_>) {
    if let Some(element) = edit.elements.get_mut(place)
        && matches!(element.model, AccelerationModel::Blend { .. })
        && element.axis_count <= 3
    {
        BlendLimits::compute(element, edit.limits);
    }
    limit_crowded_speed(place.wrapping_add(1), edit);
}

/// Limits the speed of the last pieces before an end where too many would fit into a cycle.
fn limit_crowded_speed(end: u64, edit: &mut PathEdit<'_>) {
    let Some(last) = edit.elements.get(end.wrapping_sub(1)) else { return };
    // A piece that takes a cycle by itself is no part of a crowd.
    if last.length >= last.speed_limit * edit.limits.cycle {
        return;
    }
    let first = end.saturating_sub(ELEMENTS_PER_CROWDED_CYCLE);
    let (mut length, mut most) = (last.length, last.speed_limit);
    for place in first..end.wrapping_sub(1) {
        // Without so many before it there is no crowd.
        let Some(element) = edit.elements.get(place) else { return };
        length += element.length;
        most = math::max(most, element.speed_limit);
    }
    if length >= most * edit.limits.cycle {
        return;
    }
    let fastest = length / edit.limits.cycle;
    let ceiling = squared(fastest);
    for place in first.max(edit.motion.at.saturating_add(1))..end {
        if let Some(element) = edit.elements.get_mut(place)
            && element.speed_limit > fastest
        {
            element.start_limit_sq = math::min(element.start_limit_sq, ceiling);
            element.end_limit_sq = math::min(element.end_limit_sq, ceiling);
            element.speed_limit = fastest;
            edit.first_changed = edit.first_changed.min(place);
        }
    }
}
