//! Which moving average smooths a stretch of the path, from rest to rest.
//!
//! An average over more cycles allows more acceleration, and it lasts longer and rounds corners more. How long it is
//! depends on what is known when the first segment of a stretch is queued: its tolerance, or its length.

use crate::acceleration_model::{lone_arc_across, lone_arc_speed};
use crate::feed_path::FeedPath;
use crate::limits::{LimitTable, Limits, least, squared};
use crate::math;
use crate::parameters::Axes;
use crate::path_element::{Averaged, Smoothing};
use crate::segment::{Feed, PathControl};
use crate::vector::norm_of;

/// The share of a tolerance that an average may use; blends have the rest. More acceleration is worth more than larger
/// blends: with 0.5 corners take 3 to 11 % longer.
pub(crate) const TOLERANCE_SHARE: f64 = 0.85;
/// The least share of the longest average that a tolerance may require, as a power of a half. With a stricter one,
/// corners are stops.
const TOLERANT_WINDOW_SHIFT: u16 = 4;
/// The least share of the longest average on lines of an exact path, as a power of a half. Only the length of the first
/// line is known when the average is chosen.
const EXACT_WINDOW_SHIFT: u16 = 2;
/// The most cycles that an average covers.
pub(crate) const WINDOW_CYCLES_MAX: u16 = 256;
/// The number of lengths of an average that are tried, at most.
const TRIALS_MAX: u32 = 16;

/// What all segments of a stretch have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stretch {
    /// What the segments request, and what is planned.
    pub(crate) requested: PathControl,
    pub(crate) path_control: PathControl,
    pub(crate) feed: Feed,
    pub(crate) feed_path: FeedPath,
    /// The axes that may move.
    pub(crate) axes: MovingAxes,
}

/// A set of axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct MovingAxes([bool; 9]);

impl MovingAxes {
    /// Those with a share of a direction.
    pub(crate) fn of(direction: &Axes) -> Self {
        Self(direction.map(|share| share.abs() > 0.0))
    }

    /// Whether others than X, Y and Z are among them.
    pub(crate) fn has_more_than_three(self) -> bool {
        self.0.iter().skip(3).any(|moves| *moves)
    }

    pub(crate) fn contains(self, other: Self) -> bool {
        self.0.iter().zip(&other.0).all(|(one, other)| *one || !*other)
    }
}

/// A way from rest to rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way {
    pub(crate) length: f64,
    /// The direction, of length 1.
    pub(crate) direction: Axes,
    /// Highest speed requested.
    pub(crate) speed: f64,
    /// Of an arc; infinite for a line.
    pub(crate) radius: f64,
}

/// How far an average over cycles may be off the planned motion of some axes with these limits: where the acceleration
/// is a, its middle is off by at most a·h²·(N² - 1)/24.
pub(crate) fn deviation(limits: &Limits, axes: MovingAxes) -> f64 {
    let cycles = f64::from(limits.smoothing.window);
    let mut acceleration = limits.acceleration;
    for (limit, moves) in acceleration.iter_mut().zip(axes.0) {
        *limit = if moves { *limit } else { 0.0 };
    }
    norm_of(&acceleration, 9) * squared(limits.cycle) * (squared(cycles) - 1.0) / 24.0
}

impl LimitTable {
    /// The limits of motion within a tolerance: with the longest average that its share allows. `None` where that would
    /// leave little of the acceleration.
    pub(crate) fn within(&self, allowed: f64, axes: MovingAxes) -> Option<&Limits> {
        let longest = self.cycles_max().min(WINDOW_CYCLES_MAX);
        let cycles =
            last_that(longest, |cycles| deviation(self.smoothed_over(cycles), axes) <= allowed);
        let enough = allowed > 0.0 && cycles >= longest >> TOLERANT_WINDOW_SHIFT;
        enough.then(|| self.smoothed_over(cycles))
    }

    /// The limits of lines that are followed exactly.
    pub(crate) fn exact(&self, way: &Way) -> Limits {
        let longest = self.cycles_max().min(WINDOW_CYCLES_MAX);
        let time = |cycles: u16| {
            let limits = self.smoothed_over(cycles);
            time_of(limits, way, f64::from(cycles) * limits.cycle, 0.0)
        };
        let cycles = fastest(longest, time);
        let cycles = cycles.max(longest >> EXACT_WINDOW_SHIFT);
        Limits { rests_at_corners: true, ..*self.smoothed_over(cycles) }
    }

    /// The limits of a line between two rests: an average over half of the cycles is enough (`lone_line`).
    pub(crate) fn lone_line(&self, way: &Way) -> Limits {
        let longest = (self.cycles_max().saturating_add(1) >> 1).min(WINDOW_CYCLES_MAX);
        let time = |cycles: u16| {
            let limits = self.smoothed_over(cycles.saturating_mul(2).min(self.cycles_max()));
            let seconds = f64::from(cycles) * limits.cycle;
            time_of(limits, way, seconds, seconds)
        };
        let window = fastest(longest, time);
        let cycles = window.saturating_mul(2).min(self.cycles_max());
        self.lone(cycles, window, Averaged::LoneLine)
    }

    /// The limits of an arc between two rests: half of the jerk is for its curvature, so an average takes twice as
    /// many cycles.
    pub(crate) fn lone_arc(&self, way: &Way) -> Limits {
        let longest = self.cycles_max().min(WINDOW_CYCLES_MAX >> 1);
        let time = |cycles: u16| {
            let limits = self.smoothed_over(cycles);
            // The higher the acceleration, the lower the speed that the jerk allows.
            let acceleration = least(&limits.acceleration, &way.direction, 9);
            let jerk = least(&limits.jerk, &way.direction, 9);
            let fastest = lone_arc_speed(1.0 / way.radius, acceleration, jerk);
            let machine = least(&limits.unsmoothed, &way.direction, 9);
            let across = lone_arc_across(acceleration, machine).unwrap_or(acceleration);
            let speed = math::min(math::min(way.speed, fastest), math::sqrt(across * way.radius));
            // The speed has the limit of the curvature already.
            let way = Way { speed, radius: f64::INFINITY, ..*way };
            time_of(limits, &way, 2.0 * f64::from(cycles) * limits.cycle, 0.0)
        };
        let cycles = fastest(longest, time);
        self.lone(cycles, cycles.saturating_mul(2), Averaged::LoneArc)
    }

    fn lone(&self, cycles: u16, window: u16, averaged: Averaged) -> Limits {
        let limits = *self.smoothed_over(cycles);
        let smoothing = Smoothing { window, averaged, ..limits.smoothing };
        Limits { smoothing, rests_at_corners: true, ..limits }
    }
}

/// The time from rest to rest with these limits: with an average over a time, and a least time between speeding up and
/// slowing down.
fn time_of(limits: &Limits, way: &Way, average: f64, coast: f64) -> f64 {
    let most = least(&limits.planned, &way.direction, 9);
    let speed = math::min(way.speed, least(&limits.velocity, &way.direction, 9));
    // The acceleration across an arc, too.
    let speed = math::min(speed, math::sqrt(most * way.radius));
    // A speed v takes v²/a + v·coast.
    let reached =
        0.5 * (math::sqrt(squared(most * coast) + 4.0 * most * way.length) - most * coast);
    let top = math::min(speed, reached);
    average + top / most + way.length / top
}

/// The number of cycles with the least time, if that first falls and then rises.
fn fastest(longest: u16, time: impl Fn(u16) -> f64) -> u16 {
    let (mut low, mut high) = (1_u16, longest.max(1));
    for _ in 0..TRIALS_MAX {
        if low >= high {
            break;
        }
        let middle = low.saturating_add(high.saturating_sub(low) >> 1);
        if time(middle.saturating_add(1)) < time(middle) {
            low = middle.saturating_add(1);
        } else {
            high = middle;
        }
    }
    low
}

/// The greatest number up to another one with a property that all lesser ones have; 1 if none has.
fn last_that(longest: u16, has: impl Fn(u16) -> bool) -> u16 {
    let (mut low, mut high) = (1_u16, longest.max(1));
    for _ in 0..TRIALS_MAX {
        if low >= high {
            break;
        }
        let middle = high.saturating_sub(high.saturating_sub(low) >> 1);
        if has(middle) {
            low = middle;
        } else {
            high = middle.saturating_sub(1);
        }
    }
    low
}
