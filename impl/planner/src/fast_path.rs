//! The fast path of a servo cycle, for the common case that look-ahead and axes allow more than is requested.
//!
//! It runs forward at the overrides that look-ahead has planned for, up to an element that it cannot decide quickly,
//! and leaves the rest of the cycle to `servo_cycle`. That would do the same, except for rounding.

use crate::acceleration_window::constant_window;
use crate::limits::{Limits, squared};
use crate::math;
use crate::motion::{
    BLEND_WORK, CycleRequest, ELEMENTS_PER_CYCLE_MAX, ElementEnd, LONG_BLEND_CYCLES_MIN,
    MotionState,
};
use crate::path_element::{AccelerationModel, FeedBasis, PathElement};
use crate::ring::Ring;

/// The share of the limits that a blend may use on the fast path: its |p'| may be a little above 1
/// (`corner::PARABOLA_SIDE_RATIO_MAX`).
const FAST_USE_RATIO_MAX: f64 = 0.98;
/// By this factor rounding may raise one squared speed above another.
const SPEED_SQ_ROUNDING_RATIO: f64 = 1.0 + 1e-12;

/// An acceleration that is known to be allowed, and what it leads to.
#[derive(Clone, Copy, Debug)]
struct FastStep {
    acceleration: f64,
    /// The squared speed at the end of the element.
    end_speed_sq: f64,
}

impl MotionState {
    /// Moves along elements that are decided quickly. Returns the time that is left for the others.
    #[inline(always)]
    pub(crate) fn advance_fast(
        &mut self,
        elements: &Ring<PathElement>,
        limits: &Limits,
        request: &CycleRequest,
        mut time_left: f64,
    ) -> f64 {
        let Some(mut element) = elements.get(self.at) else { return time_left };
        for _ in 0..ELEMENTS_PER_CYCLE_MAX {
            let Some(next) = elements.get(self.at.wrapping_add(1)) else { return time_left };
            let remaining = element.length - self.x;
            if remaining > 0.0 {
                let exit = next.entry_speed_sq / squared(element.end_speed_ratio);
                if exit <= 0.0 && next.junction_limit_sq > 0.0 {
                    return time_left;
                }
                let Some(step) = self.fast_step(
                    (element, next),
                    (exit, remaining),
                    (limits, request),
                    time_left,
                ) else {
                    return time_left;
                };
                let end = self.speed + step.acceleration * time_left;
                let from = self.x;
                let x = from + 0.5 * (self.speed + end) * time_left;
                if end > 0.0 && x < element.length {
                    self.acceleration = step.acceleration;
                    self.x = x;
                    self.speed = end;
                    self.begin_segment(element, from);
                    return 0.0;
                }
                if step.end_speed_sq <= 0.0 || exit <= 0.0 {
                    return time_left;
                }
                let end = math::sqrt(step.end_speed_sq);
                let time = 2.0 * remaining / (self.speed + end);
                if time >= time_left {
                    return time_left;
                }
                time_left -= time;
                self.acceleration = step.acceleration;
                self.x = element.length;
                self.speed = end;
                self.begin_segment(element, from);
            } else if let AccelerationModel::Dwell(_) = element.model {
                return time_left;
            }
            self.work = self.work.saturating_add(1);
            self.enter(element);
            element = next;
        }
        time_left
    }

    /// The requested acceleration, if it is quickly known to be allowed.
    #[inline(always)]
    fn fast_step(
        &mut self,
        (element, next): (&PathElement, &PathElement),
        (exit, remaining): (f64, f64),
        (limits, request): (&Limits, &CycleRequest),
        time_left: f64,
    ) -> Option<FastStep> {
        let y = squared(self.speed);
        // The fast path runs without a rapid override.
        let target = match element.feed_basis {
            FeedBasis::PerSecond => math::min(element.speed_limit, element.feed * request.feed),
            FeedBasis::Rapid => element.speed_limit,
            FeedBasis::PerTurn => return None,
        };
        let requested = (target - self.speed) / time_left;
        match (element.model, &element.circle) {
            (AccelerationModel::Blend { steady_speed_sq }, _) => {
                let exit = math::min(exit, element.end_limit_sq);
                let met = (exit - y) / (2.0 * remaining);
                let most = math::min(requested, met);
                // An axis uses at most |p'|·|u| + |p''|·y.
                let last = y + 2.0 * most * remaining;
                let used = math::max(y, last) / steady_speed_sq + most.abs() / limits.softest;
                // On a long blend more than the sustainable acceleration may be possible.
                let lasts = || LONG_BLEND_CYCLES_MIN * self.speed * limits.cycle < remaining;
                if used <= FAST_USE_RATIO_MAX && (most >= requested || !lasts()) {
                    return Some(FastStep { acceleration: most, end_speed_sq: last });
                }
                let slows = met <= requested
                    && met <= 0.0
                    && self.keeps_to_plan((element, next), exit, steady_speed_sq);
                if slows && !lasts() {
                    return Some(FastStep { acceleration: met, end_speed_sq: last });
                }
                let acceleration = if lasts() {
                    let end = ElementEnd { speed_sq: exit, remaining, is_open: false };
                    self.acceleration_on_long_blend(
                        element,
                        end,
                        (most, requested),
                        (limits, request),
                        time_left,
                    )?
                } else {
                    self.acceleration_near_limit(element, remaining, most, limits)?
                };
                Some(FastStep { acceleration, end_speed_sq: y + 2.0 * acceleration * remaining })
            }
            (AccelerationModel::Constant { acceleration }, _) => {
                let window = constant_window(
                    acceleration,
                    ElementEnd { speed_sq: exit, remaining, is_open: false },
                    1.0,
                );
                let acceleration = self.acceleration_towards(
                    &window,
                    target,
                    ElementEnd { speed_sq: exit, remaining, is_open: false },
                    (1.0, time_left),
                );
                let last = y + 2.0 * acceleration * remaining;
                Some(FastStep { acceleration, end_speed_sq: last })
            }
            (AccelerationModel::Arc { acceleration: most, .. }, Some(circle)) => {
                let end = self.speed + requested * time_left;
                let high = math::max(y, squared(end));
                let after = remaining - 0.5 * (self.speed + end) * time_left;
                let used = squared(requested) + squared(circle.angle_rate * high);
                let easy = used <= squared(most)
                    && (high <= exit * SPEED_SQ_ROUNDING_RATIO
                        || circle.is_beyond_influence(after))
                    && after > 0.0;
                easy.then_some(FastStep { acceleration: requested, end_speed_sq: 0.0 })
            }
            _ => None,
        }
    }

    /// Whether the motion is at most as fast as look-ahead has planned on this blend, so that it may slow down evenly
    /// to the exit.
    ///
    /// The axes allow the plan: from `entry_speed_sq` at the start to the exit that it assumed. They also allow a
    /// constant speed of `entry_speed_sq` if that is at most the steady speed. The allowed set is convex, so
    /// everything between these two is allowed as long as the exit is at least that of the plan.
    #[inline]
    fn keeps_to_plan(
        &self,
        (element, next): (&PathElement, &PathElement),
        exit: f64,
        steady_speed_sq: f64,
    ) -> bool {
        let planned = exit * self.x + element.entry_speed_sq * (element.length - self.x);
        next.entry_speed_sq >= element.assumed_next_entry_sq
            && element.entry_speed_sq <= steady_speed_sq
            && squared(self.speed) * element.length <= planned * SPEED_SQ_ROUNDING_RATIO
    }

    /// The acceleration on a blend whose axes allow little more than the request.
    #[cold]
    #[inline(never)]
    fn acceleration_near_limit(
        &self,
        element: &PathElement,
        remaining: f64,
        most: f64,
        limits: &Limits,
    ) -> Option<f64> {
        if element.axis_count <= 3 {
            self.acceleration_near_limit_of::<3>(element, remaining, most, limits)
        } else {
            self.acceleration_near_limit_of::<9>(element, remaining, most, limits)
        }
    }

    #[inline]
    fn acceleration_near_limit_of<const N: usize>(
        &self,
        element: &PathElement,
        remaining: f64,
        most: f64,
        limits: &Limits,
    ) -> Option<f64> {
        self.sustainable::<N>(element, remaining, most, limits).or_else(|| {
            let low = self.min_acceleration_of::<N>(element, remaining, limits);
            self.near_limit::<N>(element, remaining, (most, low), limits)
        })
    }

    /// The acceleration on a long blend.
    #[cold]
    #[inline(never)]
    fn acceleration_on_long_blend(
        &mut self,
        element: &PathElement,
        end: ElementEnd,
        requested: (f64, f64),
        with: (&Limits, &CycleRequest),
        time_left: f64,
    ) -> Option<f64> {
        self.work = self.work.saturating_add(BLEND_WORK);
        if element.axis_count <= 3 {
            self.sustainable_or_faster::<3>(element, end, requested, with, time_left)
        } else {
            self.sustainable_or_faster::<9>(element, end, requested, with, time_left)
        }
    }
}
