//! From segments to elements: how a new segment changes the end of the queued path.
//!
//! A segment may be merged into the last one where both would be over within a cycle. The last two segments are open.
//! A corner uses what it can of its segments, at least half of each. How much the next corner leaves is known when
//! that one is, and then the corner is made again. A path that the motion relies on is never changed so that the
//! motion could not follow it: then the corner keeps its form, a stop at worst.

use crate::corner::{
    Corner, CornerForm, blended_end, blended_start, split_place, tangent_change, write_parabola,
};
use crate::crowded_speed::limit_crowded_speed;
use crate::limits::{LimitTable, Limits};
use crate::look_ahead::{LookAhead, axes_allow};
use crate::motion::MotionState;
use crate::nominal_segment::NominalSegment;
use crate::parameters::Axes;
use crate::path_element::{AccelerationModel, BlendLimits, FeedBasis, PathElement};
use crate::ring::Ring;
use crate::round_corner::RoundCorner;
use crate::segment::PathControl;

/// A shorter rest of a segment between its corners is omitted, millimetres.
const ELEMENT_LENGTH_MIN_MM: f64 = 1e-12;
/// The share of a segment with a smooth start, or one from rest, that the corner at its end may use.
const END_TRIM_RATIO_MAX: f64 = 0.96875;

/// A segment whose end may still change.
#[derive(Clone, Copy, Debug, Default)]
struct OpenSegment {
    segment: NominalSegment,
    /// The number of its first own element, and whether its corners leave it one.
    first_element: u64,
    has_element: bool,
    /// The corner before it.
    corner: Corner,
    corner_form: CornerForm,
    /// The same corner if it may be round.
    round: RoundCorner,
    /// Whether smoothed motion rests at its start.
    starts_at_rest: bool,
}

/// The end of the path.
#[derive(Debug)]
pub(crate) struct PathBuilder {
    /// Where the last segment ends.
    pub(crate) end: Axes,
    /// The last two segments and room for a new one; `oldest` is the index of the older one.
    open_segments: [OpenSegment; 3],
    oldest: u8,
    /// How many of them are open.
    open_count: u8,
    /// Whether smoothed motion rests before the next segment.
    next_starts_at_rest: bool,
}

/// What a change of the path needs.
#[derive(Debug)]
pub(crate) struct PathEdit<'a> {
    pub(crate) elements: &'a mut Ring<PathElement>,
    pub(crate) look_ahead: &'a mut LookAhead,
    pub(crate) motion: &'a MotionState,
    /// Those of the end of the path, and all.
    pub(crate) limits: &'a Limits,
    pub(crate) table: &'a LimitTable,
    /// The first element that was changed or lowered.
    pub(crate) first_changed: u64,
    /// Whether the motion is faster than planned, since an override was lowered. Then the plan cannot decide what the
    /// motion can follow.
    pub(crate) motion_exceeds_plan: bool,
}

impl PathBuilder {
    pub(crate) fn new(end: Axes) -> Self {
        Self {
            end,
            open_segments: [OpenSegment::default(); 3],
            oldest: 0,
            open_count: 0,
            next_starts_at_rest: false,
        }
    }

    /// Ends the path at rest here.
    pub(crate) fn close(&mut self) {
        self.open_count = 0;
    }

    /// Makes the corner after the last segment a stop, if it is not made yet.
    pub(crate) fn stop_at_end(&mut self) {
        let (_, last, _) = in_order(&mut self.open_segments, self.oldest);
        last.segment.path_control = PathControl::ExactStop;
    }

    /// Ends the path here, so that smoothed motion rests before what comes next.
    pub(crate) fn rest_at_end(&mut self) {
        self.stop_at_end();
        self.next_starts_at_rest = true;
    }

    /// Whether one of the last segments follows the spindle; its elements may have been made again.
    pub(crate) fn follows_spindle(&self) -> bool {
        self.open_segments.iter().any(|open| open.segment.whole.feed_basis == FeedBasis::PerTurn)
    }

    /// Adds a stop for so many seconds at the end of the path.
    pub(crate) fn dwell(&mut self, seconds: f64, edit: &mut PathEdit<'_>) {
        let mut rest = PathElement {
            origin: self.end,
            end: self.end,
            end_speed_ratio: 1.0,
            ..PathElement::default()
        };
        rest.model = AccelerationModel::Dwell(seconds);
        rest.axis_count = self.end.len();
        rest.starts_at_rest = edit.limits.smoothing.window > 0;
        edit.elements.push(&rest);
        self.close();
    }

    /// Where the next segment is written, and where it begins.
    pub(crate) fn new_segment(&mut self) -> (&mut NominalSegment, &Axes) {
        let (_, _, next) = in_order(&mut self.open_segments, self.oldest);
        (&mut next.segment, &self.end)
    }

    /// Adds the segment that was written.
    #[inline]
    pub(crate) fn add(&mut self, edit: &mut PathEdit<'_>) {
        edit.first_changed = u64::MAX;
        let (before, last, next) = in_order(&mut self.open_segments, self.oldest);
        if self.open_count > 0 && merge_next(before, last, next, edit) {
            self.end = next.segment.whole.end;
            return;
        }
        self.find_corner(edit.limits);
        self.add_after_corner(true, edit);
    }

    /// Finds what is possible at the corner before the segment that was written.
    pub(crate) fn find_corner(&mut self, limits: &Limits) {
        let (_, last, next) = in_order(&mut self.open_segments, self.oldest);
        next.corner = Corner::Stop;
        if self.open_count > 0 {
            let round = &mut next.round;
            next.corner = Corner::between(&last.segment, &next.segment, round, limits);
        }
    }

    /// Adds the segment whose corner was found; the corner before that one may become larger.
    pub(crate) fn add_after_corner(&mut self, enlarges: bool, edit: &mut PathEdit<'_>) {
        edit.first_changed = u64::MAX;
        let (before, last, next) = in_order(&mut self.open_segments, self.oldest);
        self.end = next.segment.whole.end;
        let made = match next.corner {
            Corner::Stop => false,
            Corner::Smooth | Corner::TangentBreak(_) | Corner::Blend { .. } => {
                enlarges && self.open_count > 1 && enlarge_previous_corner(before, last, next, edit)
                    || make_corner(last, next, edit)
            }
        };
        if !made {
            next.corner = Corner::Stop;
            next.corner_form = CornerForm::default();
            next.segment.start_trim = 0.0;
            next.starts_at_rest = edit.limits.smoothing.window > 0
                && (self.open_count == 0
                    || self.next_starts_at_rest
                    || edit.limits.rests_at_corners);
            self.next_starts_at_rest = false;
            next.first_element = edit.elements.end();
            push_own_element(next, 0.0, edit);
            update_look_ahead(edit);
        }
        self.oldest = if self.oldest == 2 { 0 } else { self.oldest.saturating_add(1) };
        self.open_count = self.open_count.saturating_add(1).min(2);
    }
}

/// The segment before the last one, the last one, and the next one.
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

/// Merges the next segment into the last one, where both are over within a cycle, and makes the corner before it
/// again.
fn merge_next(
    before: &mut OpenSegment,
    last: &mut OpenSegment,
    next: &OpenSegment,
    edit: &mut PathEdit<'_>,
) -> bool {
    let after_merged = before.segment.is_merged && last.corner != Corner::Stop;
    if !last.segment.can_merge_with(&next.segment, after_merged, edit.limits) {
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
    let round = &mut last.round;
    last.corner = Corner::between(&before.segment, &last.segment, round, edit.limits);
    let given = provisional_form(before, last);
    if last.corner == Corner::Stop || !can_end_earlier(before, given.before, edit) {
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

/// Makes the corner before the last segment again where it can use more, and then the one before the next.
#[inline]
fn enlarge_previous_corner(
    before: &mut OpenSegment,
    last: &mut OpenSegment,
    next: &mut OpenSegment,
    edit: &mut PathEdit<'_>,
) -> bool {
    let Corner::Blend { most, half: false, may_be_round } = last.corner else { return false };
    let length = last.segment.whole.length;
    let left = match next.corner {
        Corner::Blend { most, may_be_round: true, .. } => length - most.max(next.round.length_max),
        Corner::Blend { most, .. } => length - most,
        Corner::TangentBreak(tangent_break) => length - tangent_break.half_length.min(0.5 * length),
        Corner::Stop | Corner::Smooth => length * END_TRIM_RATIO_MAX,
    };
    let after = left.max(0.5 * length);
    let given = CornerForm::of_blend(
        (most, may_be_round.then_some(&last.round)),
        (available_length(before), after),
        are_lines(&before.segment, &last.segment),
        before.segment.whole.end_speed_ratio,
    );
    if given.before <= last.corner_form.before * (1.0 + 1e-9)
        || !can_end_earlier(before, given.before, edit)
    {
        return false;
    }
    let old = last.corner_form;
    last.corner_form = given;
    remake_corner(before, last, edit);
    remake_corner_and_next(last, next, provisional_form(last, next), edit);
    if is_accepted(edit) {
        return true;
    }
    last.corner_form = old;
    remake_corner(before, last, edit);
    push_own_element(last, 0.0, edit);
    update_look_ahead(edit);
    false
}

/// Makes the corner between the last segment and the next one.
fn make_corner(last: &mut OpenSegment, next: &mut OpenSegment, edit: &mut PathEdit<'_>) -> bool {
    let given = provisional_form(last, next);
    if !can_end_earlier(last, given.before, edit) {
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

/// Recomputes what another form of the path has lowered.
fn update_look_ahead(edit: &mut PathEdit<'_>) -> u64 {
    let places = (edit.first_changed, edit.motion.at);
    edit.first_changed = edit.look_ahead.recompute(edit.elements, places, edit.table);
    edit.first_changed
}

/// Whether the motion can follow the changed path.
fn is_accepted(edit: &mut PathEdit<'_>) -> bool {
    let changed = edit.first_changed;
    let first = update_look_ahead(edit);
    if edit.motion_exceeds_plan {
        return axes_allow(edit.elements, edit.motion, changed, edit.table);
    }
    first > edit.motion.at.saturating_add(1) || edit.motion.can_follow(edit.elements, edit.table)
}

/// Whether a segment can end this much earlier: the motion must not be past that point.
fn can_end_earlier(open: &OpenSegment, given: f64, edit: &PathEdit<'_>) -> bool {
    let left = open.segment.whole.length - open.segment.start_trim - given;
    let motion = edit.motion;
    motion.at < open.first_element
        || motion.at == open.first_element
            && open.has_element
            && motion.x < left - ELEMENT_LENGTH_MIN_MM
}

/// How much of a segment is left for the corner at its end.
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

/// The form of a corner before the one after it is known.
fn provisional_form(last: &OpenSegment, next: &OpenSegment) -> CornerForm {
    match next.corner {
        Corner::Stop | Corner::Smooth => CornerForm::default(),
        Corner::TangentBreak(tangent_break) => {
            // Half of a segment is left for the corner at its other end, and nothing is needed where that end is at
            // rest.
            let half = |segment: &NominalSegment| {
                tangent_break.half_length.min(0.5 * segment.whole.length)
            };
            CornerForm {
                before: half(&last.segment).min(available_length(last)),
                after: half(&next.segment),
                is_round: false,
            }
        }
        Corner::Blend { most, half, may_be_round } => {
            let before = available_length(last);
            // The midpoints are those of programmed segments, not of merged ones.
            let rooms = if half {
                (before.min(0.5 * last.segment.end_length), 0.5 * next.segment.start_length)
            } else {
                (before, 0.5 * next.segment.whole.length)
            };
            CornerForm::of_blend(
                (most, may_be_round.then_some(&next.round)),
                rooms,
                are_lines(&last.segment, &next.segment),
                last.segment.whole.end_speed_ratio,
            )
        }
    }
}

/// Makes the end of a segment and the corner after it again.
fn remake_corner(before: &mut OpenSegment, last: &mut OpenSegment, edit: &mut PathEdit<'_>) {
    push_own_element(before, last.corner_form.before, edit);
    push_corner(&before.segment, last, edit);
}

/// Makes the end of the last segment, the corner after it, and the next segment again.
fn remake_corner_and_next(
    last: &mut OpenSegment,
    next: &mut OpenSegment,
    given: CornerForm,
    edit: &mut PathEdit<'_>,
) {
    next.corner_form = given;
    remake_corner(last, next, edit);
    push_own_element(next, 0.0, edit);
}

/// Appends the segment's own element, from its first corner to `given` before its end. What follows is dropped.
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
        Corner::Stop => {
            (element.junction_limit_sq, element.segment_start) = (0.0, Some(0.0));
            element.starts_at_rest = open.starts_at_rest;
        }
        Corner::Smooth => element.segment_start = Some(0.0),
        Corner::TangentBreak(_) | Corner::Blend { .. } => {}
    }
    limit_crowded_speed(
        edit.elements.end(),
        edit.motion.at,
        edit.limits,
        (edit.elements, &mut edit.first_changed),
    );
}

fn push_corner(before: &NominalSegment, after: &mut OpenSegment, edit: &mut PathEdit<'_>) {
    after.segment.start_trim = 0.0;
    let CornerForm { before: d, after: e, is_round } = after.corner_form;
    if let Corner::TangentBreak(tangent_break) = &after.corner {
        push(&tangent_break.end(before, d), edit);
        push(&tangent_break.start(&after.segment, e), edit);
        after.segment.start_trim = e;
    }
    if let Corner::Blend { .. } = after.corner {
        if is_round {
            let change = tangent_change(before, &after.segment);
            push(&after.round.arc((before, &after.segment), (&change, d), edit.limits), edit);
        } else if are_lines(before, &after.segment) {
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

/// Completes an element in its place in the queue.
fn finish_element(place: u64, edit: &mut PathEdit<'_>) {
    if let Some(element) = edit.elements.get_mut(place)
        && matches!(element.model, AccelerationModel::Blend { .. })
        && element.axis_count <= 3
    {
        BlendLimits::compute(element, edit.limits);
    }
    limit_crowded_speed(
        place.wrapping_add(1),
        edit.motion.at,
        edit.limits,
        (edit.elements, &mut edit.first_changed),
    );
}
