//! How fast an element may be entered so that it and all elements after it can be executed within the limits.
//!
//! With a constant acceleration u of the parameter, its squared speed y changes linearly along the element, by 2u per
//! unit. On a blend each axis limits both ends of that (`blend_limits`). All that is within the limits is a convex set
//! that contains rest. So whatever is slower than a plan is feasible as well, and neither overrides nor holds can trap
//! the motion. (Pham and Pham, time-optimal path parameterisation by reachability analysis.)

use crate::blend_limits;
use crate::limits::{Limits, squared};
use crate::math;
use crate::path_element::{AccelerationModel, Circle, FeedBasis, PathElement};
use crate::ring::Ring;

/// The lowest override, and the lowest spindle speed in revolutions per second, for which speeds are planned.
pub(crate) const OVERRIDE_MIN: f64 = 0.01;

/// The argument z at which z / (1 + z/2 + z²/12) is greatest, √12, rounded down.
const DECAY_EXPONENT_MAX: f64 = 3.464;

/// The overrides that look-ahead plans for, and the spindle speed in revolutions per second, times the feed override.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OverrideScale {
    pub(crate) feed: f64,
    pub(crate) rapid: f64,
    pub(crate) spindle_speed: f64,
}

impl OverrideScale {
    /// The factor, at most 1, for squared speeds that were planned for another scale, so that they suit this one.
    ///
    /// For an override of 0 it is a little more than 0, so that the motion creeps until the plan is ready.
    pub(crate) fn speed_sq_factor(self, planned: Self) -> f64 {
        let share = |requested: f64, planned: f64| math::max(OVERRIDE_MIN, requested) / planned;
        let mut factor =
            math::min(share(self.feed, planned.feed), share(self.rapid, planned.rapid));
        if planned.spindle_speed > 0.0 {
            factor = math::min(factor, share(self.spindle_speed, planned.spindle_speed));
        }
        squared(math::min(1.0, factor))
    }

    /// The greater of both in each field.
    pub(crate) fn max(self, other: Self) -> Self {
        Self {
            feed: math::max(self.feed, other.feed),
            rapid: math::max(self.rapid, other.rapid),
            spindle_speed: math::max(self.spindle_speed, other.spindle_speed),
        }
    }
}

/// The squared speeds that the request never exceeds at the start and at the end of an element.
#[inline]
pub(crate) fn speed_sq_limits(element: &PathElement, scale: OverrideScale) -> (f64, f64) {
    let (start, end) = if element.is_partly_rapid || element.feed_basis == FeedBasis::Rapid {
        rapid_speed_sq_limits(element, scale)
    } else {
        (element.start_limit_sq, element.end_limit_sq)
    };
    let feed = match element.feed_basis {
        FeedBasis::Rapid => return (start, end),
        FeedBasis::PerSecond => element.feed * scale.feed,
        FeedBasis::PerTurn => element.feed * scale.spindle_speed,
    };
    let feed = feed * feed;
    (math::min(start, feed), math::min(end, feed))
}

#[cold]
#[inline(never)]
fn rapid_speed_sq_limits(element: &PathElement, scale: OverrideScale) -> (f64, f64) {
    let share = scale.rapid * scale.rapid;
    (element.start_limit_sq * share, element.end_limit_sq * share)
}

/// The highest squared speed at the start of an element from which the one at its end is at most `exit`.
pub(crate) fn max_entry_speed_sq(
    element: &PathElement,
    exit: f64,
    (cap, last_cap): (f64, f64),
    limits: &Limits,
) -> f64 {
    let exit = math::min(exit, last_cap);
    let entry = match element.model {
        AccelerationModel::Blend { .. } => {
            blend_limits::max_entry_speed_sq(element, true, (exit, cap), limits)
        }
        AccelerationModel::Constant { .. }
        | AccelerationModel::Arc { .. }
        | AccelerationModel::BlendedArc { .. }
        | AccelerationModel::Dwell(_) => {
            speed_sq_before(element.model, &element.circle, exit, element.length)
        }
    };
    math::min(math::min(entry, cap), element.junction_limit_sq)
}

/// The highest squared speed at the end of an element from which, in reverse, the one at its start is at most `exit`.
pub(crate) fn max_reverse_entry_speed_sq(
    element: &PathElement,
    exit: f64,
    (first_cap, cap): (f64, f64),
    limits: &Limits,
) -> f64 {
    let exit = math::min(exit, first_cap);
    let entry = match element.model {
        AccelerationModel::Blend { .. } => {
            blend_limits::max_entry_speed_sq(element, false, (exit, cap), limits)
        }
        AccelerationModel::Constant { .. }
        | AccelerationModel::Arc { .. }
        | AccelerationModel::BlendedArc { .. }
        | AccelerationModel::Dwell(_) => {
            speed_sq_before(element.model, &element.circle, exit, element.length)
        }
    };
    math::min(entry, cap)
}

/// The highest squared speed at a distance before an exit, where a closed form exists.
pub(crate) fn speed_sq_before(
    model: AccelerationModel,
    circle: &Option<Circle>,
    exit: f64,
    distance: f64,
) -> f64 {
    match (model, circle) {
        (AccelerationModel::Constant { acceleration }, _) => exit + 2.0 * acceleration * distance,
        (AccelerationModel::Arc { planned, .. }, Some(circle)) => {
            // dy/dx = -2·√(planned² - (κ·y)²) gives κ·y = planned·sin(angle).
            let angle = 2.0 * circle.angle_rate * distance;
            let share = (circle.angle_rate * exit / planned).min(1.0);
            if angle >= core::f64::consts::FRAC_PI_2 {
                return planned / circle.angle_rate;
            }
            let (sine, cosine) = math::sin_cos(angle);
            let other = math::sqrt((1.0 - share * share).max(0.0));
            // Beyond a quarter turn the sine would fall again.
            if cosine <= share {
                planned / circle.angle_rate
            } else {
                planned / circle.angle_rate * (share * cosine + other * sine)
            }
        }
        (AccelerationModel::BlendedArc { at_rest: most, loss: less }, _) => {
            // dy/dx = -2·(at_rest - loss·y) gives an exponential. The rational term in place of 1 - e^-z is never
            // greater, and rises no more steeply than its distance to 1.
            let far = math::min(2.0 * less * distance, DECAY_EXPONENT_MAX);
            let way =
                if far < DECAY_EXPONENT_MAX { distance } else { DECAY_EXPONENT_MAX / (2.0 * less) };
            let share = 1.0 / (1.0 + far * (0.5 + far * (1.0 / 12.0)));
            exit + 2.0 * (most - less * exit) * way * share
        }
        (
            AccelerationModel::Dwell(_)
            | AccelerationModel::Arc { .. }
            | AccelerationModel::Blend { .. },
            _,
        ) => 0.0,
    }
}

/// The square of the speed, by an element's own parameter, at which it may be left.
pub(crate) fn exit_speed_sq(
    elements: &Ring<PathElement>,
    element: &PathElement,
    place: u64,
) -> f64 {
    elements
        .get(place.wrapping_add(1))
        .map_or(0.0, |next| next.entry_speed_sq / squared(element.end_speed_ratio))
}
