//! The limits of the axes as the planner uses them.

use crate::math;
use crate::parameters::{Axes, Dynamics};

/// What is kept of each limit: a sample is rounded, and a break of direction below [`SMOOTH_BREAK_MAX_RAD`] is not seen as one.
const ACCELERATION_USE_RATIO: f64 = 1.0 - 1e-7;
/// What is planned with, of that: so that a plan that rounding has missed can be come back to.
pub(crate) const PLANNED_RATIO: f64 = 1.0 - 1e-7;
const VELOCITY_USE_RATIO: f64 = 1.0 - 1e-9;
/// A break of direction as small as this is none: at 1000 mm/s and 1 ms it costs 1e-4 mm/s².
pub(crate) const SMOOTH_BREAK_MAX_RAD: f64 = 1e-10;

/// Limits per axis, with what rounding needs taken off.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    pub(crate) velocity: Axes,
    pub(crate) acceleration: Axes,
    /// What may be used of it where all goes to plan.
    pub(crate) planned: Axes,
    /// The least of that.
    pub(crate) softest: f64,
    /// Seconds.
    pub(crate) cycle: f64,
}

impl Limits {
    pub(crate) fn new(dynamics: &Dynamics) -> Self {
        let acceleration = dynamics.acceleration.map(|limit| limit * ACCELERATION_USE_RATIO);
        let planned = acceleration.map(|limit| limit * PLANNED_RATIO);
        Self {
            velocity: dynamics.velocity.map(|limit| limit * VELOCITY_USE_RATIO),
            acceleration,
            planned,
            softest: planned.into_iter().fold(f64::INFINITY, math::min),
            cycle: dynamics.cycle,
        }
    }
}

/// The least of limit / use over the leading axes, of which there are three or more.
#[inline]
pub(crate) fn least(limits: &Axes, uses: &Axes, axes: usize) -> f64 {
    if axes <= 3 { least_of::<3>(limits, uses) } else { least_of::<9>(limits, uses) }
}

#[inline]
fn least_of<const N: usize>(limits: &Axes, uses: &Axes) -> f64 {
    let mut shares = [0.0; N];
    for (share, (limit, used)) in shares.iter_mut().zip(limits.iter().zip(uses)) {
        *share = limit / used.abs();
    }
    shares.into_iter().fold(f64::INFINITY, math::min)
}

pub(crate) fn squared(value: f64) -> f64 {
    value * value
}
