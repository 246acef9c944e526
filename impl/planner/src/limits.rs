//! The limits of the axes as the planner uses them.

use alloc::boxed::Box;
use alloc::vec::Vec;

use crate::math;
use crate::parameters::{Axes, Dynamics};
use crate::path_element::{PathElement, Smoothing};
use crate::vector::norm_of;

/// The shares of the limits that are used: samples are rounded, and a break of direction below
/// [`SMOOTH_BREAK_MAX_RAD`] is ignored.
const ACCELERATION_USE_RATIO: f64 = 1.0 - 1e-7;
/// The share of that which is planned with, so that the motion can return to a plan that rounding made it miss.
pub(crate) const PLANNED_RATIO: f64 = 1.0 - 1e-7;
const VELOCITY_USE_RATIO: f64 = 1.0 - 1e-9;
/// The share of the limits of jerk that is used: a moving average divides what rounding adds to accelerations by few
/// cycles.
const JERK_USE_RATIO: f64 = 1.0 - 1e-5;
/// The most limits of smoothed motion that are kept.
const SMOOTHED_LIMITS_MAX: u16 = 512;
/// A smaller break of direction is ignored: at 1000 mm/s and 1 ms it costs 1e-4 mm/s².
pub(crate) const SMOOTH_BREAK_MAX_RAD: f64 = 1e-10;

/// Limits per axis, less what rounding needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    pub(crate) velocity: Axes,
    pub(crate) acceleration: Axes,
    /// The acceleration that plans use.
    pub(crate) planned: Axes,
    /// The acceleration without smoothing.
    pub(crate) unsmoothed: Axes,
    /// The least planned acceleration of all axes.
    pub(crate) softest: f64,
    /// The highest speed of X, Y and Z together.
    pub(crate) fastest: f64,
    /// The servo cycle, seconds.
    pub(crate) cycle: f64,
    /// Infinite without limits of jerk.
    pub(crate) jerk: Axes,
    /// How motion with these limits is smoothed.
    pub(crate) smoothing: Smoothing,
    /// Whether smoothed motion rests at each corner that is not smooth.
    pub(crate) rests_at_corners: bool,
}

impl Limits {
    pub(crate) fn new(dynamics: &Dynamics) -> Self {
        let acceleration = dynamics.acceleration.map(|limit| limit * ACCELERATION_USE_RATIO);
        let planned = acceleration.map(|limit| limit * PLANNED_RATIO);
        Self {
            velocity: dynamics.velocity.map(|limit| limit * VELOCITY_USE_RATIO),
            acceleration,
            planned,
            unsmoothed: acceleration,
            softest: planned.into_iter().fold(f64::INFINITY, math::min),
            fastest: norm_of(&dynamics.velocity, 3),
            cycle: dynamics.cycle,
            jerk: [f64::INFINITY; 9],
            smoothing: Smoothing::default(),
            rests_at_corners: false,
        }
    }

    /// The limits of a motion that a moving average over a number of cycles smooths. Averaging divides a change of the
    /// acceleration by the time that it covers. Such a change is at most twice the limit of the acceleration.
    fn smoothed(dynamics: &Dynamics, jerk: &Axes, cycles: u16) -> Self {
        let seconds = f64::from(cycles) * dynamics.cycle;
        let jerk = jerk.map(|limit| limit * JERK_USE_RATIO);
        let mut slower = *dynamics;
        for (limit, jerk) in slower.acceleration.iter_mut().zip(&jerk) {
            *limit = math::min(*limit, 0.5 * jerk * seconds);
        }
        let smoothing = Smoothing { window: cycles, limits: cycles, ..Smoothing::default() };
        let unsmoothed = dynamics.acceleration.map(|limit| limit * ACCELERATION_USE_RATIO);
        Self { jerk, smoothing, unsmoothed, ..Self::new(&slower) }
    }
}

/// The limits of all motions: those of the machine, and those of motions that are smoothed.
#[derive(Debug)]
pub(crate) struct LimitTable {
    plain: Limits,
    /// By the number of cycles that a moving average covers, from 1: up to where all of the acceleration is used.
    smoothed: Box<[Limits]>,
}

impl LimitTable {
    /// Allocates what limits of jerk need. Where they allow any change of the acceleration in a cycle, that is nothing.
    pub(crate) fn new(dynamics: &Dynamics) -> Self {
        let plain = Limits::new(dynamics);
        let Some(jerk) = &dynamics.jerk else { return Self { plain, smoothed: Box::default() } };
        let limits = dynamics.acceleration.iter().zip(jerk);
        let seconds = limits.map(|(acceleration, jerk)| 2.0 * acceleration / jerk);
        let seconds = seconds.fold(0.0, math::max);
        let reached = |cycles: &u16| f64::from(*cycles) * dynamics.cycle >= seconds;
        if reached(&1) {
            return Self { plain, smoothed: Box::default() };
        }
        let last = (1..SMOOTHED_LIMITS_MAX).find(reached).unwrap_or(SMOOTHED_LIMITS_MAX);
        let smoothed: Vec<Limits> =
            (1..=last).map(|cycles| Limits::smoothed(dynamics, jerk, cycles)).collect();
        Self { plain, smoothed: smoothed.into_boxed_slice() }
    }

    /// The limits of the motion on an element.
    #[inline]
    pub(crate) fn of(&self, element: &PathElement) -> &Limits {
        self.smoothed_over(element.smoothing.limits)
    }

    /// The limits of a motion that is averaged over a number of cycles.
    #[inline]
    pub(crate) fn smoothed_over(&self, cycles: u16) -> &Limits {
        self.smoothed.get(usize::from(cycles).wrapping_sub(1)).unwrap_or(&self.plain)
    }

    /// The number of cycles over which an average lets the axes use all of their acceleration, or the most that is
    /// possible; 0 where motions are not smoothed.
    pub(crate) fn cycles_max(&self) -> u16 {
        u16::try_from(self.smoothed.len()).unwrap_or(0)
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
