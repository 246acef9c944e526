//! A part of a cycle on a blend, where each axis is checked by itself.
//!
//! An acceleration that is kept up to the end of a blend keeps the limit of an axis everywhere if it does so at both
//! ends: such an acceleration is called sustainable. The motion may use any acceleration after which a sustainable one
//! exists that leads to the entry speed of the next element.

use crate::limits::{Limits, PLANNED_RATIO, squared};
use crate::math;
use crate::motion::{
    AXIS_SHARE_MIN, CYCLE_WORK_MAX, CycleRequest, ElementEnd, LONG_BLEND_CYCLES_MIN, MotionState,
    target_speed,
};
use crate::path_element::{AccelerationModel, PathElement};

/// Half of the gap between the planned limit and the real one.
const COASTING_LIMIT_RATIO: f64 = 1.0 + 0.5 * (1.0 - PLANNED_RATIO);
/// A little less, which is below the real limit whatever rounding did.
const COASTING_QUICK_LIMIT_RATIO: f64 = 1.0 + 0.4 * (1.0 - PLANNED_RATIO);
/// How many accelerations are tried when the fastest one is searched by bisection.
const ACCELERATION_TRIALS_MAX: u32 = 3;
/// The cost of these trials, in units of [`MotionState::work`].
const TRIALS_WORK: u32 = 4;
/// The least relative gain of the squared speed for which the search is worth its cost, and the step of that search
/// over the rest of the blend.
const SPEED_SQ_GAIN_RATIO_MIN: f64 = 1e-3;
const SPEED_SQ_GAIN_STEP_RATIO: f64 = 0.03;

impl MotionState {
    pub(crate) fn advance_on_blend<const N: usize>(
        &mut self,
        element: &PathElement,
        end: ElementEnd,
        (limits, request): (&Limits, &CycleRequest),
        time_left: f64,
    ) -> f64 {
        let ElementEnd { speed_sq: exit, remaining, .. } = end;
        let mut most = f64::NEG_INFINITY;
        if !request.must_stop {
            let ceiling =
                if self.is_reversed { element.start_limit_sq } else { element.end_limit_sq };
            let scaled_end =
                ElementEnd { speed_sq: math::min(request.speed_sq_factor * exit, ceiling), ..end };
            let met = (scaled_end.speed_sq - squared(self.speed)) / (2.0 * remaining);
            // A motion that reaches the exit with a constant acceleration stays below the speed limit, as the exit
            // does. After a change of the override this is no longer certain.
            let is_rapid_overridden = request.rapid < 1.0;
            let fastest = if is_rapid_overridden {
                self.speed_limit_within_cycle(element, remaining, time_left)
            } else {
                element.speed_limit
            };
            let requested = (target_speed(element, fastest, request) - self.speed) / time_left;
            most = math::min(requested, met);
            let both = (most, requested);
            if let Some(sustained) = self.sustainable_or_faster::<N>(
                element,
                scaled_end,
                both,
                (limits, request),
                time_left,
            ) {
                return self.accelerate(
                    element,
                    sustained,
                    ElementEnd { is_open: false, ..end },
                    time_left,
                );
            }
        }
        let low = self.min_acceleration_of::<N>(element, remaining, limits);
        let exit = self
            .exit_after_late_override(element, end, |far| low > -squared(self.speed) / (2.0 * far));
        let end = ElementEnd { speed_sq: exit, is_open: false, ..end };
        if let Some(kept) = self.near_limit::<N>(element, remaining, (most, low), limits) {
            return self.accelerate(element, kept, end, time_left);
        }
        let least = self.min_within_cycle::<N>(element, (remaining, low), limits, time_left);
        self.accelerate(element, math::max(most, least), end, time_left)
    }

    /// An acceleration that is quickly found: a sustainable one, or on a long blend a greater one after which another
    /// is sustainable.
    #[inline]
    pub(crate) fn sustainable_or_faster<const N: usize>(
        &mut self,
        element: &PathElement,
        end: ElementEnd,
        (most, requested): (f64, f64),
        (limits, request): (&Limits, &CycleRequest),
        time_left: f64,
    ) -> Option<f64> {
        let sustained = self.sustainable::<N>(element, end.remaining, most, limits)?;
        let lasts = LONG_BLEND_CYCLES_MIN * self.speed * limits.cycle < end.remaining;
        if lasts
            && sustained < requested
            && self.work <= CYCLE_WORK_MAX
            && self.gains_by_speed(element)
        {
            return Some(self.faster::<N>(element, end, sustained, (limits, request), time_left));
        }
        Some(sustained)
    }

    /// A sustainable acceleration where it is quickly found: the requested one or less.
    #[inline]
    pub(crate) fn sustainable<const N: usize>(
        &self,
        element: &PathElement,
        remaining: f64,
        requested: f64,
        limits: &Limits,
    ) -> Option<f64> {
        if requested > 0.0 {
            if !self.may_coast::<N>(element, limits) {
                return None;
            }
            let most = self.max_acceleration_of::<N>(element, remaining, limits);
            return Some(math::max(math::min(requested, most), 0.0));
        }
        self.is_allowed::<N>(element, remaining, requested, limits).then_some(requested)
    }

    /// A sustainable acceleration where the request is close to the limit; `None` where it is below the least one.
    #[inline]
    pub(crate) fn near_limit<const N: usize>(
        &self,
        element: &PathElement,
        remaining: f64,
        (requested, low): (f64, f64),
        limits: &Limits,
    ) -> Option<f64> {
        if requested < low {
            return None;
        }
        let high = self.max_acceleration_of::<N>(element, remaining, limits);
        Some(math::min(requested, math::max(high, low)))
    }

    /// The least acceleration that all axes allow within this cycle. It may be more than the sustainable one.
    #[inline(never)]
    fn min_within_cycle<const N: usize>(
        &self,
        element: &PathElement,
        (remaining, mut least): (f64, f64),
        limits: &Limits,
        time_left: f64,
    ) -> f64 {
        let times = if self.work < CYCLE_WORK_MAX - 1 { 2 } else { 1 };
        for _ in 0..times {
            let last = math::max(0.0, self.speed + least * time_left);
            let way = 0.5 * (self.speed + last) * time_left;
            if way >= remaining {
                break;
            }
            let now = self.min_acceleration_of::<N>(element, way, limits);
            least = math::min(now, least);
        }
        least
    }

    /// The highest speed that the axes allow at a distance ahead.
    fn speed_limit_ahead(&self, element: &PathElement, ahead: f64) -> f64 {
        let rise = element.end_limit_sq - element.start_limit_sq;
        if rise.abs() <= 0.0 {
            return element.speed_limit;
        }
        let x = if self.is_reversed { self.x - ahead } else { self.x + ahead };
        math::sqrt(element.start_limit_sq + rise * x / element.length)
    }

    /// The highest speed that the axes allow here and at the end of the cycle.
    #[cold]
    #[inline(never)]
    fn speed_limit_within_cycle(
        &self,
        element: &PathElement,
        remaining: f64,
        time_left: f64,
    ) -> f64 {
        let near = math::min(self.speed * time_left, remaining);
        math::min(self.speed_limit_ahead(element, 0.0), self.speed_limit_ahead(element, near))
    }

    /// Whether the motion is so much slower than the steady speed of the blend that a search for more is worth it.
    #[inline]
    fn gains_by_speed(&self, element: &PathElement) -> bool {
        let AccelerationModel::Blend { steady_speed_sq } = element.model else {
            return false;
        };
        steady_speed_sq - squared(self.speed) > SPEED_SQ_GAIN_RATIO_MIN * steady_speed_sq
    }

    /// On a blend that takes several cycles: an acceleration above the sustainable one, up to the request, after which
    /// another one is sustainable.
    #[inline(never)]
    fn faster<const N: usize>(
        &mut self,
        element: &PathElement,
        end: ElementEnd,
        sustained: f64,
        (limits, request): (&Limits, &CycleRequest),
        time_left: f64,
    ) -> f64 {
        let AccelerationModel::Blend { steady_speed_sq } = element.model else { return sustained };
        if sustained < 0.0 && self.speed + sustained * time_left <= 0.0 {
            return sustained;
        }
        let near = math::min(self.speed * time_left, end.remaining);
        let target = target_speed(element, self.speed_limit_ahead(element, near), request);
        let requested = (math::min(target, math::sqrt(steady_speed_sq)) - self.speed) / time_left;
        // Usually the motion is as fast as allowed already.
        let more = sustained + SPEED_SQ_GAIN_STEP_RATIO * squared(self.speed) / end.remaining;
        let with = (limits, request);
        if sustained >= requested
            || !self.leaves_sustainable::<N>(
                element,
                end,
                math::min(requested, more),
                with,
                time_left,
            )
        {
            return sustained;
        }
        self.work = self.work.saturating_add(TRIALS_WORK);
        let near = math::min(1.5 * near, end.remaining);
        let mut high = math::min(requested, self.max_acceleration_of::<N>(element, near, limits));
        let mut low = sustained;
        let mut tried = high;
        for _ in 0..ACCELERATION_TRIALS_MAX {
            if tried <= low {
                break;
            }
            let way = self.distance_after(tried, time_left);
            let allowed = way <= near || self.is_allowed::<N>(element, way, tried, limits);
            if allowed && self.leaves_sustainable::<N>(element, end, tried, with, time_left) {
                if tried >= high {
                    return tried;
                }
                low = tried;
            } else {
                high = tried;
            }
            tried = 0.5 * (low + high);
        }
        low
    }

    /// The distance that an acceleration covers in a time.
    #[inline]
    fn distance_after(&self, acceleration: f64, time: f64) -> f64 {
        (self.speed + 0.5 * acceleration * time) * time
    }

    /// Whether after a cycle with this acceleration a sustainable one exists.
    fn leaves_sustainable<const N: usize>(
        &self,
        element: &PathElement,
        ElementEnd { speed_sq: exit, remaining, .. }: ElementEnd,
        acceleration: f64,
        (limits, request): (&Limits, &CycleRequest),
        time_left: f64,
    ) -> bool {
        let way = self.distance_after(acceleration, time_left);
        if way >= remaining {
            return false;
        }
        let speed = self.speed + acceleration * time_left;
        if speed > target_speed(element, self.speed_limit_ahead(element, way), request) {
            return false;
        }
        let y = squared(speed);
        let (sense, last) = if self.is_reversed { (-1.0, 0.0) } else { (1.0, element.length) };
        let x = self.x + sense * way;
        let along = if y > exit { sense * (exit - y) / (2.0 * (remaining - way)) } else { 0.0 };
        let exit = math::min(exit, y);
        let mut used = [0.0; N];
        for (used, (rate, bend)) in
            used.iter_mut().zip(element.tangent.iter().zip(&element.curvature))
        {
            let next = along * (rate + x * bend) + bend * y;
            let then = along * (rate + last * bend) + bend * exit;
            *used = math::max(next.abs(), then.abs());
        }
        used.iter().zip(&limits.planned).all(|(used, limit)| used <= limit)
    }

    /// Whether all axes allow an acceleration up to a distance ahead.
    #[inline]
    fn is_allowed<const N: usize>(
        &self,
        element: &PathElement,
        remaining: f64,
        acceleration: f64,
        limits: &Limits,
    ) -> bool {
        let y = squared(self.speed);
        let later = 3.0 * remaining * acceleration;
        let along = if self.is_reversed { -acceleration } else { acceleration };
        let mut used = [0.0; N];
        for (used, (rate, bend)) in
            used.iter_mut().zip(element.tangent.iter().zip(&element.curvature))
        {
            let here = along * (rate + self.x * bend) + bend * y;
            *used = math::max(here.abs(), (here + later * bend).abs());
        }
        used.iter().zip(&limits.planned).all(|(used, limit)| used <= limit)
    }

    /// Whether all axes allow the motion to go on without acceleration. Usually the speed alone decides.
    #[inline]
    fn may_coast<const N: usize>(&self, element: &PathElement, limits: &Limits) -> bool {
        let AccelerationModel::Blend { steady_speed_sq } = element.model else {
            return false;
        };
        squared(self.speed) <= COASTING_QUICK_LIMIT_RATIO * steady_speed_sq
            || self.may_coast_exactly::<N>(element, limits)
    }

    #[cold]
    #[inline(never)]
    fn may_coast_exactly<const N: usize>(&self, element: &PathElement, limits: &Limits) -> bool {
        let y = squared(self.speed);
        let mut axes = element.curvature.iter().zip(&limits.planned).take(N);
        axes.all(|(bend, limit)| (bend * y).abs() <= COASTING_LIMIT_RATIO * limit)
    }

    /// The greatest planned acceleration up to a distance ahead.
    pub(crate) fn max_acceleration(
        &self,
        element: &PathElement,
        remaining: f64,
        limits: &Limits,
    ) -> f64 {
        if element.axis_count <= 3 {
            self.max_acceleration_of::<3>(element, remaining, limits)
        } else {
            self.max_acceleration_of::<9>(element, remaining, limits)
        }
    }

    /// The least acceleration that all axes allow up to a distance ahead.
    pub(crate) fn min_acceleration(
        &self,
        element: &PathElement,
        remaining: f64,
        limits: &Limits,
    ) -> f64 {
        if element.axis_count <= 3 {
            self.min_acceleration_of::<3>(element, remaining, limits)
        } else {
            self.min_acceleration_of::<9>(element, remaining, limits)
        }
    }

    /// Does the same for N leading axes.
    fn max_acceleration_of<const N: usize>(
        &self,
        element: &PathElement,
        remaining: f64,
        limits: &Limits,
    ) -> f64 {
        let (y, thrice) = (squared(self.speed), 3.0 * remaining);
        let sense = if self.is_reversed { -1.0 } else { 1.0 };
        let mut greatest = [0.0; N];
        let axes = element.tangent.iter().zip(&element.curvature).zip(&limits.planned);
        for (greatest, ((rate, bend), limit)) in greatest.iter_mut().zip(axes) {
            let across = bend * y;
            let here = sense * (rate + self.x * bend);
            let most = |share: f64| {
                // For a greater acceleration an axis has what p''·y leaves of its limit.
                (limit - signed(across, share)) / math::max(share.abs(), AXIS_SHARE_MIN)
            };
            *greatest = math::min(most(here), most(here + thrice * bend));
        }
        greatest.into_iter().fold(f64::INFINITY, math::min)
    }

    /// The least acceleration that all axes allow from here to a distance ahead. It uses the real limits, a little
    /// below the planned ones, so that a speed that rounding made too high comes down again.
    pub(crate) fn min_acceleration_of<const N: usize>(
        &self,
        element: &PathElement,
        ahead: f64,
        limits: &Limits,
    ) -> f64 {
        let (y, thrice) = (squared(self.speed), 3.0 * ahead);
        let sense = if self.is_reversed { -1.0 } else { 1.0 };
        let mut least = [0.0; N];
        let axes = element.tangent.iter().zip(&element.curvature).zip(&limits.acceleration);
        for (least, ((rate, bend), limit)) in least.iter_mut().zip(axes) {
            let across = bend * y;
            let here = sense * (rate + self.x * bend);
            let low = |share: f64| {
                (-limit - signed(across, share)) / math::max(share.abs(), AXIS_SHARE_MIN)
            };
            *least = math::max(low(here), low(here + thrice * bend));
        }
        least.into_iter().fold(f64::NEG_INFINITY, math::max)
    }
}

/// A number, negated where `sign` is negative.
#[inline]
pub(crate) fn signed(number: f64, sign: f64) -> f64 {
    f64::from_bits(number.to_bits() ^ (sign.to_bits() & (-0.0_f64).to_bits()))
}
