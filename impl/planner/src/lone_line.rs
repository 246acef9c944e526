//! A line between two rests whose motion is smoothed by an average over a window of the time T.
//!
//! On it the jerk is (a(t) - a(t - T)) / T. Where accelerations whose times differ by less than T never have opposite
//! signs, that is at most a / T, so a window of a / jerk is enough: half of what other motions need. A line from rest
//! to rest then takes the least time that velocity, acceleration and jerk allow, except for whole cycles.
//!
//! So the motion coasts for the time of a window between speeding up and slowing down. It speeds up only if the line
//! is long enough to coast and to stop afterwards; this is why it can come to rest at any time.

use crate::limits::squared;
use crate::math;
use crate::motion::{CycleRequest, ElementEnd, MotionState, target_speed};
use crate::path_element::{AccelerationModel, PathElement};

/// A lesser rise of the speed, relative to the speed, is rounding.
const RISE_RATIO_MIN: f64 = 1e-9;
/// A lesser rest of a line, relative to its length, is rounding.
const LENGTH_ROUNDING: f64 = 64.0 * f64::EPSILON;
/// The share of the line that is used.
const LENGTH_USE_RATIO: f64 = 1.0 - 1e-9;

impl MotionState {
    /// Moves along a lone line while there is time. Returns the time used.
    #[inline(never)]
    pub(crate) fn advance_on_lone_line(
        &mut self,
        element: &PathElement,
        end: ElementEnd,
        (cycle, request): (f64, &CycleRequest),
        time_left: f64,
    ) -> f64 {
        let AccelerationModel::Constant { acceleration: most } = element.model else { return 0.0 };
        let rounding = LENGTH_ROUNDING * element.length;
        if end.remaining <= rounding && self.speed * cycle <= end.remaining {
            // The position cannot express how this is covered.
            self.x = if self.is_reversed { 0.0 } else { element.length };
            self.speed = 0.0;
            self.sign_changes.note(0.0);
            return time_left;
        }
        let window = self.smoothing.window;
        let coast = f64::from(window) * cycle;
        let (not_risen, not_fallen) = self.sign_changes.in_direction(self.is_reversed);
        let target = if request.must_stop {
            f64::NEG_INFINITY
        } else {
            target_speed(element, element.speed_limit, request)
        };
        let mut high = 0.0;
        if not_fallen >= window && target > self.speed {
            let reached = self.speed_before_coasting(most, end.remaining, coast, time_left);
            let rise = math::min(target, reached) - self.speed;
            if rise > RISE_RATIO_MIN * self.speed {
                high = math::min(most, rise / time_left);
            }
        }
        let acceleration = if high > 0.0 || not_risen < window || self.speed <= 0.0 {
            high
        } else {
            self.braking(most, end.remaining, target, time_left)
        };
        self.sign_changes.note(if self.is_reversed { -acceleration } else { acceleration });
        self.accelerate(element, acceleration, end, time_left)
    }

    /// The speed at the end of the cycle from which the motion can coast for a window and then stop.
    fn speed_before_coasting(&self, most: f64, remaining: f64, coast: f64, time_left: f64) -> f64 {
        // v²/(2·a) + v·(T + t/2) + speed·t/2 = remaining, where t is left of the cycle.
        let coast = coast + 0.5 * time_left;
        let left = LENGTH_USE_RATIO * remaining - 0.5 * self.speed * time_left;
        if left <= 0.0 {
            return 0.0;
        }
        most * (math::sqrt(squared(coast) + 2.0 * left / most) - coast)
    }

    /// The acceleration that slows down towards a speed, or as far as the end of the line requires it; at most 0.
    fn braking(&self, most: f64, remaining: f64, target: f64, cycle: f64) -> f64 {
        let towards = math::max(-most, (target - self.speed) / cycle);
        // Whether coasting for the cycle leaves enough.
        let left = remaining - self.speed * cycle;
        let needed = if left > 0.0 && squared(self.speed) <= 2.0 * most * left {
            0.0
        } else {
            // With an acceleration u in the cycle: (v + u·h)²/(2·a) + (v + u·h/2)·h = remaining.
            let half = 0.5 * most * cycle;
            let square = squared(half) + 2.0 * most * (remaining - 0.5 * self.speed * cycle);
            let after = if square > 0.0 { math::sqrt(square) - half } else { 0.0 };
            if after > 0.0 {
                (after - self.speed) / cycle
            } else {
                -0.5 * squared(self.speed) / remaining
            }
        };
        math::min(0.0, math::min(towards, needed))
    }
}
