//! The state of the motion, and the effect of one constant acceleration on it.
//!
//! Within an element and a cycle the acceleration of the parameter is constant. So the speed has no jumps, and each
//! axis keeps its limits at every instant. Differences of samples are means of such accelerations, whatever their
//! period.

use crate::entry_speed::speed_sq_before;
use crate::limits::squared;
use crate::math;
use crate::path_element::{AccelerationModel, FeedBasis, PathElement, Smoothing};
use crate::sign_changes::SignChanges;

/// An axis with a smaller share of the direction is ignored.
pub(crate) const AXIS_SHARE_MIN: f64 = 1e-9;
/// By this factor rounding may shorten the rest of an element for a motion that must stop at its end.
const REMAINING_ROUNDING_RATIO: f64 = 1.0 + 1e-6;
/// The most elements in a cycle. Elements are made so that fewer fit into one.
pub(crate) const ELEMENTS_PER_CYCLE_MAX: u32 = 12;
/// The cost of a part of a cycle on a blend, in units of [`MotionState::work`].
pub(crate) const BLEND_WORK: u32 = 2;
/// When a cycle has cost this much, expensive steps are omitted or postponed to the next cycle.
pub(crate) const CYCLE_WORK_MAX: u32 = 5;
/// A blend is long if it lasts for more cycles than this at the present speed. Then an acceleration above the
/// sustainable one is searched for.
pub(crate) const LONG_BLEND_CYCLES_MIN: f64 = 2.0;

/// What a cycle is requested to do.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CycleRequest {
    /// Factor of the programmed feed.
    pub(crate) feed: f64,
    /// Factor of the rapid speed.
    pub(crate) rapid: f64,
    /// Revolutions of the spindle per second, times the feed override.
    pub(crate) spindle_speed: f64,
    /// Whether the motion must come to rest.
    pub(crate) must_stop: bool,
    /// Whether look-ahead has planned for exactly these overrides.
    pub(crate) is_planned: bool,
    /// Factor for squared speeds of look-ahead where it has planned for more than is requested.
    pub(crate) speed_sq_factor: f64,
}

/// Where the motion is, and how it moves.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MotionState {
    /// The number of the element.
    pub(crate) at: u64,
    /// The parameter within the element.
    pub(crate) x: f64,
    /// Speed of the parameter, at least 0.
    pub(crate) speed: f64,
    /// Acceleration of the parameter in the last part of the cycle, in the direction of motion.
    pub(crate) acceleration: f64,
    /// Whether the motion runs backwards along the path.
    pub(crate) is_reversed: bool,
    /// The element to whose start it may run backwards.
    pub(crate) reverse_end: u64,
    /// Elapsed seconds of a dwell.
    pub(crate) dwell_elapsed: f64,
    /// The segment under way: the planner's number and the caller's.
    pub(crate) begun: u64,
    pub(crate) number: u64,
    /// The cost of this cycle: 1 per part on a line, 2 on a blend, 3 on an arc; on the fast path 1 per element passed.
    pub(crate) work: u32,
    /// Whether the strongest braking on an arc has been computed in this cycle.
    pub(crate) found_braking: bool,
    /// Seconds by which the stop at the end of the last cycle was early.
    pub(crate) time_owed: f64,
    /// Whether the smoothed motion rests, too, and how the motion from there is smoothed.
    pub(crate) is_settled: bool,
    /// Whether it does so since the last cycle.
    pub(crate) has_just_settled: bool,
    /// The speed with which this cycle began, and whether it is above 0 and the motion has not come to rest.
    pub(crate) speed_before: f64,
    pub(crate) has_moved: bool,
    /// What was left of the cycle in which the motion came to rest. It goes on in the same part of a cycle, so that its
    /// accelerations are a whole window apart.
    pub(crate) rest_time_left: f64,
    pub(crate) smoothing: Smoothing,
    /// Whether each part of this cycle is looked at in full.
    pub(crate) avoids_fast_path: bool,
    /// Whether it is on a line between two rests on which its acceleration changes its sign only after a while, and
    /// since when it has had each sign.
    pub(crate) is_on_lone_line: bool,
    pub(crate) sign_changes: SignChanges,
}

/// The end of an element in the direction of motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementEnd {
    /// Square of the speed at which the element may be left there.
    pub(crate) speed_sq: f64,
    /// Distance to it.
    pub(crate) remaining: f64,
    /// Whether the path goes on there without a stop, so that only an override can cause one.
    pub(crate) is_open: bool,
}

impl MotionState {
    /// The rest of the element in the direction of motion.
    pub(crate) fn remaining(&self, element: &PathElement) -> f64 {
        if self.is_reversed { self.x } else { element.length - self.x }
    }

    /// Whether the smoothed motion rests and is set for an element, so that the motion may enter it in the time that is
    /// left.
    #[inline(never)]
    pub(crate) fn may_enter(&mut self, element: &PathElement, time_left: &mut f64) -> bool {
        let is_dwell = matches!(element.model, AccelerationModel::Dwell(_));
        if self.is_settled && (is_dwell || element.smoothing == self.smoothing) {
            if self.has_just_settled {
                *time_left = math::min(*time_left, self.rest_time_left);
                self.has_just_settled = false;
            }
            return *time_left > 0.0;
        }
        self.speed = 0.0;
        if core::mem::take(&mut self.has_moved) {
            self.rest_time_left = *time_left;
        }
        false
    }

    /// Moves to the next element.
    #[inline]
    pub(crate) fn enter(&mut self, before: &PathElement) {
        self.at = self.at.wrapping_add(1);
        self.speed *= before.end_speed_ratio;
        self.x = 0.0;
        self.dwell_elapsed = 0.0;
    }

    /// Records the start of a segment if the motion has moved: a motion that is held at the start has not begun it.
    pub(crate) fn note_begin(&mut self, element: &PathElement, from: f64) {
        if self.x > from {
            self.begin_segment(element, from);
        }
    }

    /// Records the start of a segment if it was passed.
    #[inline]
    pub(crate) fn begin_segment(&mut self, element: &PathElement, from: f64) {
        if element.segment_start.is_some_and(|begins| from <= begins && begins <= self.x) {
            self.begun = self.begun.max(element.index);
            self.number = element.number;
        }
    }

    /// The square of the speed at which an element is left. An override may require a stop at its end too late: then
    /// the motion leaves it at a tiny speed.
    #[inline]
    pub(crate) fn exit_after_late_override(
        &self,
        element: &PathElement,
        end: ElementEnd,
        late: impl Fn(f64) -> bool,
    ) -> f64 {
        let far = end.remaining * REMAINING_ROUNDING_RATIO + 8.0 * f64::EPSILON * element.length;
        if end.is_open && end.speed_sq <= 0.0 && late(far) {
            f64::MIN_POSITIVE
        } else {
            end.speed_sq
        }
    }

    /// Accelerates constantly until the time is over, the element ends, or the motion stops. Returns the time used.
    #[inline(always)]
    pub(crate) fn accelerate(
        &mut self,
        element: &PathElement,
        acceleration: f64,
        ahead: ElementEnd,
        time_left: f64,
    ) -> f64 {
        let remaining = ahead.remaining;
        self.acceleration = acceleration;
        let end = self.speed + acceleration * time_left;
        let travel = 0.5 * (self.speed + end) * time_left;
        if end > 0.0 && travel < remaining {
            self.move_by(travel);
            self.speed = end;
            // Rounding may still bring it to the end.
            if ahead.speed_sq <= 0.0 && self.remaining(element) <= 0.0 {
                self.stop_at_end(end, time_left);
            }
            return time_left;
        }
        let y = squared(self.speed);
        let exit = self.exit_after_late_override(element, ahead, |far| {
            y > speed_sq_before(element.model, &element.circle, 0.0, far)
        });
        let (mut last, mut brakes) = (y + 2.0 * acceleration * remaining, 0.0);
        if exit <= 0.0 && last >= -1e-6 * y {
            // The squared end speed is the difference of two numbers that should be equal. Braking a little harder
            // leaves less of it than stopping abruptly.
            last = 0.0;
            // The rest of a long element is rounded, and so is the time for it. The braking time is not.
            if acceleration < 0.0 {
                brakes = -self.speed / acceleration;
            }
        }
        if last >= 0.0 {
            let end = math::sqrt(last);
            let both = self.speed + end;
            let time = if remaining > 0.0 { 2.0 * remaining / both } else { 0.0 };
            let time = math::max(time, brakes);
            if time <= time_left {
                self.x = if self.is_reversed { 0.0 } else { element.length };
                self.speed = if exit > 0.0 { end } else { 0.0 };
                return time;
            }
        } else if end <= 0.0 {
            let travel = -0.5 * y / acceleration;
            self.move_by(math::min(travel, remaining));
            self.speed = 0.0;
            return time_left;
        }
        self.move_by(math::min(travel, remaining));
        self.speed = math::max(0.0, end);
        if exit <= 0.0 && travel >= remaining {
            self.stop_at_end(end, time_left);
        }
        time_left
    }

    /// Stops at the end of an element at the end of a cycle, where rounding leaves some speed. The position cannot
    /// show the remaining way, but an axis that reverses needs the time.
    #[cold]
    pub(crate) fn stop_at_end(&mut self, end: f64, time_left: f64) {
        let takes = -end / self.acceleration;
        self.time_owed = math::min(math::max(0.0, takes), time_left);
        self.speed = 0.0;
    }

    pub(crate) fn move_by(&mut self, distance: f64) {
        self.x += if self.is_reversed { -distance } else { distance };
    }
}

/// The requested speed on an element whose axes allow `fastest`.
pub(crate) fn target_speed(element: &PathElement, fastest: f64, request: &CycleRequest) -> f64 {
    let axes = if element.is_partly_rapid { fastest * request.rapid } else { fastest };
    match element.feed_basis {
        FeedBasis::Rapid => fastest * request.rapid,
        FeedBasis::PerSecond => math::min(axes, element.feed * request.feed),
        FeedBasis::PerTurn => math::min(axes, element.feed * request.spindle_speed),
    }
}
