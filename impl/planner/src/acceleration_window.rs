//! The accelerations that an element other than a blend allows in a cycle, and which of them leads to a speed.

use crate::entry_speed::speed_sq_before;
use crate::limits::{PLANNED_RATIO, squared};
use crate::math;
use crate::motion::{ElementEnd, MotionState};
use crate::path_element::{AccelerationModel, Circle, PathElement};

/// The range of accelerations, and the squared speed that look-ahead allows here: `speed_sq`, which changes by
/// `speed_sq_slope` per unit of the parameter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AccelerationWindow {
    pub(crate) min: f64,
    pub(crate) max: f64,
    pub(crate) speed_sq: f64,
    pub(crate) speed_sq_slope: f64,
}

impl MotionState {
    /// The acceleration within a window that brings the motion towards a speed.
    #[inline]
    pub(crate) fn acceleration_towards(
        &self,
        window: &AccelerationWindow,
        target: f64,
        ElementEnd { speed_sq: exit, remaining, .. }: ElementEnd,
        (speed_sq_factor, time_left): (f64, f64),
    ) -> f64 {
        // The speed at the end of the cycle that just meets the bound of look-ahead.
        let half = 0.5 * window.speed_sq_slope * time_left;
        let met = half * half + 4.0 * (window.speed_sq + half * self.speed);
        let met = if met > 0.0 { 0.5 * (half + math::sqrt(met)) } else { 0.0 };
        let acceleration = clamped((math::min(target, met) - self.speed) / time_left, window);
        let travel = (self.speed + 0.5 * acceleration * time_left) * time_left;
        if met > 0.0 && travel < remaining {
            return acceleration;
        }
        if self.speed <= 0.0 && exit <= 0.0 {
            // The way from rest to rest is so short that rounding hides how it is covered: cover it within the cycle.
            return clamped(2.0 * remaining / squared(time_left), window);
        }
        // The element ends within the cycle.
        let y = squared(self.speed);
        let mut most = (speed_sq_factor * exit - y) / (2.0 * remaining);
        if self.speed > target {
            most = math::min(most, (target - self.speed) / time_left);
        } else {
            most = math::min(most, (squared(target) - y) / (2.0 * remaining));
        }
        clamped(most, window)
    }

    /// The strongest braking (least acceleration) that the model of an element other than a blend allows.
    #[inline]
    pub(crate) fn strongest_model_braking(&self, element: &PathElement, cycle: f64) -> f64 {
        match (element.model, &element.circle) {
            (AccelerationModel::Arc { acceleration, .. }, Some(circle)) => {
                -tangential_acceleration_left(acceleration, circle, squared(self.speed))
            }
            (AccelerationModel::BlendedArc { at_rest: most, loss: less }, _) => {
                -math::max(0.0, most - less * squared(self.speed))
                    * unplanned_ratio(element, less, cycle)
            }
            (AccelerationModel::Constant { acceleration }, _) => -acceleration / PLANNED_RATIO,
            (
                AccelerationModel::Arc { .. }
                | AccelerationModel::Blend { .. }
                | AccelerationModel::Dwell(_),
                _,
            ) => 0.0,
        }
    }

    pub(crate) fn window(
        &self,
        element: &PathElement,
        end: ElementEnd,
        speed_sq_factor: f64,
        (time_left, cycle): (f64, f64),
        lowest: f64,
    ) -> AccelerationWindow {
        match (element.model, &element.circle) {
            (AccelerationModel::Arc { acceleration, .. }, Some(circle)) => {
                let rest = |y: f64| tangential_acceleration_left(acceleration, circle, y);
                self.window_on_arc(element, end, (speed_sq_factor, time_left), lowest, rest)
            }
            (AccelerationModel::BlendedArc { at_rest: most, loss: less }, _) => {
                let all = unplanned_ratio(element, less, cycle);
                let rest = |y: f64| math::max(0.0, most - less * y) * all;
                self.window_on_arc(element, end, (speed_sq_factor, time_left), lowest, rest)
            }
            (AccelerationModel::Constant { acceleration }, _) => {
                constant_window(acceleration, end, speed_sq_factor)
            }
            (
                AccelerationModel::Arc { .. }
                | AccelerationModel::Blend { .. }
                | AccelerationModel::Dwell(_),
                _,
            ) => AccelerationWindow { min: 0.0, max: 0.0, speed_sq: 0.0, speed_sq_slope: 0.0 },
        }
    }

    /// The window where the available acceleration falls as the squared speed rises.
    pub(crate) fn window_on_arc(
        &self,
        element: &PathElement,
        ElementEnd { speed_sq: exit, remaining, .. }: ElementEnd,
        (speed_sq_factor, time_left): (f64, f64),
        lowest: f64,
        rest: impl Fn(f64) -> f64,
    ) -> AccelerationWindow {
        let (y, most) = (squared(self.speed), -lowest);
        let far = math::min((self.speed + 0.5 * most * time_left) * time_left, remaining);
        let high = rest(math::min(y + 2.0 * most * far, element.start_limit_sq));
        let bound =
            speed_sq_factor * speed_sq_before(element.model, &element.circle, exit, remaining);
        let later = speed_sq_factor
            * speed_sq_before(element.model, &element.circle, exit, remaining - far);
        let slope = if far > 0.0 { (later - bound) / far } else { 0.0 };
        AccelerationWindow { min: lowest, max: high, speed_sq: bound, speed_sq_slope: slope }
    }
}

/// The window of an element with a constant acceleration limit.
#[inline]
pub(crate) fn constant_window(
    acceleration: f64,
    end: ElementEnd,
    speed_sq_factor: f64,
) -> AccelerationWindow {
    let slope = -2.0 * acceleration * speed_sq_factor;
    let bound = speed_sq_factor * end.speed_sq - slope * end.remaining;
    AccelerationWindow {
        min: -acceleration / PLANNED_RATIO,
        max: acceleration,
        speed_sq: bound,
        speed_sq_slope: slope,
    }
}

/// The acceleration along an arc that is left when the centripetal acceleration at a squared speed is taken off.
#[inline]
fn tangential_acceleration_left(acceleration: f64, circle: &Circle, y: f64) -> f64 {
    math::sqrt((squared(acceleration) - squared(circle.angle_rate * y)).max(0.0))
}

/// The ratio of the acceleration that the axes allow on a blended arc to the planned one.
#[inline]
fn unplanned_ratio(element: &PathElement, less: f64, cycle: f64) -> f64 {
    1.0 / (PLANNED_RATIO - less * element.speed_limit * cycle)
}

fn clamped(acceleration: f64, window: &AccelerationWindow) -> f64 {
    math::max(math::min(acceleration, window.max), window.min)
}
