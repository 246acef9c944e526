//! Look-ahead: keeps `entry_speed_sq` of all queued elements valid, and raises it when more is queued.
//!
//! A stored value may be lower than possible, never higher. So a lower value is passed on at once to all elements that
//! rely on it ([`LookAhead::recompute`]), and a higher one may travel back through the queue a few elements at a time
//! ([`LookAhead::advance`]).

use crate::entry_speed::{OverrideScale, max_entry_speed_sq, speed_sq_limits};
use crate::limits::{LimitTable, squared};
use crate::math;
use crate::motion::MotionState;
use crate::path_element::{AccelerationModel, PathElement};
use crate::ring::Ring;

/// How many elements ahead of the motion a change of override is planned for, and how near elements planned for the
/// old override may come.
const REPLAN_HORIZON_ELEMENTS: u64 = 256;
const REPLAN_SPAN_MAX: u64 = 2 * REPLAN_HORIZON_ELEMENTS;
/// After a change of override, each pass plans this many times as many elements as the one before, up to
/// `REPLAN_SPAN_MAX`.
const REPLAN_SPAN_GROWTH: u64 = 4;
/// So many elements are planned for a scale before another scale may replace it.
const REPLAN_SPAN_BEFORE_NEXT: u64 = 64;
/// The most by which a squared speed may grow where a blend does not let the motion slow down: many times what occurs.
const SPEED_SQ_GROWTH_MAX: f64 = 2.0;
/// The least distance of the motion from elements that could be raised, beyond its stopping distance.
const URGENT_MARGIN_ELEMENTS: u64 = 32;

/// A pass over the queue from new elements to old ones, which raises entry speeds.
#[derive(Clone, Copy, Debug)]
struct BackwardPass {
    next: u64,
    /// All elements down to here are computed; below, as long as something changes.
    floor: u64,
    /// The element at which it began.
    from: u64,
}

/// A scale that leaves the limits of the axes alone.
const UNLIMITED_SCALE: OverrideScale =
    OverrideScale { feed: f64::INFINITY, rapid: 1.0, spindle_speed: f64::INFINITY };

/// The state of look-ahead.
#[derive(Debug)]
pub(crate) struct LookAhead {
    /// The scale that is planned for from now on.
    pub(crate) scale: OverrideScale,
    /// The scale that some elements may still be planned for: at first those next to the motion, then those from
    /// `stale_from` on.
    old_scale: Option<OverrideScale>,
    /// The factor for squared speeds at the boundary to those elements.
    old_scale_factor_sq: f64,
    /// Elements from here on were made after the change, for the new scale.
    new_scale_from: u64,
    /// Up to this element, all elements next to the motion are planned for the new scale.
    planned_end: u64,
    pass: Option<BackwardPass>,
    /// Work that was too little for the next blend.
    spare_work: u32,
    /// The range of elements that a later pass has to raise.
    pending: Option<(u64, u64)>,
    /// From here on elements are planned for the old scale.
    stale_from: u64,
    /// How many elements of the old scale have been planned again.
    replanned_count: u64,
    /// How many elements the last pass changed. The next pass waits until it is worth as much.
    pass_length: u64,
    /// The highest scale that elements before `mixed_end`, which the motion has passed, may be planned for.
    passed_scale: OverrideScale,
    mixed_end: u64,
    /// While the motion is before this element, nothing is urgent and nothing has to be planned again; 0 if unknown.
    quiet_until: u64,
}

impl LookAhead {
    pub(crate) fn new(scale: OverrideScale) -> Self {
        Self {
            scale,
            old_scale: None,
            old_scale_factor_sq: 1.0,
            new_scale_from: 0,
            planned_end: 0,
            pass: None,
            spare_work: 0,
            pending: None,
            stale_from: u64::MAX,
            replanned_count: REPLAN_SPAN_MAX,
            pass_length: 0,
            passed_scale: scale,
            mixed_end: 0,
            quiet_until: 0,
        }
    }

    /// Computes the elements from `changed` on, and lowers those before them that relied on more. This includes
    /// elements that the motion has passed, since it may reverse. Returns the first element that changed. A lower
    /// value travels back by at most the stopping distance.
    pub(crate) fn recompute(
        &mut self,
        elements: &mut Ring<PathElement>,
        (changed, at): (u64, u64),
        limits: &LimitTable,
    ) -> u64 {
        let mut place = elements.end();
        let mut first = changed;
        // Everything down to here is computed; elements before it need not be raised.
        let mut settled = changed;
        let mut raised = true;
        // The entry speed of the element after it.
        let mut next = 0.0;
        let unusual = self.old_scale.is_some();
        // The motion has passed the elements before this one, among those before the changed ones.
        let passed = at.saturating_add(1).min(changed);
        while place > elements.first() {
            place = place.wrapping_sub(1);
            let Some(element) = elements.get_mut(place) else { break };
            let before = place < changed;
            let new = if unusual || place < passed {
                self.entry_speed_sq_while_replanning(
                    (place, place < passed),
                    element,
                    &mut next,
                    limits,
                )
            } else {
                entry_speed_sq(element, next, self.scale, limits)
            };
            if before {
                settled = place;
                let higher = new > element.entry_speed_sq;
                if higher || new.to_bits() == element.entry_speed_sq.to_bits() {
                    raised = higher && place > at;
                    if raised || !higher {
                        (element.entry_speed_sq, element.assumed_next_entry_sq) = (new, next);
                    }
                    break;
                }
                first = place;
            }
            (element.entry_speed_sq, element.assumed_next_entry_sq) = (new, next);
            next = new;
        }
        let below = settled.saturating_sub(1);
        let mut pending = match self.pending {
            Some((low, high)) if !raised => Some((low.min(below), high.min(below))),
            Some((low, _)) => Some((low.min(below), below)),
            None => raised.then_some((below, below)),
        };
        if unusual && let (Some((_, old)), Some((_, high))) = (self.pending, &mut pending) {
            // A part that has still to be planned for the new scale may have been left as it was.
            *high = old.min(elements.end().saturating_sub(1)).max(below);
        }
        self.pending = pending;
        if let Some((low, _)) = pending {
            self.quiet_until = self.quiet_until.min(self.quiet_end(low));
        }
        first
    }

    /// The entry speed of an element in two unusual cases. An element that the motion has passed gets what the axes
    /// allow, whatever scale it was planned for. An element in the range of the old scale is planned for the higher
    /// scale, and the boundary is scaled down.
    #[cold]
    #[inline(never)]
    fn entry_speed_sq_while_replanning(
        &self,
        (place, passed): (u64, bool),
        element: &PathElement,
        next: &mut f64,
        limits: &LimitTable,
    ) -> f64 {
        let scale = if passed {
            UNLIMITED_SCALE
        } else if place >= self.stale_from && place < self.new_scale_from {
            self.highest_scale()
        } else {
            self.scale
        };
        if !passed && place.saturating_add(1) == self.stale_from {
            *next *= self.old_scale_factor_sq;
        }
        entry_speed_sq(element, *next, scale, limits)
    }

    /// A pass has ended while some elements are planned for the old scale: records how far the new plan is connected.
    #[cold]
    #[inline(never)]
    fn finish_pass(&mut self, pass: &BackwardPass, at: u64) {
        if pass.floor <= self.planned_end {
            self.planned_end = self.planned_end.max(pass.from.saturating_add(1));
        }
        if self.planned_end >= self.new_scale_from {
            self.old_scale = None;
            self.mixed_end = at.saturating_add(1);
        }
    }

    /// Raises elements until `work` is used up. If `eager`, it starts as soon as there is something to raise;
    /// otherwise when that is worth it.
    pub(crate) fn advance(
        &mut self,
        elements: &mut Ring<PathElement>,
        at: u64,
        limits: &LimitTable,
        (work, eager): (u32, bool),
    ) {
        let mut left = work.saturating_add(core::mem::take(&mut self.spare_work));
        while left > 0 {
            let Some(mut pass) = self.pass.take().or_else(|| self.begin_pass(at, eager)) else {
                return;
            };
            pass.next = pass.next.min(elements.end().saturating_sub(1));
            if self.run_pass(&mut pass, elements, at, limits, &mut left) {
                self.pass_length = pass.from.saturating_sub(pass.next);
                self.quiet_until = 0;
                if self.old_scale.is_some() {
                    self.finish_pass(&pass, at);
                }
            } else {
                self.pass = Some(pass);
                self.spare_work = left;
                return;
            }
        }
    }

    /// Continues a pass while there is work left. Returns whether the pass has ended.
    #[inline]
    fn run_pass(
        &self,
        pass: &mut BackwardPass,
        elements: &mut Ring<PathElement>,
        at: u64,
        limits: &LimitTable,
        left: &mut u32,
    ) -> bool {
        let last = at.max(elements.first());
        let mut next =
            elements.get(pass.next.wrapping_add(1)).map_or(0.0, |next| next.entry_speed_sq);
        if pass.next == pass.from && pass.from >= self.stale_from {
            next *= self.old_scale_factor_sq;
        }
        loop {
            if pass.next < last {
                return true;
            }
            let Some(element) = elements.get_mut(pass.next) else { return true };
            // A blend takes two units of work, any other element one.
            let work = if matches!(element.model, AccelerationModel::Blend { .. }) { 2 } else { 1 };
            let Some(rest) = left.checked_sub(work) else { return false };
            *left = rest;
            let new = entry_speed_sq(element, next, self.scale, limits);
            let same = new.to_bits() == element.entry_speed_sq.to_bits();
            (element.entry_speed_sq, element.assumed_next_entry_sq) = (new, next);
            if same && pass.next < pass.floor || pass.next == 0 {
                return true;
            }
            next = new;
            pass.next = pass.next.wrapping_sub(1);
        }
    }

    /// Whether there is something to raise that the motion will soon reach.
    pub(crate) fn is_urgent(&self, at: u64) -> bool {
        let soon = self.urgent_end(at);
        self.pass.is_some_and(|pass| pass.floor < soon)
            || self.pending.is_some_and(|(low, _)| low < soon)
    }

    /// The end of the range that the motion may soon reach: the length of the last pass approximates the stopping
    /// distance.
    fn urgent_end(&self, at: u64) -> u64 {
        at.saturating_add(self.pass_length).saturating_add(URGENT_MARGIN_ELEMENTS)
    }

    /// While the motion is before this element, it does not soon reach `place`.
    fn quiet_end(&self, place: u64) -> u64 {
        place.saturating_sub(self.pass_length).saturating_sub(URGENT_MARGIN_ELEMENTS)
    }

    fn begin_pass(&mut self, at: u64, eager: bool) -> Option<BackwardPass> {
        let (low, high) = self.pending?;
        if !eager && high.saturating_sub(low) < self.pass_length && low > self.urgent_end(at) {
            return None;
        }
        self.pending = None;
        Some(BackwardPass { next: high, floor: low, from: high })
    }

    /// The highest scale that any element next to the motion is planned for.
    pub(crate) fn highest_scale(&self) -> OverrideScale {
        self.old_scale.map_or(self.scale, |before| before.max(self.scale))
    }

    /// Whether the elements next to the motion are planned for the current scale.
    #[inline]
    pub(crate) fn is_ready(&self, at: u64) -> bool {
        self.old_scale.is_none() || at.saturating_add(1) < self.planned_end
    }

    /// Whether the elements next to the motion are planned for these overrides.
    #[inline]
    pub(crate) fn plans_for(&self, feed: f64, rapid: f64, at: u64) -> bool {
        self.is_ready(at)
            && self.scale.feed.to_bits() == feed.to_bits()
            && self.scale.rapid.to_bits() == rapid.to_bits()
    }

    /// Whether it is already known that this cycle has nothing to do.
    #[inline]
    pub(crate) fn is_quiet(&self, at: u64) -> bool {
        at < self.quiet_until
    }

    /// Spares the next cycle a check where there is nothing to do.
    #[inline]
    pub(crate) fn note_quiet_after_queueing(&mut self, at: u64) {
        if self.stale_from > at.saturating_add(REPLAN_HORIZON_ELEMENTS) && !self.is_urgent(at) {
            self.note_quiet();
        }
    }

    /// Records up to where nothing is urgent.
    pub(crate) fn note_quiet(&mut self) {
        let floor = self.pass.map_or(u64::MAX, |pass| pass.floor);
        let low = self.pending.map_or(u64::MAX, |(low, _)| low);
        self.quiet_until = self
            .quiet_end(floor.min(low))
            .min(self.stale_from.saturating_sub(REPLAN_HORIZON_ELEMENTS));
    }

    /// Plans for other overrides from now on: the next elements at once, the others when the motion comes near.
    pub(crate) fn rescale(&mut self, scale: OverrideScale, elements: &Ring<PathElement>, at: u64) {
        let planned = self.highest_scale();
        let forgotten = elements.first() >= self.mixed_end;
        self.passed_scale = if forgotten { planned } else { self.passed_scale.max(planned) };
        self.mixed_end = u64::MAX;
        self.scale = scale;
        self.replan(planned, elements, at);
    }

    /// The motion has reversed and goes forward again, over elements that may be planned for an old scale.
    pub(crate) fn resume_after_retrace(&mut self, elements: &Ring<PathElement>, at: u64) {
        if at < self.mixed_end {
            self.replan(self.highest_scale().max(self.passed_scale), elements, at);
        }
    }

    /// From here on elements may be planned for up to `before`, and are to be planned for the current scale.
    fn replan(&mut self, before: OverrideScale, elements: &Ring<PathElement>, at: u64) {
        self.old_scale = Some(before);
        (self.old_scale_factor_sq, self.planned_end) = (self.scale.speed_sq_factor(before), at);
        self.new_scale_from = elements.end();
        (self.stale_from, self.replanned_count) = (at, 1);
        self.extend_replan(elements, at);
    }

    /// Whether the scale may be replaced: enough is planned for it that this does not happen in every cycle, or
    /// nothing is left to do.
    pub(crate) fn may_rescale(&self, at: u64) -> bool {
        self.replanned_count >= REPLAN_SPAN_BEFORE_NEXT || !self.is_urgent(at)
    }

    /// Plans elements of the old scale again when the motion comes near: a few at first, so that it need not wait for
    /// many.
    pub(crate) fn refresh(&mut self, elements: &Ring<PathElement>, at: u64) {
        if !(self.stale_from > at.saturating_add(REPLAN_HORIZON_ELEMENTS)
            || self.replanned_count < REPLAN_SPAN_MAX && self.is_urgent(at))
        {
            self.extend_replan(elements, at);
        }
    }

    fn extend_replan(&mut self, elements: &Ring<PathElement>, at: u64) {
        self.quiet_until = 0;
        let newest = elements.end().saturating_sub(1);
        self.replanned_count =
            self.replanned_count.saturating_mul(REPLAN_SPAN_GROWTH).min(REPLAN_SPAN_MAX);
        let high = at.saturating_add(self.replanned_count).min(newest);
        let low = self.stale_from.min(high).max(at);
        // The new pass includes what the old one had left.
        let low = low.min(self.pass.take().map_or(low, |pass| pass.floor));
        self.pending = Some(self.pending.map_or((low, high), |(old, _)| (old.min(low), high)));
        self.stale_from =
            if high >= newest || high >= self.new_scale_from { u64::MAX } else { high };
    }
}

/// The squared entry speed of an element, given that of the next one.
#[inline]
fn entry_speed_sq(
    element: &PathElement,
    next: f64,
    scale: OverrideScale,
    limits: &LimitTable,
) -> f64 {
    max_entry_speed_sq(
        element,
        next / squared(element.end_speed_ratio),
        speed_sq_limits(element, scale),
        limits.of(element),
    )
}

/// Whether the axes allow the motion, at its present speed, to follow a path that changes from an element on, whatever
/// is planned for it.
#[cold]
#[inline(never)]
pub(crate) fn axes_allow(
    elements: &Ring<PathElement>,
    motion: &MotionState,
    changed: u64,
    limits: &LimitTable,
) -> bool {
    let Some(element) = elements.get(motion.at) else { return true };
    // The motion slows down, unless a blend prevents it. So elements that allow much more need not be checked.
    let most = SPEED_SQ_GROWTH_MAX
        * squared(motion.speed)
        * math::max(1.0, squared(element.end_speed_ratio));
    let (mut next, mut place) = (0.0, elements.end());
    while place > motion.at.saturating_add(1) {
        place = place.wrapping_sub(1);
        let Some(element) = elements.get(place) else { break };
        next = entry_speed_sq(element, next, UNLIMITED_SCALE, limits);
        if place < changed && next >= most {
            return true;
        }
    }
    motion.can_reach_end_at(element, next / squared(element.end_speed_ratio), limits.of(element))
}
