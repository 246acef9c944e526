//! The state of the motion, and what one constant acceleration does to it.
//!
//! Within an element and a cycle the acceleration of the parameter is constant. So the speed has no jumps, and each axis
//! keeps its limits at every instant. Differences of samples are means of such accelerations, whatever their period.

use crate::entry_speed::speed_sq_before;
use crate::limits::squared;
use crate::math;
use crate::path_element::{FeedBasis, PathElement};

/// The share of an axis in a direction below which it takes no part.
pub(crate) const AXIS_SHARE_MIN: f64 = 1e-9;
/// By so much what is left of a piece may be too short by rounding for a motion that is to come to rest at its end.
const REMAINING_ROUNDING_RATIO: f64 = 1.0 + 1e-6;
/// The most pieces that are touched in a cycle; pieces are made so that fewer fit into one.
pub(crate) const ELEMENTS_PER_CYCLE_MAX: u32 = 12;
/// What a part of a cycle on a bend is worth of [`MotionState::effort`].
pub(crate) const BLEND_WORK: u32 = 2;
/// What costs much in a cycle is left out, or to the next one, where this much has been done.
pub(crate) const CYCLE_WORK_MAX: u32 = 5;
/// For how many cycles a bend must still last at the present speed where another acceleration is looked for than one
/// that can be kept up to its end.
pub(crate) const LONG_BLEND_CYCLES_MIN: f64 = 2.0;

/// What is asked for in a cycle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CycleRequest {
    /// Share of the programmed feed.
    pub(crate) feed: f64,
    /// Share of the rapid speed.
    pub(crate) rapid: f64,
    /// Turns of the spindle per second, times the share of the programmed feed.
    pub(crate) spindle_speed: f64,
    /// Whether to come to rest.
    pub(crate) must_stop: bool,
    /// Whether look-ahead has planned for just these shares.
    pub(crate) is_planned: bool,
    /// What speeds of look-ahead are multiplied by, squared, where it has planned for more than is asked for.
    pub(crate) speed_sq_factor: f64,
}

/// Where the motion is.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MotionState {
    /// The piece.
    pub(crate) at: u64,
    /// Its parameter.
    pub(crate) x: f64,
    /// Speed of the parameter, never negative.
    pub(crate) speed: f64,
    /// Its acceleration in the last part of the cycle, along the direction of motion.
    pub(crate) acceleration: f64,
    /// Whether it runs back.
    pub(crate) is_reversed: bool,
    /// The piece to whose beginning it may run back.
    pub(crate) reverse_end: u64,
    /// Seconds of a dwell that are over.
    pub(crate) dwell_elapsed: f64,
    /// The segment under way: planner's number and caller's.
    pub(crate) begun: u64,
    pub(crate) number: u64,
    /// How much work this cycle has been, in parts of it on a line; one on a bend counts as two, one on an arc as
    /// three, and where all is easy each piece that is passed as one.
    pub(crate) work: u32,
    /// Whether the least acceleration on an arc has been found in it.
    pub(crate) found_braking: bool,
    /// Seconds that the rest at the end of the cycle before begins late.
    pub(crate) time_owed: f64,
}

/// The end of a piece in the direction of motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementEnd {
    /// Square of the speed at which the piece may be left there.
    pub(crate) speed_sq: f64,
    /// How far it is.
    pub(crate) remaining: f64,
    /// Whether the path goes on without rest there, so that only an override can ask for one.
    pub(crate) is_open: bool,
}

impl MotionState {
    /// What is left of the piece in the direction of motion.
    pub(crate) fn remaining(&self, element: &PathElement) -> f64 {
        if self.is_reversed { self.x } else { element.length - self.x }
    }

    /// Goes over to the piece after this one.
    #[inline]
    pub(crate) fn enter(&mut self, before: &PathElement) {
        self.at = self.at.wrapping_add(1);
        self.speed *= before.end_speed_ratio;
        self.x = 0.0;
        self.dwell_elapsed = 0.0;
    }

    /// Who is held at the start of a segment has not begun it.
    pub(crate) fn note_begin(&mut self, element: &PathElement, from: f64) {
        if self.x > from {
            self.begin_segment(element, from);
        }
    }

    /// A segment has begun if its start was passed.
    #[inline]
    pub(crate) fn begin_segment(&mut self, element: &PathElement, from: f64) {
        if element.segment_start.is_some_and(|begins| from <= begins && begins <= self.x) {
            self.begun = self.begun.max(element.index);
            self.number = element.number;
        }
    }

    /// The square of the speed at which a piece is left where an override asks for rest at its end when the motion
    /// can no more come to it, since `late`.
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

    /// Accelerates evenly until the time is over, the piece ends, or the motion rests.
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
            // Rounding may bring it to the end all the same.
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
            // The square of the last speed is the difference of two numbers that should be equal. Less is left of it
            // by braking a little harder than by resting all of a sudden.
            last = 0.0;
            // What is left of a long piece is rounded, and so how long that takes; how long the brakes take is not.
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

    /// Comes to rest at the end of a piece with the end of a cycle, where rounding leaves a speed of it. What that
    /// would still take is less than the place can show, but an axis that turns round needs the time.
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

/// The speed that a piece is asked to have where its axes allow so much.
pub(crate) fn target_speed(element: &PathElement, fastest: f64, request: &CycleRequest) -> f64 {
    let axes = if element.is_partly_rapid { fastest * request.rapid } else { fastest };
    match element.feed_basis {
        FeedBasis::Rapid => fastest * request.rapid,
        FeedBasis::PerSecond => math::min(axes, element.feed * request.feed),
        FeedBasis::PerTurn => math::min(axes, element.feed * request.spindle_speed),
    }
}
