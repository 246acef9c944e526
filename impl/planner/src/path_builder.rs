//! From segments to pieces: what a new segment does to the end of the path that is queued.
//!
//! A segment may go on in the last leg, where both are over within a cycle. The last two legs are open. A corner gets
//! what it can use of its legs, at least half of each; how much the corner after it leaves is known when that one is,
//! and the corner is then made anew. A path that has been promised to the motion is never changed so that it could
//! not be kept to: then the corner keeps the form it has, a stop at worst.

use crate::blend_limits::BlendLimits;
use crate::corner::{
    Corner, blended_end, blended_start, corner_lengths, split_place, tangent_change, write_parabola,
};
use crate::limits::{Limits, squared};
use crate::look_ahead::{LookAhead, axes_allow};
use crate::math;
use crate::motion::MotionState;
use crate::nominal_segment::NominalSegment;
use crate::parameters::Axes;
use crate::path_element::{AccelerationModel, FeedBasis, PathElement};
use crate::ring::Ring;
use crate::segment::Blend;

/// So many pieces may be touched in a cycle, by a limit of speed where they are short.
const ELEMENTS_PER_CROWDED_CYCLE: u64 = 3;
/// A leg that is shorter when its corners have taken theirs is left out, millimetres.
const ELEMENT_LENGTH_MIN_MM: f64 = 1e-12;
/// How much of a leg that begins smoothly or at rest its end may take.
const END_TRIM_RATIO_MAX: f64 = 0.96875;

/// A leg whose end may still change.
#[derive(Clone, Copy, Debug, Default)]
struct OpenSegment {
    leg: NominalSegment,
    /// The number of its first own piece, and whether the corners have left it one.
    main: u64,
    own: bool,
    /// The corner before it.
    corner: Corner,
    /// How much of the leg before it and of itself that corner has.
    given: (f64, f64),
}

/// The end of the path.
#[derive(Debug)]
pub(crate) struct PathBuilder {
    /// Where the last segment ends.
    pub(crate) end: Axes,
    /// The last two legs and room for a new one; `turn` is where the older one lies.
    legs: [OpenSegment; 3],
    turn: u8,
    /// How many of them there are since the path last closed.
    open: u8,
}

/// What a change of the path is made with.
#[derive(Debug)]
pub(crate) struct PathEdit<'a> {
    pub(crate) ring: &'a mut Ring<PathElement>,
    pub(crate) ahead: &'a mut LookAhead,
    pub(crate) motion: &'a MotionState,
    pub(crate) limits: &'a Limits,
    /// The first piece that has been changed, or that has been lowered for it.
    pub(crate) changed: u64,
    /// Whether the motion is still faster than it is planned, since an override has been lowered: what is planned
    /// says nothing of it then.
    pub(crate) late: bool,
}

impl PathBuilder {
    pub(crate) fn new(end: Axes) -> Self {
        Self { end, legs: [OpenSegment::default(); 3], turn: 0, open: 0 }
    }

    /// The path ends at rest here, for what comes next.
    pub(crate) fn close(&mut self) {
        self.open = 0;
    }

    /// The corner after the last leg comes to rest, if it is not made yet.
    pub(crate) fn stop_at_end(&mut self) {
        let (_, last, _) = in_order(&mut self.legs, self.turn);
        last.leg.blend = Blend::ExactStop;
    }

    /// Whether one of the last legs follows the spindle, of which pieces may have been made anew.
    pub(crate) fn follows_spindle(&self) -> bool {
        self.legs.iter().any(|open| open.leg.whole.pace == FeedBasis::PerTurn)
    }

    /// Seconds of rest at the end of the path.
    pub(crate) fn dwell(&mut self, seconds: f64, queue: &mut PathEdit<'_>) {
        let mut rest =
            PathElement { origin: self.end, end: self.end, exit: 1.0, ..PathElement::default() };
        rest.law = AccelerationModel::Dwell(seconds);
        rest.axes = self.end.len();
        queue.ring.push(&rest);
        self.close();
    }

    /// Where the next leg is to be written, and where it begins.
    pub(crate) fn new_segment(&mut self) -> (&mut NominalSegment, &Axes) {
        let (_, _, next) = in_order(&mut self.legs, self.turn);
        (&mut next.leg, &self.end)
    }

    /// Adds the leg that was written.
    #[inline]
    pub(crate) fn add(&mut self, queue: &mut PathEdit<'_>) {
        queue.changed = u64::MAX;
        let (before, last, next) = in_order(&mut self.legs, self.turn);
        self.end = next.leg.whole.end;
        if self.open > 0 && merge_next(before, last, next, queue) {
            return;
        }
        next.corner = Corner::Stop;
        if self.open > 0 {
            next.corner = Corner::between(&last.leg, &next.leg, queue.limits);
        }
        let made = match next.corner {
            Corner::Stop => false,
            Corner::Smooth | Corner::TangentBreak(_) | Corner::Blend { .. } => {
                self.open > 1 && enlarge_previous_corner(before, last, next, queue)
                    || make_corner(last, next, queue)
            }
        };
        if !made {
            next.corner = Corner::Stop;
            next.given = (0.0, 0.0);
            next.leg.taken = 0.0;
            next.main = queue.ring.end();
            push_own_element(next, 0.0, queue);
            update_look_ahead(queue);
        }
        self.turn = if self.turn == 2 { 0 } else { self.turn.saturating_add(1) };
        self.open = self.open.saturating_add(1).min(2);
    }
}

/// The leg before the last, the last and the next.
fn in_order(
    legs: &mut [OpenSegment; 3],
    turn: u8,
) -> (&mut OpenSegment, &mut OpenSegment, &mut OpenSegment) {
    let [one, two, three] = legs;
    match turn {
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
    queue: &mut PathEdit<'_>,
) -> bool {
    if !last.leg.can_merge_with(&next.leg, queue.limits) {
        return false;
    }
    let old = *last;
    if !last.leg.merge(&next.leg, queue.limits) {
        last.leg = old.leg;
        return false;
    }
    if last.corner == Corner::Stop {
        let motion = queue.motion;
        let begun = motion.at > last.main
            || motion.at == last.main && (motion.x > 0.0 || motion.speed > 0.0);
        if begun {
            last.leg = old.leg;
        } else {
            push_own_element(last, 0.0, queue);
            update_look_ahead(queue);
        }
        return !begun;
    }
    last.corner = Corner::between(&before.leg, &last.leg, queue.limits);
    let given = provisional_lengths(before, last);
    if last.corner == Corner::Stop || !can_end_earlier(before, given.0, queue) {
        *last = old;
        return false;
    }
    remake_corner_and_next(before, last, given, queue);
    if is_accepted(queue) {
        return true;
    }
    *last = old;
    remake_corner(before, last, queue);
    push_own_element(last, 0.0, queue);
    update_look_ahead(queue);
    queue.changed = u64::MAX;
    false
}

/// Makes the corner before the last leg anew where it may have more, and then the one before the next.
#[inline]
fn enlarge_previous_corner(
    before: &mut OpenSegment,
    last: &mut OpenSegment,
    next: &mut OpenSegment,
    queue: &mut PathEdit<'_>,
) -> bool {
    let Corner::Blend { most, half: false } = last.corner else { return false };
    let length = last.leg.whole.length;
    let left = match next.corner {
        Corner::Blend { most, .. } => length - most,
        Corner::TangentBreak(kink) => length - kink.near.min(0.5 * length),
        Corner::Stop | Corner::Smooth => length * END_TRIM_RATIO_MAX,
    };
    let after = left.max(0.5 * length);
    let given = corner_lengths(
        most,
        (available_length(before), after),
        are_lines(&before.leg, &last.leg),
        before.leg.whole.exit,
    );
    if given.0 <= last.given.0 * (1.0 + 1e-9) || !can_end_earlier(before, given.0, queue) {
        return false;
    }
    let old = last.given;
    last.given = given;
    remake_corner(before, last, queue);
    remake_corner_and_next(last, next, provisional_lengths(last, next), queue);
    if is_accepted(queue) {
        return true;
    }
    last.given = old;
    remake_corner(before, last, queue);
    push_own_element(last, 0.0, queue);
    update_look_ahead(queue);
    false
}

/// Makes the corner between the last leg and the next.
fn make_corner(last: &mut OpenSegment, next: &mut OpenSegment, queue: &mut PathEdit<'_>) -> bool {
    let given = provisional_lengths(last, next);
    if !can_end_earlier(last, given.0, queue) {
        return false;
    }
    remake_corner_and_next(last, next, given, queue);
    if is_accepted(queue) {
        return true;
    }
    push_own_element(last, 0.0, queue);
    update_look_ahead(queue);
    false
}

/// What a form of the path has lowered is computed anew for the one that takes its place.
fn update_look_ahead(queue: &mut PathEdit<'_>) -> u64 {
    let places = (queue.changed, queue.motion.at);
    queue.changed = queue.ahead.recompute(queue.ring, places, queue.limits);
    queue.changed
}

/// Whether the motion can keep to a changed path.
fn is_accepted(queue: &mut PathEdit<'_>) -> bool {
    let changed = queue.changed;
    let first = update_look_ahead(queue);
    if queue.late {
        return axes_allow(queue.ring, queue.motion, changed, queue.limits);
    }
    first > queue.motion.at.saturating_add(1) || queue.motion.can_follow(queue.ring, queue.limits)
}

/// Whether a leg can end so much earlier: it must not be over.
fn can_end_earlier(open: &OpenSegment, given: f64, queue: &PathEdit<'_>) -> bool {
    let left = open.leg.whole.length - open.leg.taken - given;
    let motion = queue.motion;
    motion.at < open.main
        || motion.at == open.main && open.own && motion.x < left - ELEMENT_LENGTH_MIN_MM
}

/// How much of a leg is left for the corner at its end.
fn available_length(open: &OpenSegment) -> f64 {
    match open.corner {
        Corner::TangentBreak(_) | Corner::Blend { .. } => open.leg.whole.length - open.leg.taken,
        Corner::Stop | Corner::Smooth => open.leg.whole.length * END_TRIM_RATIO_MAX,
    }
}

fn are_lines(before: &NominalSegment, after: &NominalSegment) -> bool {
    before.whole.circle.is_none() && after.whole.circle.is_none()
}

/// The lengths that a corner has before the one after it is known.
fn provisional_lengths(last: &OpenSegment, next: &OpenSegment) -> (f64, f64) {
    match next.corner {
        Corner::Stop | Corner::Smooth => (0.0, 0.0),
        Corner::TangentBreak(kink) => {
            // Half of a leg is left for the corner at its other end, and nothing is where that one begins at rest.
            let half = |leg: &NominalSegment| kink.near.min(0.5 * leg.whole.length);
            (half(&last.leg).min(available_length(last)), half(&next.leg))
        }
        Corner::Blend { most, half } => {
            let before = available_length(last);
            let before = if half { before.min(0.5 * last.leg.whole.length) } else { before };
            let rooms = (before, 0.5 * next.leg.whole.length);
            corner_lengths(most, rooms, are_lines(&last.leg, &next.leg), last.leg.whole.exit)
        }
    }
}

/// Makes the end of a leg anew and the corner after it.
fn remake_corner(before: &mut OpenSegment, last: &mut OpenSegment, queue: &mut PathEdit<'_>) {
    push_own_element(before, last.given.0, queue);
    push_corner(&before.leg, last, queue);
}

/// Makes the end of the last leg anew, the corner after it, and the next leg.
fn remake_corner_and_next(
    last: &mut OpenSegment,
    next: &mut OpenSegment,
    given: (f64, f64),
    queue: &mut PathEdit<'_>,
) {
    next.given = given;
    remake_corner(last, next, queue);
    push_own_element(next, 0.0, queue);
}

/// The leg's own piece, from its first corner to so much before its end; whatever lies from there on is forgotten.
fn push_own_element(open: &mut OpenSegment, given: f64, queue: &mut PathEdit<'_>) {
    queue.ring.truncate(open.main);
    queue.changed = queue.changed.min(open.main);
    let whole = &open.leg.whole;
    let (from, to) = (open.leg.taken, whole.length - given);
    open.own = to - from > ELEMENT_LENGTH_MIN_MM;
    if !open.own {
        return;
    }
    let Some(piece) = queue.ring.append() else { return };
    *piece = *whole;
    if from > 0.0 || given > 0.0 {
        piece.cut(from, to);
    }
    match open.corner {
        Corner::Stop => (piece.entry, piece.begins) = (0.0, Some(0.0)),
        Corner::Smooth => piece.begins = Some(0.0),
        Corner::TangentBreak(_) | Corner::Blend { .. } => {}
    }
    limit_crowded_speed(queue.ring.end(), queue);
}

fn push_corner(before: &NominalSegment, after: &mut OpenSegment, queue: &mut PathEdit<'_>) {
    after.leg.taken = 0.0;
    let (d, e) = after.given;
    if let Corner::TangentBreak(kink) = &after.corner {
        push(&kink.end(before, d), queue);
        push(&kink.start(&after.leg, e), queue);
        after.leg.taken = e;
    }
    if let Corner::Blend { .. } = after.corner {
        if are_lines(before, &after.leg) {
            push_blend((before, &after.leg), (d, e), queue);
        } else {
            let turn = tangent_change(before, &after.leg);
            push(&blended_end((before, &after.leg), &turn, d, queue.limits), queue);
            push(&blended_start((before, &after.leg), &turn, e, queue.limits), queue);
        }
        after.leg.taken = e;
    }
    after.main = queue.ring.end();
}

/// Appends the blend of two lines.
fn push_blend(
    (before, after): (&NominalSegment, &NominalSegment),
    given: (f64, f64),
    queue: &mut PathEdit<'_>,
) {
    let Some(blend) = queue.ring.append() else { return };
    write_parabola((before, after), given, queue.limits, blend);
    let middle = split_place(blend, queue.limits);
    let first = queue.ring.end().wrapping_sub(1);
    if let Some(middle) = middle
        && let Some(second) = queue.ring.append_copy()
    {
        second.cut(middle, second.length);
        second.begins = Some(0.0);
        queue.limits.assign_model(second);
        if let Some(first) = queue.ring.get_mut(first) {
            first.cut(0.0, middle);
            queue.limits.assign_model(first);
        }
        finish_element(first, queue);
        finish_element(first.wrapping_add(1), queue);
    } else {
        finish_element(first, queue);
    }
}

fn push(piece: &PathElement, queue: &mut PathEdit<'_>) {
    queue.ring.push(piece);
    finish_element(queue.ring.end().wrapping_sub(1), queue);
}

/// What a piece gets once it has its place.
fn finish_element(place: u64, queue: &mut PathEdit<'_>) {
    if let Some(piece) = queue.ring.get_mut(place)
        && matches!(piece.law, AccelerationModel::Blend { .. })
        && piece.axes <= 3
    {
        BlendLimits::compute(piece, queue.limits);
    }
    limit_crowded_speed(place.wrapping_add(1), queue);
}

/// Limits the speed of the last pieces before an end where too many would fit into a cycle.
fn limit_crowded_speed(end: u64, queue: &mut PathEdit<'_>) {
    let Some(last) = queue.ring.get(end.wrapping_sub(1)) else { return };
    // A piece that takes a cycle by itself is no part of a crowd.
    if last.length >= last.fastest * queue.limits.cycle {
        return;
    }
    let first = end.saturating_sub(ELEMENTS_PER_CROWDED_CYCLE);
    let (mut length, mut most) = (last.length, last.fastest);
    for place in first..end.wrapping_sub(1) {
        // Without so many before it there is no crowd.
        let Some(piece) = queue.ring.get(place) else { return };
        length += piece.length;
        most = math::max(most, piece.fastest);
    }
    if length >= most * queue.limits.cycle {
        return;
    }
    let fastest = length / queue.limits.cycle;
    let ceiling = squared(fastest);
    for place in first.max(queue.motion.at.saturating_add(1))..end {
        if let Some(piece) = queue.ring.get_mut(place)
            && piece.fastest > fastest
        {
            piece.ceiling = math::min(piece.ceiling, ceiling);
            piece.last_ceiling = math::min(piece.last_ceiling, ceiling);
            piece.fastest = fastest;
            queue.changed = queue.changed.min(place);
        }
    }
}
