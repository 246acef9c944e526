//! How fast a piece may be entered so that it, and all after it, can be kept to.
//!
//! With the parameter accelerated by a constant u, the square of its speed y changes evenly along the piece, by 2u
//! per unit. On a bend each axis limits both ends of that (`strips`). All that is within limits makes a convex set
//! that holds rest, so that whatever is slower than a plan can be kept to as well: neither overrides nor holds can
//! trap the machine. (Pham and Pham, time-optimal path parameterisation by reachability.)

use crate::blend_limits;
use crate::limits::{Limits, squared};
use crate::math;
use crate::path_element::{AccelerationModel, Circle, FeedBasis, PathElement};
use crate::ring::Ring;

/// The slowest override, and turns of a spindle per second, that running back is planned for, and that the motion is
/// eased to.
pub(crate) const OVERRIDE_MIN: f64 = 0.01;

/// Where z / (1 + z/2 + z²/12) is greatest: the root of 12, or a little less.
const DECAY_EXPONENT_MAX: f64 = 3.464;

/// Overrides that look-ahead plans for, and turns of the spindle per second times that of the feed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OverrideScale {
    pub(crate) feed: f64,
    pub(crate) rapid: f64,
    pub(crate) spindle_speed: f64,
}

impl OverrideScale {
    /// What squares of speeds that are planned for another scale are multiplied by, so that they suit this one: no
    /// more than 1.
    ///
    /// What an override of zero asks for is a little more, so that the motion creeps until that is planned for.
    pub(crate) fn speed_sq_factor(self, planned: Self) -> f64 {
        let share = |asked: f64, planned: f64| math::max(OVERRIDE_MIN, asked) / planned;
        let mut ease = math::min(share(self.feed, planned.feed), share(self.rapid, planned.rapid));
        if planned.spindle_speed > 0.0 {
            ease = math::min(ease, share(self.spindle_speed, planned.spindle_speed));
        }
        squared(math::min(1.0, ease))
    }

    /// The greater of both in everything.
    pub(crate) fn max(self, other: Self) -> Self {
        Self {
            feed: math::max(self.feed, other.feed),
            rapid: math::max(self.rapid, other.rapid),
            spindle_speed: math::max(self.spindle_speed, other.spindle_speed),
        }
    }
}

/// The squares of the speeds that a piece is never run beyond where it begins and where it ends.
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

/// The highest y at a piece's start from which y at its end is at most `exit`.
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

/// The highest y at its end from which, running back, y at its start is at most `exit`.
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

/// The highest y some way before an exit, where that has a closed form.
pub(crate) fn speed_sq_before(
    model: AccelerationModel,
    circle: &Option<Circle>,
    exit: f64,
    distance: f64,
) -> f64 {
    match (model, circle) {
        (AccelerationModel::Constant { acceleration }, _) => exit + 2.0 * acceleration * distance,
        (AccelerationModel::Arc { planned, .. }, Some(circle)) => {
            // dy/dx = -2·√(planned² - (turn·y)²) gives turn·y = planned·sin(angle).
            let angle = 2.0 * circle.angle_rate * distance;
            let share = (circle.angle_rate * exit / planned).min(1.0);
            if angle >= core::f64::consts::FRAC_PI_2 {
                return planned / circle.angle_rate;
            }
            let (sine, cosine) = math::sin_cos(angle);
            let other = math::sqrt((1.0 - share * share).max(0.0));
            // Beyond the quarter turn the sine would fall again.
            if cosine <= share {
                planned / circle.angle_rate
            } else {
                planned / circle.angle_rate * (share * cosine + other * sine)
            }
        }
        (AccelerationModel::BlendedArc { at_rest: most, loss: less }, _) => {
            // dy/dx = -2·(most - less·y) gives an exponential. What stands here for 1 - e^-z is never more, and rises
            // no steeper than what is left of its way to 1.
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

/// The square of the speed at which a piece may be left, by its own parameter.
pub(crate) fn exit_speed_sq(
    elements: &Ring<PathElement>,
    element: &PathElement,
    place: u64,
) -> f64 {
    elements
        .get(place.wrapping_add(1))
        .map_or(0.0, |next| next.entry_speed_sq / squared(element.end_speed_ratio))
}
