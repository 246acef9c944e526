//! A cycle of motion on a bend, where each axis is looked at by itself.
//!
//! An acceleration that is kept up to the end of a bend is within the limits of an axis everywhere if it is so at
//! both ends. A motion may do what it likes as long as after each cycle there is such an acceleration that leads to
//! what the next piece allows.

use crate::limits::{Limits, PLANNED_RATIO, squared};
use crate::math;
use crate::motion::{
    AXIS_SHARE_MIN, CYCLE_WORK_MAX, CycleRequest, ElementEnd, LONG_BLEND_CYCLES_MIN, MotionState,
    wanted,
};
use crate::path_element::{AccelerationModel, PathElement};

/// Half of what lies between a limit and what is planned with.
const COASTING_LIMIT_RATIO: f64 = 1.0 + 0.5 * (1.0 - PLANNED_RATIO);
/// And a little less, which is surely below that whatever was rounded.
const COASTING_QUICK_LIMIT_RATIO: f64 = 1.0 + 0.4 * (1.0 - PLANNED_RATIO);
/// How often an acceleration is halved in that leaves another one to be kept up.
const ACCELERATION_TRIALS_MAX: u32 = 3;
/// What that is worth of [`MotionState::effort`].
const TRIALS_WORK: u32 = 4;
/// The share of the square of a speed by which it is worth to be faster, and the same over what is left of a bend.
const SPEED_SQ_GAIN_RATIO_MIN: f64 = 1e-3;
const SPEED_SQ_GAIN_STEP_RATIO: f64 = 0.03;

impl MotionState {
    pub(crate) fn bend<const N: usize>(
        &mut self,
        piece: &PathElement,
        end: ElementEnd,
        (limits, wish): (&Limits, &CycleRequest),
        left: f64,
    ) -> f64 {
        let ElementEnd { exit, remaining, .. } = end;
        let mut most = f64::NEG_INFINITY;
        if !wish.rest {
            let ceiling = if self.backwards { piece.ceiling } else { piece.last_ceiling };
            let eased = ElementEnd { exit: math::lesser(wish.ease * exit, ceiling), ..end };
            let met = (eased.exit - squared(self.speed)) / (2.0 * remaining);
            // Who comes evenly to the exit is below the ceiling all the way, as the exit is; after a change of
            // override that is too late.
            let eases = wish.rapid < 1.0;
            let fastest =
                if eases { self.fastest_within(piece, remaining, left) } else { piece.fastest };
            let asked = (wanted(piece, fastest, wish) - self.speed) / left;
            most = math::lesser(asked, met);
            let both = (most, asked);
            if let Some(even) = self.kept_or_quicker::<N>(piece, eased, both, (limits, wish), left)
            {
                return self.go(piece, even, ElementEnd { open: false, ..end }, left);
            }
        }
        let low = self.least::<N>(piece, remaining, limits);
        let exit = self.opened(piece, end, |far| low > -squared(self.speed) / (2.0 * far));
        let end = ElementEnd { exit, open: false, ..end };
        if let Some(kept) = self.barely::<N>(piece, remaining, (most, low), limits) {
            return self.go(piece, kept, end, left);
        }
        let least = self.least_now::<N>(piece, (remaining, low), limits, left);
        self.go(piece, math::greater(most, least), end, left)
    }

    /// What is easily told of an acceleration: that it can be kept up to the end of a bend, or that more leads to one
    /// that can.
    #[inline]
    pub(crate) fn kept_or_quicker<const N: usize>(
        &mut self,
        piece: &PathElement,
        end: ElementEnd,
        (most, asked): (f64, f64),
        (limits, wish): (&Limits, &CycleRequest),
        left: f64,
    ) -> Option<f64> {
        let even = self.kept_up::<N>(piece, end.remaining, most, limits)?;
        let lasts = LONG_BLEND_CYCLES_MIN * self.speed * limits.cycle < end.remaining;
        if lasts && even < asked && self.effort <= CYCLE_WORK_MAX && self.is_slow(piece) {
            return Some(self.quicker::<N>(piece, end, even, (limits, wish), left));
        }
        Some(even)
    }

    /// An acceleration that can be kept up to the end of a bend, where it is easily told: what is asked for, or less
    /// of it.
    #[inline]
    pub(crate) fn kept_up<const N: usize>(
        &self,
        piece: &PathElement,
        remaining: f64,
        asked: f64,
        limits: &Limits,
    ) -> Option<f64> {
        if asked > 0.0 {
            if !self.may_coast::<N>(piece, limits) {
                return None;
            }
            let most = self.greatest::<N>(piece, remaining, limits);
            return Some(math::greater(math::lesser(asked, most), 0.0));
        }
        self.allows::<N>(piece, remaining, asked, limits).then_some(asked)
    }

    /// An acceleration that can be kept up to the end of a bend, where what is asked for is little; none where it is
    /// less than the least that could be.
    #[inline]
    pub(crate) fn barely<const N: usize>(
        &self,
        piece: &PathElement,
        remaining: f64,
        (asked, low): (f64, f64),
        limits: &Limits,
    ) -> Option<f64> {
        if asked < low {
            return None;
        }
        let high = self.greatest::<N>(piece, remaining, limits);
        Some(math::lesser(asked, math::greater(high, low)))
    }

    /// The least acceleration that all axes allow within this cycle. That may be more than can be kept up to the end
    /// of the piece, and the more, the less far it leads.
    #[inline(never)]
    fn least_now<const N: usize>(
        &self,
        piece: &PathElement,
        (remaining, mut least): (f64, f64),
        limits: &Limits,
        left: f64,
    ) -> f64 {
        let times = if self.effort < CYCLE_WORK_MAX - 1 { 2 } else { 1 };
        for _ in 0..times {
            let last = math::greater(0.0, self.speed + least * left);
            let way = 0.5 * (self.speed + last) * left;
            if way >= remaining {
                break;
            }
            let now = self.least::<N>(piece, way, limits);
            least = math::lesser(now, least);
        }
        least
    }

    /// The highest speed that the axes allow so far ahead.
    fn fastest(&self, piece: &PathElement, ahead: f64) -> f64 {
        let rise = piece.last_ceiling - piece.ceiling;
        if rise.abs() <= 0.0 {
            return piece.fastest;
        }
        let x = if self.backwards { self.x - ahead } else { self.x + ahead };
        math::sqrt(piece.ceiling + rise * x / piece.length)
    }

    /// The highest speed that the axes allow here and at the end of the cycle.
    #[cold]
    #[inline(never)]
    fn fastest_within(&self, piece: &PathElement, remaining: f64, left: f64) -> f64 {
        let near = math::lesser(self.speed * left, remaining);
        math::lesser(self.fastest(piece, 0.0), self.fastest(piece, near))
    }

    /// Whether the motion is so much slower than a bend may be passed evenly that it is worth to be faster: mostly it
    /// is not.
    #[inline]
    fn is_slow(&self, piece: &PathElement) -> bool {
        let AccelerationModel::Blend { even: most } = piece.law else { return false };
        most - squared(self.speed) > SPEED_SQ_GAIN_RATIO_MIN * most
    }

    /// On a bend that lasts for some cycles, more than the acceleration that can be kept up to its end: as much as is
    /// asked for, if another one can be kept up then.
    #[inline(never)]
    fn quicker<const N: usize>(
        &mut self,
        piece: &PathElement,
        end: ElementEnd,
        even: f64,
        (limits, wish): (&Limits, &CycleRequest),
        left: f64,
    ) -> f64 {
        let AccelerationModel::Blend { even: most } = piece.law else { return even };
        if even < 0.0 && self.speed + even * left <= 0.0 {
            return even;
        }
        let near = math::lesser(self.speed * left, end.remaining);
        let wanted = wanted(piece, self.fastest(piece, near), wish);
        let asked = (math::lesser(wanted, math::sqrt(most)) - self.speed) / left;
        // Mostly the motion is as fast as it may be.
        let more = even + SPEED_SQ_GAIN_STEP_RATIO * squared(self.speed) / end.remaining;
        let with = (limits, wish);
        if even >= asked || !self.leads::<N>(piece, end, math::lesser(asked, more), with, left) {
            return even;
        }
        self.effort = self.effort.saturating_add(TRIALS_WORK);
        let near = math::lesser(1.5 * near, end.remaining);
        let mut high = math::lesser(asked, self.greatest::<N>(piece, near, limits));
        let mut low = even;
        let mut tried = high;
        for _ in 0..ACCELERATION_TRIALS_MAX {
            if tried <= low {
                break;
            }
            let way = self.travel_with(tried, left);
            let allowed = way <= near || self.allows::<N>(piece, way, tried, limits);
            if allowed && self.leads::<N>(piece, end, tried, with, left) {
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

    /// How far an acceleration leads in a time.
    #[inline]
    fn travel_with(&self, acceleration: f64, time: f64) -> f64 {
        (self.speed + 0.5 * acceleration * time) * time
    }

    /// Whether after a cycle with an acceleration another one can be kept up to the end of a bend.
    fn leads<const N: usize>(
        &self,
        piece: &PathElement,
        ElementEnd { exit, remaining, .. }: ElementEnd,
        acceleration: f64,
        (limits, wish): (&Limits, &CycleRequest),
        left: f64,
    ) -> bool {
        let way = self.travel_with(acceleration, left);
        if way >= remaining {
            return false;
        }
        let speed = self.speed + acceleration * left;
        if speed > wanted(piece, self.fastest(piece, way), wish) {
            return false;
        }
        let y = squared(speed);
        let (sense, last) = if self.backwards { (-1.0, 0.0) } else { (1.0, piece.length) };
        let x = self.x + sense * way;
        let along = if y > exit { sense * (exit - y) / (2.0 * (remaining - way)) } else { 0.0 };
        let exit = math::lesser(exit, y);
        let mut used = [0.0; N];
        for (used, (rate, bend)) in used.iter_mut().zip(piece.rate.iter().zip(&piece.bend)) {
            let next = along * (rate + x * bend) + bend * y;
            let then = along * (rate + last * bend) + bend * exit;
            *used = math::greater(next.abs(), then.abs());
        }
        used.iter().zip(&limits.planned).all(|(used, limit)| used <= limit)
    }

    /// Whether all axes allow an acceleration up to the end of a bend: what is asked for mostly is.
    #[inline]
    fn allows<const N: usize>(
        &self,
        piece: &PathElement,
        remaining: f64,
        acceleration: f64,
        limits: &Limits,
    ) -> bool {
        let y = squared(self.speed);
        let later = 3.0 * remaining * acceleration;
        let along = if self.backwards { -acceleration } else { acceleration };
        let mut used = [0.0; N];
        for (used, (rate, bend)) in used.iter_mut().zip(piece.rate.iter().zip(&piece.bend)) {
            let here = along * (rate + self.x * bend) + bend * y;
            *used = math::greater(here.abs(), (here + later * bend).abs());
        }
        used.iter().zip(&limits.planned).all(|(used, limit)| used <= limit)
    }

    /// Whether all axes allow the motion to go on without acceleration. Mostly its speed alone tells.
    #[inline]
    fn may_coast<const N: usize>(&self, piece: &PathElement, limits: &Limits) -> bool {
        let AccelerationModel::Blend { even } = piece.law else { return false };
        squared(self.speed) <= COASTING_QUICK_LIMIT_RATIO * even || self.coasts::<N>(piece, limits)
    }

    #[cold]
    #[inline(never)]
    fn coasts<const N: usize>(&self, piece: &PathElement, limits: &Limits) -> bool {
        let y = squared(self.speed);
        let mut axes = piece.bend.iter().zip(&limits.planned).take(N);
        axes.all(|(bend, limit)| (bend * y).abs() <= COASTING_LIMIT_RATIO * limit)
    }

    /// The greatest acceleration that is planned with up to the end of a bend.
    pub(crate) fn greatest_on(&self, piece: &PathElement, remaining: f64, limits: &Limits) -> f64 {
        if piece.axes <= 3 {
            self.greatest::<3>(piece, remaining, limits)
        } else {
            self.greatest::<9>(piece, remaining, limits)
        }
    }

    /// The least acceleration that all axes allow up to the end of a bend.
    pub(crate) fn least_on(&self, piece: &PathElement, remaining: f64, limits: &Limits) -> f64 {
        if piece.axes <= 3 {
            self.least::<3>(piece, remaining, limits)
        } else {
            self.least::<9>(piece, remaining, limits)
        }
    }

    /// The same for so many leading axes.
    fn greatest<const N: usize>(
        &self,
        piece: &PathElement,
        remaining: f64,
        limits: &Limits,
    ) -> f64 {
        let (y, thrice) = (squared(self.speed), 3.0 * remaining);
        let sense = if self.backwards { -1.0 } else { 1.0 };
        let mut greatest = [0.0; N];
        let axes = piece.rate.iter().zip(&piece.bend).zip(&limits.planned);
        for (greatest, ((rate, bend), limit)) in greatest.iter_mut().zip(axes) {
            let across = bend * y;
            let here = sense * (rate + self.x * bend);
            let most = |share: f64| {
                // Towards the greater acceleration an axis has what p''·y leaves it.
                (limit - signed(across, share)) / math::greater(share.abs(), AXIS_SHARE_MIN)
            };
            *greatest = math::lesser(most(here), most(here + thrice * bend));
        }
        greatest.into_iter().fold(f64::INFINITY, math::lesser)
    }

    /// The least acceleration that all axes allow on a bend from here to so far ahead. It is a little below what is
    /// planned with, so that a speed that rounding has made too high comes down again.
    pub(crate) fn least<const N: usize>(
        &self,
        piece: &PathElement,
        ahead: f64,
        limits: &Limits,
    ) -> f64 {
        let (y, thrice) = (squared(self.speed), 3.0 * ahead);
        let sense = if self.backwards { -1.0 } else { 1.0 };
        let mut least = [0.0; N];
        let axes = piece.rate.iter().zip(&piece.bend).zip(&limits.acceleration);
        for (least, ((rate, bend), limit)) in least.iter_mut().zip(axes) {
            let across = bend * y;
            let here = sense * (rate + self.x * bend);
            let low = |share: f64| {
                (-limit - signed(across, share)) / math::greater(share.abs(), AXIS_SHARE_MIN)
            };
            *least = math::greater(low(here), low(here + thrice * bend));
        }
        least.into_iter().fold(f64::NEG_INFINITY, math::greater)
    }
}

/// A number, with the other sign where a second one is negative.
#[inline]
pub(crate) fn signed(number: f64, sign: f64) -> f64 {
    f64::from_bits(number.to_bits() ^ (sign.to_bits() & (-0.0_f64).to_bits()))
}
