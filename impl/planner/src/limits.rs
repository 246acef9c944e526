//! The limits of the axes as the planner uses them.

use crate::math;
use crate::parameters::{Axes, Dynamics};
use crate::vector::norm_of;

/// The shares of the limits that are used: samples are rounded, and a break of direction below
/// [`SMOOTH_BREAK_MAX_RAD`] is ignored.
const ACCELERATION_USE_RATIO: f64 = 1.0 - 1e-7;
/// The share of that which is planned with, so that the motion can return to a plan that rounding made it miss.
pub(crate) const PLANNED_RATIO: f64 = 1.0 - 1e-7;
const VELOCITY_USE_RATIO: f64 = 1.0 - 1e-9;
/// A smaller break of direction is ignored: at 1000 mm/s and 1 ms it costs 1e-4 mm/s².
pub(crate) const SMOOTH_BREAK_MAX_RAD: f64 = 1e-10;

/// Limits per axis, less what rounding needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    pub(crate) velocity: Axes,
    pub(crate) acceleration: Axes,
    /// The acceleration that plans use.
    pub(crate) planned: Axes,
    /// The least planned acceleration of all axes.
    pub(crate) softest: f64,
    /// The highest speed of X, Y and Z together.
    pub(crate) fastest: f64,
    /// The servo cycle, seconds.
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
            fastest: norm_of(&dynamics.velocity, 3),
            cycle: dynamics.cycle,
        }
    }
}

/// The least limit / use over the leading axes, of which there are at least three.
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
