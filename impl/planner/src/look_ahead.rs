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
    OverrideScale { feed: f64::INFINITY, rapid: 1.0, turns: f64::INFINITY };

/// What look-ahead has still to do.
#[derive(Debug)]
pub(crate) struct LookAhead {
    /// What is planned for from now on.
    pub(crate) scale: OverrideScale,
    /// What pieces may still be planned for, while they are planned for another scale: at first those next to the
    /// motion, then from `stale` on.
    before: Option<OverrideScale>,
    /// By how much the squares of speeds are less that are allowed where those begin.
    eased: f64,
    /// Those made since are planned for this scale.
    since: u64,
    /// Up to this piece all next to the motion are planned for this scale, so that they can be kept to as they are.
    known: u64,
    wave: Option<BackwardPass>,
    /// Work that was too little for the next bend.
    spare: u32,
    /// Pieces from the first to the second, whose raise no wave has taken up.
    pending: Option<(u64, u64)>,
    /// From here on pieces are planned for another scale.
    stale: u64,
    /// How many pieces have been taken up that were planned for another scale.
    span: u64,
    /// How many pieces the last wave changed, which the next one has to be worth.
    touched: u64,
    /// The most that pieces before `mixed` may be planned for, which the motion has passed.
    passed: OverrideScale,
    mixed: u64,
    /// While the motion is before this piece, nothing is pressing and nothing to be taken up; 0 where it is not known.
    quiet: u64,
}

impl LookAhead {
    pub(crate) fn new(scale: OverrideScale) -> Self {
        Self {
            scale,
            before: None,
            eased: 1.0,
            since: 0,
            known: 0,
            wave: None,
            spare: 0,
            pending: None,
            stale: u64::MAX,
            span: REPLAN_SPAN_MAX,
            touched: 0,
            passed: scale,
            mixed: 0,
            quiet: 0,
        }
    }

    /// Computes the pieces from `changed` on, and lowers those before them that relied on more, those behind the
    /// motion, too, which may run back. Gives back the first piece that is another now. A lower value runs back
    /// through as many pieces as it takes to stop, at most.
    pub(crate) fn recompute(
        &mut self,
        ring: &mut Ring<PathElement>,
        (changed, at): (u64, u64),
        limits: &Limits,
    ) -> u64 {
        let mut place = ring.end();
        let mut first = changed;
        // Down to here all is computed, and what lies before it need not be raised for it.
        let mut settled = changed;
        let mut raised = true;
        // How fast the piece after it may be entered.
        let mut next = 0.0;
        let unusual = self.before.is_some();
        // Up to here the motion has passed those before the changed ones.
        let passed = at.saturating_add(1).min(changed);
        while place > ring.first() {
            place = place.wrapping_sub(1);
            let Some(piece) = ring.get_mut(place) else { break };
            let before = place < changed;
            let new = if unusual || place < passed {
                self.entry_speed_sq_while_replanning(
                    (place, place < passed),
                    piece,
                    &mut next,
                    limits,
                )
            } else {
                entry_speed_sq(piece, next, self.scale, limits)
            };
            if before {
                settled = place;
                let higher = new > piece.reach;
                if higher || new.to_bits() == piece.reach.to_bits() {
                    raised = higher && place > at;
                    if raised || !higher {
                        (piece.reach, piece.relied) = (new, next);
                    }
                    break;
                }
                first = place;
            }
            (piece.reach, piece.relied) = (new, next);
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
            *high = old.min(ring.end().saturating_sub(1)).max(below);
        }
        self.pending = pending;
        if let Some((low, _)) = pending {
            self.quiet = self.quiet.min(self.quiet_end(low));
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
        piece: &PathElement,
        next: &mut f64,
        limits: &Limits,
    ) -> f64 {
        let scale = if passed {
            UNLIMITED_SCALE
        } else if place >= self.stale && place < self.since {
            self.highest_scale()
        } else {
            self.scale
        };
        if !passed && place.saturating_add(1) == self.stale {
            *next *= self.eased;
        }
        entry_speed_sq(piece, *next, scale, limits)
    }

    /// A wave has come to its end while some pieces are planned for another scale: what it has planned is known where
    /// it joins what was.
    #[cold]
    #[inline(never)]
    fn finish_pass(&mut self, wave: &BackwardPass, at: u64) {
        if wave.floor <= self.known {
            self.known = self.known.max(wave.from.saturating_add(1));
        }
        if self.known >= self.since {
            self.before = None;
            self.mixed = at.saturating_add(1);
        }
    }

    /// Raises pieces for so much work. With `eager` it begins as soon as there is something to raise, otherwise when
    /// it is worth it.
    pub(crate) fn advance(
        &mut self,
        ring: &mut Ring<PathElement>,
        at: u64,
        limits: &Limits,
        (work, eager): (u32, bool),
    ) {
        let mut left = work.saturating_add(core::mem::take(&mut self.spare));
        while left > 0 {
            let Some(mut wave) = self.wave.take().or_else(|| self.begin_pass(at, eager)) else {
                return;
            };
            wave.next = wave.next.min(ring.end().saturating_sub(1));
            if self.run_pass(&mut wave, ring, at, limits, &mut left) {
                self.touched = wave.from.saturating_sub(wave.next);
                self.quiet = 0;
                if self.before.is_some() {
                    self.finish_pass(&wave, at);
                }
            } else {
                self.wave = Some(wave);
                self.spare = left;
                return;
            }
        }
    }

    /// Runs a wave on while there is work left to do; whether it has come to its end.
    #[inline]
    fn run_pass(
        &self,
        wave: &mut BackwardPass,
        ring: &mut Ring<PathElement>,
        at: u64,
        limits: &Limits,
        left: &mut u32,
    ) -> bool {
        let last = at.max(ring.first());
        let mut next = ring.get(wave.next.wrapping_add(1)).map_or(0.0, |next| next.reach);
        if wave.next == wave.from && wave.from >= self.stale {
            next *= self.eased;
        }
        loop {
            if wave.next < last {
                return true;
            }
            let Some(piece) = ring.get_mut(wave.next) else { return true };
            // A bend takes two of the work, any other piece one.
            let work = if matches!(piece.law, AccelerationModel::Blend { .. }) { 2 } else { 1 };
            let Some(rest) = left.checked_sub(work) else { return false };
            *left = rest;
            let new = entry_speed_sq(piece, next, self.scale, limits);
            let same = new.to_bits() == piece.reach.to_bits();
            (piece.reach, piece.relied) = (new, next);
            if same && wave.next < wave.floor || wave.next == 0 {
                return true;
            }
            next = new;
            wave.next = wave.next.wrapping_sub(1);
        }
    }

    /// Whether there is something to raise that the motion will soon come to.
    pub(crate) fn is_urgent(&self, at: u64) -> bool {
        let soon = self.urgent_end(at);
        self.wave.is_some_and(|wave| wave.floor < soon)
            || self.pending.is_some_and(|(low, _)| low < soon)
    }

    /// Up to where the motion may soon be: what the last wave changed is what it takes to stop.
    fn urgent_end(&self, at: u64) -> u64 {
        at.saturating_add(self.touched).saturating_add(URGENT_MARGIN_ELEMENTS)
    }

    /// While the motion is before this piece, it will not come soon to that one.
    fn quiet_end(&self, place: u64) -> u64 {
        place.saturating_sub(self.touched).saturating_sub(URGENT_MARGIN_ELEMENTS)
    }

    fn begin_pass(&mut self, at: u64, eager: bool) -> Option<BackwardPass> {
        let (low, high) = self.pending?;
        if !eager && high.saturating_sub(low) < self.touched && low > self.urgent_end(at) {
            return None;
        }
        self.pending = None;
        Some(BackwardPass { next: high, floor: low, from: high })
    }

    /// The most that any piece next to the motion is planned for.
    pub(crate) fn highest_scale(&self) -> OverrideScale {
        self.before.map_or(self.scale, |before| before.max(self.scale))
    }

    /// Whether the pieces next to the motion are planned for the scale.
    #[inline]
    pub(crate) fn is_ready(&self, at: u64) -> bool {
        self.before.is_none() || at.saturating_add(1) < self.known
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
        at < self.quiet
    }

    /// Spares the next cycle a look where there is nothing to do.
    #[inline]
    pub(crate) fn note_quiet_after_queueing(&mut self, at: u64) {
        if self.stale > at.saturating_add(REPLAN_HORIZON_ELEMENTS) && !self.is_urgent(at) {
            self.note_quiet();
        }
    }

    /// Nothing is pressing: notes up to where that stays so.
    pub(crate) fn note_quiet(&mut self) {
        let floor = self.wave.map_or(u64::MAX, |wave| wave.floor);
        let low = self.pending.map_or(u64::MAX, |(low, _)| low);
        self.quiet =
            self.quiet_end(floor.min(low)).min(self.stale.saturating_sub(REPLAN_HORIZON_ELEMENTS));
    }

    /// Plans for other overrides from now on: what lies next is planned anew, the rest when the motion comes near.
    pub(crate) fn rescale(&mut self, scale: OverrideScale, ring: &Ring<PathElement>, at: u64) {
        let planned = self.highest_scale();
        let forgotten = ring.first() >= self.mixed;
        self.passed = if forgotten { planned } else { self.passed.max(planned) };
        self.mixed = u64::MAX;
        self.scale = scale;
        self.replan(planned, ring, at);
    }

    /// The motion has run back, and is to go on from here: over pieces that may be planned for what is long over.
    pub(crate) fn resume_after_retrace(&mut self, ring: &Ring<PathElement>, at: u64) {
        if at < self.mixed {
            self.replan(self.highest_scale().max(self.passed), ring, at);
        }
    }

    /// From here on pieces are planned for no more than this.
    fn replan(&mut self, before: OverrideScale, ring: &Ring<PathElement>, at: u64) {
        self.before = Some(before);
        (self.eased, self.known) = (self.scale.speed_sq_factor(before), at);
        self.since = ring.end();
        (self.stale, self.span) = (at, 1);
        self.extend_replan(ring, at);
    }

    /// Whether another scale may be planned for: so much is planned for this one that it does not happen in each
    /// cycle, or nothing is left to do.
    pub(crate) fn may_rescale(&self, at: u64) -> bool {
        self.span >= REPLAN_SPAN_BEFORE_NEXT || !self.is_urgent(at)
    }

    /// Takes up pieces that are planned for another scale when the motion comes near: a few at first, so that it need
    /// not wait for many.
    pub(crate) fn refresh(&mut self, ring: &Ring<PathElement>, at: u64) {
        if !(self.stale > at.saturating_add(REPLAN_HORIZON_ELEMENTS)
            || self.span < REPLAN_SPAN_MAX && self.is_urgent(at))
        {
            self.extend_replan(ring, at);
        }
    }

    fn extend_replan(&mut self, ring: &Ring<PathElement>, at: u64) {
        self.quiet = 0;
        let newest = ring.end().saturating_sub(1);
        self.span = self.span.saturating_mul(REPLAN_SPAN_GROWTH).min(REPLAN_SPAN_MAX);
        let high = at.saturating_add(self.span).min(newest);
        let low = self.stale.min(high).max(at);
        // What a wave was still to come to is come to by the next one.
        let low = low.min(self.wave.take().map_or(low, |wave| wave.floor));
        self.pending = Some(self.pending.map_or((low, high), |(old, _)| (old.min(low), high)));
        self.stale = if high >= newest || high >= self.since { u64::MAX } else { high };
    }
}

/// The square of the speed at which a piece may be left, by its own parameter.
pub(crate) fn exit_speed_sq(ring: &Ring<PathElement>, piece: &PathElement, place: u64) -> f64 {
    ring.get(place.wrapping_add(1)).map_or(0.0, |next| next.reach / squared(piece.exit))
}

/// The square of the speed at which a piece may be entered, by that of the next one.
#[inline]
fn entry_speed_sq(piece: &PathElement, next: f64, scale: OverrideScale, limits: &Limits) -> f64 {
    max_entry_speed_sq(piece, next / squared(piece.exit), speed_sq_limits(piece, scale), limits)
}

/// Whether the axes allow the motion, as fast as it is, to keep to a path that is changed from a piece on, whatever
/// is planned for it.
#[cold]
#[inline(never)]
pub(crate) fn axes_allow(
    ring: &Ring<PathElement>,
    motion: &MotionState,
    changed: u64,
    limits: &Limits,
) -> bool {
    let Some(piece) = ring.get(motion.at) else { return true };
    // It slows down, but where a bend does not let it; so it need not be looked at where much more is allowed.
    let most = SPEED_SQ_GROWTH_MAX * squared(motion.speed) * math::max(1.0, squared(piece.exit));
    let (mut next, mut place) = (0.0, ring.end());
    while place > motion.at.saturating_add(1) {
        place = place.wrapping_sub(1);
        let Some(piece) = ring.get(place) else { break };
        next = entry_speed_sq(piece, next, UNLIMITED_SCALE, limits);
        if place < changed && next >= most {
            return true;
        }
    }
    motion.can_reach_end_at(piece, next / squared(piece.exit), limits)
}
