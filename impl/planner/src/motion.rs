//! The motion itself: a cycle at a time along the pieces, never faster than look-ahead says.
//!
//! Within a piece and a cycle the acceleration of the parameter is constant, so that the speed has no jumps and each
//! axis keeps its limits at every instant. Differences of samples are means of such accelerations, whatever their
//! period.

use crate::entry_speed::speed_sq_before;
use crate::limits::{Limits, PLANNED_RATIO, squared};
use crate::look_ahead::exit_speed_sq;
use crate::math;
use crate::path_element::{AccelerationModel, Circle, FeedBasis, PathElement};
use crate::ring::Ring;

/// The share of an axis in a direction below which it takes no part.
pub(crate) const AXIS_SHARE_MIN: f64 = 1e-9;
/// By so much what is left of a piece may be too short by rounding for a motion that is to come to rest at its end.
const REMAINING_ROUNDING_RATIO: f64 = 1.0 + 1e-6;
/// The most pieces that are touched in a cycle; pieces are made so that fewer fit into one.
pub(crate) const ELEMENTS_PER_CYCLE_MAX: u32 = 12;
/// What a part of a cycle on a bend is worth of [`MotionState::effort`].
pub(crate) const BLEND_WORK: u32 = 2;
/// What costs much in a cycle is left out, or to the next one, where this much has been done.
pub(crate) const CYCLE_WORK_MAX: u32 = 5;
/// For how many cycles a bend must still last at the present speed where another acceleration is looked for than one
/// that can be kept up to its end.
pub(crate) const LONG_BLEND_CYCLES_MIN: f64 = 2.0;

/// What is asked for in a cycle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CycleRequest {
    /// Share of the programmed feed.
    pub(crate) feed: f64,
    /// Share of the rapid speed.
    pub(crate) rapid: f64,
    /// Turns of the spindle per second, times the share of the programmed feed.
    pub(crate) spindle_speed: f64,
    /// Whether to come to rest.
    pub(crate) must_stop: bool,
    /// Whether look-ahead has planned for just these shares.
    pub(crate) is_planned: bool,
    /// What speeds of look-ahead are multiplied by, squared, where it has planned for more than is asked for.
    pub(crate) speed_sq_factor: f64,
}

/// Where the motion is.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MotionState {
    /// The piece.
    pub(crate) at: u64,
    /// Its parameter.
    pub(crate) x: f64,
    /// Speed of the parameter, never negative.
    pub(crate) speed: f64,
    /// Its acceleration in the last part of the cycle, along the direction of motion.
    pub(crate) acceleration: f64,
    /// Whether it runs back.
    pub(crate) is_reversed: bool,
    /// The piece to whose beginning it may run back.
    pub(crate) reverse_end: u64,
    /// Seconds of a dwell that are over.
    pub(crate) dwell_elapsed: f64,
    /// The segment under way: planner's number and caller's.
    pub(crate) begun: u64,
    pub(crate) number: u64,
    /// How much work this cycle has been, in parts of it on a line; one on a bend counts as two, one on an arc as
    /// three, and where all is easy each piece that is passed as one.
    pub(crate) work: u32,
    /// Whether the least acceleration on an arc has been found in it.
    pub(crate) found_braking: bool,
    /// Seconds that the rest at the end of the cycle before begins late.
    pub(crate) time_owed: f64,
}

/// Least and greatest acceleration, and the square of the speed that look-ahead allows: `bound`, and `slope` more per
/// unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AccelerationWindow {
    min: f64,
    max: f64,
    speed_sq: f64,
    speed_sq_slope: f64,
}

/// The end of a piece in the direction of motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementEnd {
    /// Square of the speed at which the piece may be left there.
    pub(crate) speed_sq: f64,
    /// How far it is.
    pub(crate) remaining: f64,
    /// Whether the path goes on without rest there, so that only an override can ask for one.
    pub(crate) is_open: bool,
}

impl MotionState {
    /// Moves on by a cycle.
    #[inline]
    pub(crate) fn advance_cycle(
        &mut self,
        elements: &Ring<PathElement>,
        limits: &Limits,
        request: &CycleRequest,
    ) {
        self.acceleration = 0.0;
        (self.work, self.found_braking) = (0, false);
        let easy =
            request.is_planned && request.rapid >= 1.0 && !request.must_stop && !self.is_reversed;
        let mut time_left = limits.cycle - core::mem::take(&mut self.time_owed);
        if easy {
            time_left = self.advance_fast(elements, limits, request, time_left);
        }
        if time_left > 0.0 {
            // What is not easy has been looked at twice.
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

    /// What is left of the piece in the direction of motion.
    pub(crate) fn remaining(&self, element: &PathElement) -> f64 {
        if self.is_reversed { self.x } else { element.length - self.x }
    }

    /// The end of the piece in the direction of motion. An override makes no more of its exit than the next piece is
    /// asked to have, where that is planned for more.
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
            let asked = target_speed(next, next.speed_limit, request);
            exit =
                math::min(exit, squared(asked / element.end_speed_ratio) / request.speed_sq_factor);
        }
        ElementEnd { speed_sq: exit, remaining, is_open: next.junction_limit_sq > 0.0 }
    }

    /// The square of the speed at which a piece is left where an override asks for rest at its end when the motion
    /// can no more come to it, since `late`.
    #[inline]
    pub(crate) fn exit_after_late_override(
        &self,
        element: &PathElement,
        end: ElementEnd,
        late: impl Fn(f64) -> bool,
    ) -> f64 {
        let far = end.remaining * REMAINING_ROUNDING_RATIO + 8.0 * f64::EPSILON * element.length;
        if end.is_open && end.speed_sq <= 0.0 && late(far) {
            f64::MIN_POSITIVE
        } else {
            end.speed_sq
        }
    }

    /// Goes over to the next piece; none where there is none, or where a dwell uses up the cycle.
    fn enter_next<'a>(
        &mut self,
        elements: &'a Ring<PathElement>,
        element: &PathElement,
        time_left: &mut f64,
    ) -> Option<&'a PathElement> {
        if self.is_reversed {
            let before = self.at.checked_sub(1).filter(|before| *before >= self.reverse_end)?;
            let earlier = elements.get(before)?;
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
            // Rounding may have brought the motion to the end of all with a little speed left.
            self.speed = 0.0;
            return None;
        };
        self.enter(element);
        Some(later)
    }

    /// Goes over to the piece after this one.
    #[inline]
    pub(crate) fn enter(&mut self, before: &PathElement) {
        self.at = self.at.wrapping_add(1);
        self.speed *= before.end_speed_ratio;
        self.x = 0.0;
        self.dwell_elapsed = 0.0;
    }

    /// Who is held at the start of a segment has not begun it.
    fn note_begin(&mut self, element: &PathElement, from: f64) {
        if self.x > from {
            self.begin_segment(element, from);
        }
    }

    /// A segment has begun if its start was passed.
    #[inline]
    pub(crate) fn begin_segment(&mut self, element: &PathElement, from: f64) {
        if element.segment_start.is_some_and(|begins| from <= begins && begins <= self.x) {
            self.begun = self.begun.max(element.index);
            self.number = element.number;
        }
    }

    /// Moves within a piece for as long as there is time and path; how long that was.
    #[inline]
    fn advance_within(
        &mut self,
        element: &PathElement,
        end: ElementEnd,
        asked: (&Limits, &CycleRequest),
        time_left: f64,
    ) -> f64 {
        match element.model {
            AccelerationModel::Blend { .. } if element.axis_count <= 3 => {
                self.advance_on_blend::<3>(element, end, asked, time_left)
            }
            AccelerationModel::Blend { .. } => {
                self.advance_on_blend::<9>(element, end, asked, time_left)
            }
            AccelerationModel::Constant { .. }
            | AccelerationModel::Arc { .. }
            | AccelerationModel::BlendedArc { .. }
            | AccelerationModel::Dwell(_) => self.advance_along(element, end, asked, time_left),
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
        let mut low = self.strongest_model_braking(element, limits.cycle);
        let mut wanted = f64::NEG_INFINITY;
        if !request.must_stop {
            wanted = target_speed(element, element.speed_limit, request);
        }
        let most = low;
        if self.speed + low * time_left > wanted {
            // Whoever lowers an override wants all of the brakes, as for a hold.
            low = math::min(low, self.strongest_braking(element, limits, time_left));
        }
        let mut acceleration = low;
        if (wanted - self.speed) / time_left > low {
            let window =
                self.window(element, end, request.speed_sq_factor, (time_left, limits.cycle), most);
            acceleration = self.acceleration_towards(
                &AccelerationWindow { min: low, ..window },
                wanted,
                end,
                (request.speed_sq_factor, time_left),
            );
        }
        self.accelerate(element, acceleration, end, time_left)
    }

    /// The acceleration towards a speed that a ramp allows.
    #[inline]
    pub(crate) fn acceleration_towards(
        &self,
        window: &AccelerationWindow,
        wanted: f64,
        ElementEnd { speed_sq: exit, remaining, .. }: ElementEnd,
        (speed_sq_factor, time_left): (f64, f64),
    ) -> f64 {
        // The speed at the end of the cycle at which look-ahead's bound is just met.
        let half = 0.5 * window.speed_sq_slope * time_left;
        let met = half * half + 4.0 * (window.speed_sq + half * self.speed);
        let met = if met > 0.0 { 0.5 * (half + math::sqrt(met)) } else { 0.0 };
        let acceleration = clamped((math::min(wanted, met) - self.speed) / time_left, window);
        let travel = (self.speed + 0.5 * acceleration * time_left) * time_left;
        if met > 0.0 && travel < remaining {
            return acceleration;
        }
        if self.speed <= 0.0 && exit <= 0.0 {
            // So little is left from rest to rest that rounding hides how it is come to: within the cycle.
            return clamped(2.0 * remaining / squared(time_left), window);
        }
        // The end comes first.
        let y = squared(self.speed);
        let mut most = (speed_sq_factor * exit - y) / (2.0 * remaining);
        if self.speed > wanted {
            most = math::min(most, (wanted - self.speed) / time_left);
        } else {
            most = math::min(most, (squared(wanted) - y) / (2.0 * remaining));
        }
        clamped(most, window)
    }

    /// The least acceleration that the law of a piece without a bend allows.
    #[inline]
    fn strongest_model_braking(&self, element: &PathElement, cycle: f64) -> f64 {
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

    fn window(
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

    /// The ramp where the acceleration that is left depends on the square of the speed: less where that is higher.
    fn window_on_arc(
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

    /// Accelerates evenly until the time is over, the piece ends, or the motion rests.
    #[inline(always)]
    pub(crate) fn accelerate(
        &mut self,
        element: &PathElement,
        acceleration: f64,
        ahead: ElementEnd,
        time_left: f64,
    ) -> f64 {
        let remaining = ahead.remaining;
        self.acceleration = acceleration;
        let end = self.speed + acceleration * time_left;
        let travel = 0.5 * (self.speed + end) * time_left;
        if end > 0.0 && travel < remaining {
            self.move_by(travel);
            self.speed = end;
            // Rounding may bring it to the end all the same.
            if ahead.speed_sq <= 0.0 && self.remaining(element) <= 0.0 {
                self.stop_at_end(end, time_left);
            }
            return time_left;
        }
        let y = squared(self.speed);
        let exit = self.exit_after_late_override(element, ahead, |far| {
            y > speed_sq_before(element.model, &element.circle, 0.0, far)
        });
        let (mut last, mut brakes) = (y + 2.0 * acceleration * remaining, 0.0);
        if exit <= 0.0 && last >= -1e-6 * y {
            // The square of the last speed is the difference of two numbers that should be equal. Less is left of it
            // by braking a little harder than by resting all of a sudden.
            last = 0.0;
            // What is left of a long piece is rounded, and so how long that takes; how long the brakes take is not.
            if acceleration < 0.0 {
                brakes = -self.speed / acceleration;
            }
        }
        if last >= 0.0 {
            let end = math::sqrt(last);
            let both = self.speed + end;
            let time = if remaining > 0.0 { 2.0 * remaining / both } else { 0.0 };
            let time = math::max(time, brakes);
            if time <= time_left {
                self.x = if self.is_reversed { 0.0 } else { element.length };
                self.speed = if exit > 0.0 { end } else { 0.0 };
                return time;
            }
        } else if end <= 0.0 {
            let travel = -0.5 * y / acceleration;
            self.move_by(math::min(travel, remaining));
            self.speed = 0.0;
            return time_left;
        }
        self.move_by(math::min(travel, remaining));
        self.speed = math::max(0.0, end);
        if exit <= 0.0 && travel >= remaining {
            self.stop_at_end(end, time_left);
        }
        time_left
    }

    /// Comes to rest at the end of a piece with the end of a cycle, where rounding leaves a speed of it. What that
    /// would still take is less than the place can show, but an axis that turns round needs the time.
    #[cold]
    fn stop_at_end(&mut self, end: f64, time_left: f64) {
        let takes = -end / self.acceleration;
        self.time_owed = math::min(math::max(0.0, takes), time_left);
        self.speed = 0.0;
    }

    fn move_by(&mut self, distance: f64) {
        self.x += if self.is_reversed { -distance } else { distance };
    }

    /// Whether a piece that was changed at its end can still be kept to from here.
    pub(crate) fn can_follow(&self, elements: &Ring<PathElement>, limits: &Limits) -> bool {
        let Some(element) = elements.get(self.at) else { return true };
        self.can_reach_end_at(element, exit_speed_sq(elements, element, self.at), limits)
    }

    /// Whether the motion can come to the end of its piece at the square of a speed, or slower.
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

/// The ramp where the acceleration is the same everywhere.
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

/// The acceleration along an arc that what is needed towards its centre leaves of one, at the square of a speed.
#[inline]
fn tangential_acceleration_left(acceleration: f64, circle: &Circle, y: f64) -> f64 {
    math::sqrt((squared(acceleration) - squared(circle.angle_rate * y)).max(0.0))
}

/// What the axes can do on an arc that is bent, over what is planned with.
#[inline]
fn unplanned_ratio(element: &PathElement, less: f64, cycle: f64) -> f64 {
    1.0 / (PLANNED_RATIO - less * element.speed_limit * cycle)
}

fn clamped(acceleration: f64, window: &AccelerationWindow) -> f64 {
    math::max(math::min(acceleration, window.max), window.min)
}

/// The speed that a piece is asked to have where its axes allow so much.
pub(crate) fn target_speed(element: &PathElement, fastest: f64, request: &CycleRequest) -> f64 {
    let axes = if element.is_partly_rapid { fastest * request.rapid } else { fastest };
    match element.feed_basis {
        FeedBasis::Rapid => fastest * request.rapid,
        FeedBasis::PerSecond => math::min(axes, element.feed * request.feed),
        FeedBasis::PerTurn => math::min(axes, element.feed * request.spindle_speed),
    }
}
