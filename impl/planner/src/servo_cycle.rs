//! A servo cycle: the motion moves along the elements, never faster than look-ahead allows.

use crate::acceleration_window::AccelerationWindow;
use crate::entry_speed::{exit_speed_sq, speed_sq_before};
use crate::limits::{LimitTable, Limits, squared};
use crate::math;
use crate::motion::{
    BLEND_WORK, CycleRequest, ELEMENTS_PER_CYCLE_MAX, ElementEnd, MotionState, target_speed,
};
use crate::path_element::{AccelerationModel, PathElement};
use crate::ring::Ring;

impl MotionState {
    /// Moves by one cycle.
    #[inline(always)]
    pub(crate) fn advance_cycle(
        &mut self,
        elements: &Ring<PathElement>,
        limits: &Limits,
        request: &CycleRequest,
    ) {
        self.acceleration = 0.0;
        (self.work, self.found_braking) = (0, false);
        let easy = request.is_planned
            && request.rapid >= 1.0
            && !(request.must_stop || self.is_reversed || self.avoids_fast_path);
        let mut time_left = limits.cycle - core::mem::take(&mut self.time_owed);
        if easy {
            time_left = self.advance_fast(elements, limits, request, time_left);
        }
        if time_left > 0.0 {
            // An element that the fast path could not decide has been examined twice.
            self.work = self.work.saturating_add(u32::from(easy));
            self.advance(elements, limits, request, time_left);
        }
    }

    #[inline(never)]
    fn advance(
        &mut self,
        elements: &Ring<PathElement>,
        limits: &Limits,
        request: &CycleRequest,
        mut time_left: f64,
    ) {
        let Some(mut element) = elements.get(self.at) else { return };
        for _ in 0..ELEMENTS_PER_CYCLE_MAX {
            let mut remaining = self.remaining(element);
            if remaining <= 0.0 {
                let Some(next) = self.enter_next(elements, element, &mut time_left) else { return };
                element = next;
                remaining = self.remaining(element);
            }
            if let AccelerationModel::Dwell(_) = element.model {
                if time_left > 0.0 && !request.must_stop {
                    continue;
                }
                return;
            }
            self.work = self.work.saturating_add(match element.model {
                AccelerationModel::Constant { .. } | AccelerationModel::Dwell(_) => 1,
                AccelerationModel::Blend { .. } => BLEND_WORK,
                AccelerationModel::Arc { .. } | AccelerationModel::BlendedArc { .. } => 3,
            });
            let end = self.end(elements, element, remaining, request);
            let from = self.x;
            time_left -= self.advance_within(element, end, (limits, request), time_left);
            if !self.is_reversed {
                self.note_begin(element, from);
            }
            if time_left <= 0.0 || self.remaining(element) > 0.0 {
                return;
            }
        }
    }

    /// The end of the element in the direction of motion. Under an override the exit is at most the requested speed of
    /// the next element, where that is planned for more.
    #[inline]
    fn end(
        &self,
        elements: &Ring<PathElement>,
        element: &PathElement,
        remaining: f64,
        request: &CycleRequest,
    ) -> ElementEnd {
        if self.is_reversed {
            let before = elements.get(self.at.wrapping_sub(1));
            let reach = |before: &PathElement| {
                before.reverse_entry_speed_sq * squared(before.end_speed_ratio)
            };
            let exit =
                before.map_or(0.0, |before| math::min(reach(before), element.junction_limit_sq));
            return ElementEnd { speed_sq: exit, remaining, is_open: false };
        }
        let Some(next) = elements.get(self.at.wrapping_add(1)) else {
            return ElementEnd { speed_sq: 0.0, remaining, is_open: false };
        };
        let mut exit = next.entry_speed_sq / squared(element.end_speed_ratio);
        if request.speed_sq_factor < 1.0 {
            let requested = target_speed(next, next.speed_limit, request);
            exit = math::min(
                exit,
                squared(requested / element.end_speed_ratio) / request.speed_sq_factor,
            );
        }
        ElementEnd { speed_sq: exit, remaining, is_open: next.junction_limit_sq > 0.0 }
    }

    /// Moves to the next element. `None` where there is none, or where a dwell uses up the cycle.
    fn enter_next<'a>(
        &mut self,
        elements: &'a Ring<PathElement>,
        element: &PathElement,
        time_left: &mut f64,
    ) -> Option<&'a PathElement> {
        if self.is_reversed {
            let before = self.at.checked_sub(1).filter(|before| *before >= self.reverse_end)?;
            let earlier = elements.get(before)?;
            if element.starts_at_rest && !self.may_enter(earlier, time_left) {
                return None;
            }
            self.at = before;
            self.speed /= earlier.end_speed_ratio;
            self.x = earlier.length;
            return Some(earlier);
        }
        if let AccelerationModel::Dwell(seconds) = element.model {
            let rest = seconds - self.dwell_elapsed;
            if rest > *time_left {
                self.dwell_elapsed += *time_left;
                *time_left = 0.0;
                return None;
            }
            *time_left -= math::max(0.0, rest);
            self.dwell_elapsed = seconds;
        }
        let after = self.at.wrapping_add(1);
        let Some(later) = elements.get(after) else {
            // Rounding may have left a little speed at the end of the path.
            self.speed = 0.0;
            return None;
        };
        if later.starts_at_rest && !self.may_enter(later, time_left) {
            return None;
        }
        self.enter(element);
        Some(later)
    }

    /// Moves within an element while there is time and path. Returns the time used.
    #[inline]
    fn advance_within(
        &mut self,
        element: &PathElement,
        end: ElementEnd,
        requested: (&Limits, &CycleRequest),
        time_left: f64,
    ) -> f64 {
        match element.model {
            AccelerationModel::Blend { .. } if element.axis_count <= 3 => {
                self.advance_on_blend::<3>(element, end, requested, time_left)
            }
            AccelerationModel::Blend { .. } => {
                self.advance_on_blend::<9>(element, end, requested, time_left)
            }
            AccelerationModel::Constant { .. }
            | AccelerationModel::Arc { .. }
            | AccelerationModel::BlendedArc { .. }
            | AccelerationModel::Dwell(_) => self.advance_along(element, end, requested, time_left),
        }
    }

    #[inline]
    fn advance_along(
        &mut self,
        element: &PathElement,
        end: ElementEnd,
        (limits, request): (&Limits, &CycleRequest),
        time_left: f64,
    ) -> f64 {
        if self.is_on_lone_line {
            return self.advance_on_lone_line(element, end, (limits.cycle, request), time_left);
        }
        let mut low = self.strongest_model_braking(element, limits.cycle);
        let mut target = f64::NEG_INFINITY;
        if !request.must_stop {
            target = target_speed(element, element.speed_limit, request);
        }
        let most = low;
        if self.speed + low * time_left > target {
            // A lowered override uses all of the braking, as a hold does.
            low = math::min(low, self.strongest_braking(element, limits, time_left));
        }
        let mut acceleration = low;
        if (target - self.speed) / time_left > low {
            let window =
                self.window(element, end, request.speed_sq_factor, (time_left, limits.cycle), most);
            acceleration = self.acceleration_towards(
                &AccelerationWindow { min: low, ..window },
                target,
                end,
                (request.speed_sq_factor, time_left),
            );
        }
        self.accelerate(element, acceleration, end, time_left)
    }

    /// Whether the motion can follow an element that was changed at its end.
    pub(crate) fn can_follow(&self, elements: &Ring<PathElement>, limits: &LimitTable) -> bool {
        let Some(element) = elements.get(self.at) else { return true };
        let exit = exit_speed_sq(elements, element, self.at);
        self.can_reach_end_at(element, exit, limits.of(element))
    }

    /// Whether the motion can reach the end of its element at a squared speed or less.
    pub(crate) fn can_reach_end_at(
        &self,
        element: &PathElement,
        exit: f64,
        limits: &Limits,
    ) -> bool {
        let y = squared(self.speed);
        if y <= 0.0 || self.is_reversed {
            return true;
        }
        let remaining = self.remaining(element);
        match element.model {
            AccelerationModel::Blend { .. } => {
                let low = self.min_acceleration(element, remaining, limits);
                let high = self.max_acceleration(element, remaining, limits);
                let high = high.min((exit - y) / (2.0 * remaining));
                low <= high + 1e-9 * (1.0 - low)
            }
            AccelerationModel::Constant { .. }
            | AccelerationModel::Arc { .. }
            | AccelerationModel::BlendedArc { .. }
            | AccelerationModel::Dwell(_) => {
                y <= speed_sq_before(element.model, &element.circle, exit, remaining) * (1.0 + 1e-9)
            }
        }
    }
}
