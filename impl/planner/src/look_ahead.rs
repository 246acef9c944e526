//! Look-ahead: keeps `reach` of all queued pieces true, and raises it when more is queued.
//!
//! What is stored may be lower than it could be, never higher. So a lower value must reach all pieces that rely on it
//! at once ([`LookAhead::settle`]), and a higher one may run back through the queue a few pieces at a time
//! ([`LookAhead::work`]).

use crate::entry_speed::{OverrideScale, max_entry_speed_sq, speed_sq_limits};
use crate::limits::{Limits, squared};
use crate::math;
use crate::motion::MotionState;
use crate::path_element::{AccelerationModel, PathElement};
use crate::ring::Ring;

/// Pieces before the one in execution that a change of override is planned for; and how near unplanned ones may come.
const REPLAN_HORIZON_ELEMENTS: u64 = 256;
const REPLAN_SPAN_MAX: u64 = 2 * REPLAN_HORIZON_ELEMENTS;
/// How many pieces next to the motion are planned for another scale first; then always so many times as many, up to
/// two horizons.
const REPLAN_SPAN_GROWTH: u64 = 4;
/// So many are planned for a scale before another one may take its place.
const REPLAN_SPAN_BEFORE_NEXT: u64 = 64;
/// By so much the square of a speed may grow at most where axes do not let the motion slow down: many times of what
/// it does.
const SPEED_SQ_GROWTH_MAX: f64 = 2.0;
/// How near the motion may come to pieces that could be raised, beyond what it takes to stop.
const URGENT_MARGIN_ELEMENTS: u64 = 32;

/// The run of a raise through the queue, from new pieces to old.
#[derive(Clone, Copy, Debug)]
struct BackwardPass {
    next: u64,
    /// Down to here all are computed; below, as far as something changes.
    floor: u64,
    /// Where it began.
    from: u64,
}

/// What the axes allow, whatever is asked for.
const UNLIMITED_SCALE: OverrideScale =
    OverrideScale { feed: f64::INFINITY, rapid: 1.0, spindle_speed: f64::INFINITY };

/// What look-ahead has still to do.
#[derive(Debug)]
pub(crate) struct LookAhead {
    /// What is planned for from now on.
    pub(crate) scale: OverrideScale,
    /// What pieces may still be planned for, while they are planned for another scale: at first those next to the
    /// motion, then from `stale` on.
    old_scale: Option<OverrideScale>,
    /// By how much the squares of speeds are less that are allowed where those begin.
    old_scale_factor_sq: f64,
    /// Those made since are planned for this scale.
    new_scale_from: u64,
    /// Up to this piece all next to the motion are planned for this scale, so that they can be kept to as they are.
    planned_end: u64,
    pass: Option<BackwardPass>,
    /// Work that was too little for the next bend.
    spare_work: u32,
    /// Pieces from the first to the second, whose raise no wave has taken up.
    pending: Option<(u64, u64)>,
    /// From here on pieces are planned for another scale.
    stale_from: u64,
    /// How many pieces have been taken up that were planned for another scale.
    replanned_count: u64,
    /// How many pieces the last wave changed, which the next one has to be worth.
    pass_length: u64,
    /// The most that pieces before `mixed` may be planned for, which the motion has passed.
    passed_scale: OverrideScale,
    mixed_end: u64,
    /// While the motion is before this piece, nothing is pressing and nothing to be taken up; 0 where it is not known.
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

    /// Computes the pieces from `changed` on, and lowers those before them that relied on more, those behind the
    /// motion, too, which may run back. Gives back the first piece that is another now. A lower value runs back
    /// through as many pieces as it takes to stop, at most.
    pub(crate) fn recompute(
        &mut self,
        elements: &mut Ring<PathElement>,
        (changed, at): (u64, u64),
        limits: &Limits,
    ) -> u64 {
        let mut place = elements.end();
        let mut first = changed;
        // Down to here all is computed, and what lies before it need not be raised for it.
        let mut settled = changed;
        let mut raised = true;
        // How fast the piece after it may be entered.
        let mut next = 0.0;
        let unusual = self.old_scale.is_some();
        // Up to here the motion has passed those before the changed ones.
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
            // What has still to be planned for this scale may have been left as it was.
            *high = old.min(elements.end().saturating_sub(1)).max(below);
        }
        self.pending = pending;
        if let Some((low, _)) = pending {
            self.quiet_until = self.quiet_until.min(self.quiet_end(low));
        }
        first
    }

    /// How fast a piece may be entered that the motion has passed, whatever it is planned for: as the axes allow it.
    /// And what is planned for one that lies before the motion while some are still planned for another scale: where
    /// these begin, the one after it may be entered eased.
    #[cold]
    #[inline(never)]
    fn entry_speed_sq_while_replanning(
        &self,
        (place, passed): (u64, bool),
        element: &PathElement,
        next: &mut f64,
        limits: &Limits,
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

    /// A wave has come to its end while some pieces are planned for another scale: what it has planned is known where
    /// it joins what was.
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

    /// Raises pieces for so much work. With `eager` it begins as soon as there is something to raise, otherwise when
    /// it is worth it.
    pub(crate) fn advance(
        &mut self,
        elements: &mut Ring<PathElement>,
        at: u64,
        limits: &Limits,
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

    /// Runs a wave on while there is work left to do; whether it has come to its end.
    #[inline]
    fn run_pass(
        &self,
        pass: &mut BackwardPass,
        elements: &mut Ring<PathElement>,
        at: u64,
        limits: &Limits,
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
            // A bend takes two of the work, any other piece one.
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

    /// Whether there is something to raise that the motion will soon come to.
    pub(crate) fn is_urgent(&self, at: u64) -> bool {
        let soon = self.urgent_end(at);
        self.pass.is_some_and(|pass| pass.floor < soon)
            || self.pending.is_some_and(|(low, _)| low < soon)
    }

    /// Up to where the motion may soon be: what the last wave changed is what it takes to stop.
    fn urgent_end(&self, at: u64) -> u64 {
        at.saturating_add(self.pass_length).saturating_add(URGENT_MARGIN_ELEMENTS)
    }

    /// While the motion is before this piece, it will not come soon to that one.
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

    /// The most that any piece next to the motion is planned for.
    pub(crate) fn highest_scale(&self) -> OverrideScale {
        self.old_scale.map_or(self.scale, |before| before.max(self.scale))
    }

    /// Whether the pieces next to the motion are planned for the scale.
    #[inline]
    pub(crate) fn is_ready(&self, at: u64) -> bool {
        self.old_scale.is_none() || at.saturating_add(1) < self.planned_end
    }

    /// Whether the pieces next to the motion are planned for these shares.
    #[inline]
    pub(crate) fn plans_for(&self, feed: f64, rapid: f64, at: u64) -> bool {
        self.is_ready(at)
            && self.scale.feed.to_bits() == feed.to_bits()
            && self.scale.rapid.to_bits() == rapid.to_bits()
    }

    /// Whether there is nothing to do in a cycle, as is known since the last one.
    #[inline]
    pub(crate) fn is_quiet(&self, at: u64) -> bool {
        at < self.quiet_until
    }

    /// Spares the next cycle a look where there is nothing to do.
    #[inline]
    pub(crate) fn note_quiet_after_queueing(&mut self, at: u64) {
        if self.stale_from > at.saturating_add(REPLAN_HORIZON_ELEMENTS) && !self.is_urgent(at) {
            self.note_quiet();
        }
    }

    /// Nothing is pressing: notes up to where that stays so.
    pub(crate) fn note_quiet(&mut self) {
        let floor = self.pass.map_or(u64::MAX, |pass| pass.floor);
        let low = self.pending.map_or(u64::MAX, |(low, _)| low);
        self.quiet_until = self
            .quiet_end(floor.min(low))
            .min(self.stale_from.saturating_sub(REPLAN_HORIZON_ELEMENTS));
    }

    /// Plans for other overrides from now on: what lies next is planned anew, the rest when the motion comes near.
    pub(crate) fn rescale(&mut self, scale: OverrideScale, elements: &Ring<PathElement>, at: u64) {
        let planned = self.highest_scale();
        let forgotten = elements.first() >= self.mixed_end;
        self.passed_scale = if forgotten { planned } else { self.passed_scale.max(planned) };
        self.mixed_end = u64::MAX;
        self.scale = scale;
        self.replan(planned, elements, at);
    }

    /// The motion has run back, and is to go on from here: over pieces that may be planned for what is long over.
    pub(crate) fn resume_after_retrace(&mut self, elements: &Ring<PathElement>, at: u64) {
        if at < self.mixed_end {
            self.replan(self.highest_scale().max(self.passed_scale), elements, at);
        }
    }

    /// From here on pieces are planned for no more than this.
    fn replan(&mut self, before: OverrideScale, elements: &Ring<PathElement>, at: u64) {
        self.old_scale = Some(before);
        (self.old_scale_factor_sq, self.planned_end) = (self.scale.speed_sq_factor(before), at);
        self.new_scale_from = elements.end();
        (self.stale_from, self.replanned_count) = (at, 1);
        self.extend_replan(elements, at);
    }

    /// Whether another scale may be planned for: so much is planned for this one that it does not happen in each
    /// cycle, or nothing is left to do.
    pub(crate) fn may_rescale(&self, at: u64) -> bool {
        self.replanned_count >= REPLAN_SPAN_BEFORE_NEXT || !self.is_urgent(at)
    }

    /// Takes up pieces that are planned for another scale when the motion comes near: a few at first, so that it need
    /// not wait for many.
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
        // What a wave was still to come to is come to by the next one.
        let low = low.min(self.pass.take().map_or(low, |pass| pass.floor));
        self.pending = Some(self.pending.map_or((low, high), |(old, _)| (old.min(low), high)));
        self.stale_from =
            if high >= newest || high >= self.new_scale_from { u64::MAX } else { high };
    }
}

/// The square of the speed at which a piece may be entered, by that of the next one.
#[inline]
fn entry_speed_sq(element: &PathElement, next: f64, scale: OverrideScale, limits: &Limits) -> f64 {
    max_entry_speed_sq(
        element,
        next / squared(element.end_speed_ratio),
        speed_sq_limits(element, scale),
        limits,
    )
}

/// Whether the axes allow the motion, as fast as it is, to keep to a path that is changed from a piece on, whatever
/// is planned for it.
#[cold]
#[inline(never)]
pub(crate) fn axes_allow(
    elements: &Ring<PathElement>,
    motion: &MotionState,
    changed: u64,
    limits: &Limits,
) -> bool {
    let Some(element) = elements.get(motion.at) else { return true };
    // It slows down, but where a bend does not let it; so it need not be looked at where much more is allowed.
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
    motion.can_reach_end_at(element, next / squared(element.end_speed_ratio), limits)
}
