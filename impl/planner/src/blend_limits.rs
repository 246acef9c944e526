//! How fast a blend may be entered: each axis limits the entry and the exit speed.
//!
//! On a blend the acceleration of an axis is p'·u + p''·y. It is linear in the parameter where the squared speed y is,
//! so it keeps its limit everywhere if it keeps it at both ends. Each axis thus gives two linear inequalities in the
//! squared entry and exit speeds, and the highest entry is the solution of a linear programme in two variables.

use crate::limits::Limits;
use crate::math;
use crate::parameters::Axes;
use crate::path_element::{BlendLimits, PathElement};

/// The most vertices of the feasible set that are visited before a simpler answer is taken.
const VERTICES_MAX: u32 = 5;
/// An axis whose entry coefficient at an end is below this limits the exit alone.
const ENTRY_COEFFICIENT_MIN: f64 = 1e-12;

/// What the axes allow at both ends of a blend: `|entry_factor * entry + exit_factor * exit| <= limit`.
#[derive(Clone, Copy, Debug)]
struct AxisInequalities<const N: usize> {
    entry_factors: [[f64; N]; 2],
    exit_factors: [[f64; N]; 2],
    limit: [f64; N],
}

/// The highest squared entry speed from which the exit is at most `most.0`, capped at `most.1`. Forward, or backwards
/// from the end of the element.
#[inline]
pub(crate) fn max_entry_speed_sq(
    element: &PathElement,
    forward: bool,
    most: (f64, f64),
    limits: &Limits,
) -> f64 {
    if forward && element.axis_count <= 3 {
        element.blend_limits.max_entry_speed_sq(element, most, limits)
    } else {
        highest_exact(element, forward, most, limits)
    }
}

#[inline(never)]
fn highest_exact(element: &PathElement, forward: bool, most: (f64, f64), limits: &Limits) -> f64 {
    if element.axis_count > 3 {
        AxisInequalities::<9>::new(element, forward, limits)
            .max_entry_speed_sq(element, most, limits)
    } else {
        AxisInequalities::<3>::new(element, forward, limits)
            .max_entry_speed_sq(element, most, limits)
    }
}

/// Walks along the edge of the feasible set from the highest exit down to the highest entry.
#[inline]
fn walk_edge<const N: usize>(blend: &BlendLimits<N>, mut exit: f64) -> Option<f64> {
    for _ in 0..VERTICES_MAX {
        // The entry is at most limit - slope·exit, and at least 0 and -(limit + slope·exit).
        let highs = blend.bounds(|limit, slope| limit - slope * exit);
        let lows = blend.bounds(|limit, slope| limit + slope * exit);
        let high = least(&highs);
        let slope = blend.slope_of(high, &highs);
        let lowest = least(&lows);
        let low = math::max(0.0, -lowest);
        if low > high * (1.0 + 1e-13) {
            let lower = if low > 0.0 { blend.slope_of(lowest, &lows) } else { 0.0 };
            let step = (low - high) / (lower - slope);
            exit += step;
            if !(step < 0.0 && exit >= 0.0) {
                return None;
            }
            continue;
        }
        if slope <= 0.0 || exit <= 0.0 {
            return Some(math::max(high, 0.0));
        }
        // A lower exit allows a higher entry, down to where the next bound crosses.
        let (step, next) = blend.next_crossing(&highs, (high, slope));
        if exit + step <= 0.0 {
            return Some(math::max(high + slope * exit, 0.0));
        }
        exit += step;
        if next <= 0.0 {
            return Some(math::max(high - slope * step, 0.0));
        }
    }
    None
}

impl<const N: usize> AxisInequalities<N> {
    #[inline]
    fn new(element: &PathElement, forward: bool, limits: &Limits) -> Self {
        let (rate, bend) = (leading(&element.tangent), leading(&element.curvature));
        let last = each(&rate, &bend, |rate, bend| rate + element.length * bend);
        let (first, last) =
            if forward { (rate, last) } else { (last.map(|rate| -rate), rate.map(|rate| -rate)) };
        let double = 2.0 * element.length;
        Self {
            entry_factors: [each(&first, &last, |f, l| 2.0 * l - 3.0 * f), last.map(|l| -l)],
            exit_factors: [first, each(&first, &last, |f, l| 3.0 * l - 2.0 * f)],
            limit: leading(&limits.planned).map(|limit| double * limit),
        }
    }

    /// The requested speeds are usually allowed, and this is known without a division.
    #[inline]
    fn max_entry_speed_sq(
        &self,
        element: &PathElement,
        (exit, cap): (f64, f64),
        limits: &Limits,
    ) -> f64 {
        if self.allow(cap, exit) {
            return cap;
        }
        let mut blend = BlendLimits::default();
        self.write_limits(&mut blend);
        blend.highest_on_edge(element, exit, limits)
    }

    /// Whether the axes allow an entry and an exit.
    #[inline]
    fn allow(&self, entry: f64, exit: f64) -> bool {
        self.entry_factors.iter().zip(&self.exit_factors).all(|(entering, leaving)| {
            let used =
                each(entering, leaving, |entering, leaving| entering * entry + leaving * exit);
            used.iter().zip(&self.limit).all(|(used, limit)| used.abs() <= *limit)
        })
    }

    #[inline]
    fn write_limits(&self, bounds: &mut BlendLimits<N>) {
        bounds.exit_max = f64::INFINITY;
        let ends = self.entry_factors.iter().zip(&self.exit_factors);
        for ((entering, leaving), (slopes, limits)) in
            ends.zip(bounds.slopes.iter_mut().zip(&mut bounds.limits))
        {
            let inverse = entering.map(|entering| 1.0 / entering);
            *slopes = each(leaving, &inverse, |leaving, inverse| leaving * inverse);
            *limits = each(&self.limit, &inverse, |limit, inverse| (limit * inverse).abs());
        }
        if self
            .entry_factors
            .as_flattened()
            .iter()
            .any(|entering| entering.abs() < ENTRY_COEFFICIENT_MIN)
        {
            self.separate_exit_limits(bounds);
        }
    }

    /// Moves the inequalities that do not limit the entry into `exit_max`.
    #[inline(never)]
    fn separate_exit_limits(&self, bounds: &mut BlendLimits<N>) {
        let slopes = bounds.slopes.as_flattened_mut().iter_mut();
        let rows = slopes.zip(bounds.limits.as_flattened_mut());
        let ends = self.entry_factors.as_flattened().iter().zip(self.exit_factors.as_flattened());
        for ((row, (entering, leaving)), limit) in rows.zip(ends).zip(self.limit.iter().cycle()) {
            if entering.abs() < ENTRY_COEFFICIENT_MIN {
                let most = limit / math::max(leaving.abs(), ENTRY_COEFFICIENT_MIN);
                bounds.exit_max = math::min(bounds.exit_max, most);
                (*row.0, *row.1) = (0.0, f64::INFINITY);
            }
        }
    }
}

impl BlendLimits<3> {
    /// Computes the limits of a blend of up to three axes, run forward.
    pub(crate) fn compute(element: &mut PathElement, limits: &Limits) {
        let ends = AxisInequalities::new(element, true, limits);
        let bounds = &mut element.blend_limits;
        ends.write_limits(bounds);
        let (mut falls, mut rises, mut limit) = (f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY);
        let rows = bounds.slopes.as_flattened().iter().zip(bounds.limits.as_flattened());
        for (slope, least) in rows {
            (falls, rises) = (math::min(falls, *slope), math::max(rises, *slope));
            limit = math::min(limit, *least);
        }
        bounds.slopes_fall = rises <= 0.0;
        // Whatever the exit, the centres of two inequalities differ by at most the difference of their slopes times
        // the exit.
        bounds.feasible_exit_max = math::min(bounds.exit_max, 2.0 * limit / (rises - falls));
    }

    /// Fast path of [`Self::highest_exact`]: usually the highest exit has the highest entry.
    #[inline]
    fn max_entry_speed_sq(
        &self,
        element: &PathElement,
        (exit, cap): (f64, f64),
        limits: &Limits,
    ) -> f64 {
        if exit <= self.feasible_exit_max {
            // Two at a time, whichever axes and ends they belong to, so that the compiler can use vector instructions.
            let mut high = [cap; 2];
            let (bounds, _) = self.limits.as_flattened().as_chunks::<2>();
            let (slopes, _) = self.slopes.as_flattened().as_chunks::<2>();
            for (limits, slopes) in bounds.iter().zip(slopes) {
                for ((limit, slope), high) in limits.iter().zip(slopes).zip(&mut high) {
                    *high = math::min(*high, limit - slope * exit);
                }
            }
            let [one, other] = high;
            let high = math::min(one, other);
            if self.slopes_fall || high >= cap {
                return high;
            }
        }
        self.highest_exact(element, (exit, cap), limits)
    }

    #[inline(never)]
    fn highest_exact(
        &self,
        element: &PathElement,
        (exit, cap): (f64, f64),
        limits: &Limits,
    ) -> f64 {
        let exit = math::min(exit, self.exit_max);
        let low = least(&self.bounds(|limit, slope| limit + slope * exit));
        let high = least(&self.bounds(|limit, slope| limit - slope * exit));
        let high = math::min(high, cap);
        if -low <= high && (self.slopes_fall || high >= cap) {
            return high;
        }
        self.highest_on_edge(element, exit, limits)
    }
}

impl<const N: usize> BlendLimits<N> {
    #[inline]
    fn highest_on_edge(&self, element: &PathElement, exit: f64, limits: &Limits) -> f64 {
        let exit = math::min(exit, self.exit_max);
        walk_edge(self, exit).unwrap_or_else(|| {
            // The same speed at both ends is always possible if it is low enough.
            let balanced = limits.planned.iter().zip(&element.curvature).take(N);
            balanced.fold(exit, |least, (limit, bend)| math::min(least, limit / bend.abs()))
        })
    }

    #[inline]
    fn bounds(&self, bound: impl Fn(f64, f64) -> f64) -> [[f64; N]; 2] {
        let mut bounds = [[0.0; N]; 2];
        for ((bounds, limits), slopes) in bounds.iter_mut().zip(&self.limits).zip(&self.slopes) {
            *bounds = each(limits, slopes, &bound);
        }
        bounds
    }

    /// The slope of the first inequality whose bound is at most `least`.
    #[inline]
    fn slope_of(&self, least: f64, bounds: &[[f64; N]; 2]) -> f64 {
        let ([here, there], [slopes, slopes_there]) = (bounds, &self.slopes);
        let axes = here.iter().zip(there).zip(slopes.iter().zip(slopes_there));
        for ((here, there), (slope, slope_there)) in axes {
            if *here <= least {
                return *slope;
            }
            if *there <= least {
                return *slope_there;
            }
        }
        0.0
    }

    /// The change of the exit at which another upper bound becomes the lowest, and the slope of that bound.
    fn next_crossing(&self, highs: &[[f64; N]; 2], (high, slope): (f64, f64)) -> (f64, f64) {
        let (mut step, mut next) = (f64::NEG_INFINITY, 0.0);
        let mut look_at = |bound: f64, other: f64| {
            if other < slope {
                let crossing = (bound - high) / (other - slope);
                if crossing > step {
                    (step, next) = (math::min(crossing, 0.0), other);
                }
            }
        };
        let ([here, there], [slopes, slopes_there]) = (highs, &self.slopes);
        let axes = here.iter().zip(there).zip(slopes.iter().zip(slopes_there));
        for ((here, there), (slope, slope_there)) in axes {
            look_at(*here, *slope);
            look_at(*there, *slope_there);
        }
        (step, next)
    }
}

/// The least of some bounds, compared two at a time.
#[inline]
fn least<const N: usize>(bounds: &[[f64; N]; 2]) -> f64 {
    let mut least = [f64::INFINITY; 2];
    for pair in bounds.as_flattened().as_chunks::<2>().0 {
        for (least, bound) in least.iter_mut().zip(pair) {
            *least = math::min(*least, *bound);
        }
    }
    let [one, other] = least;
    math::min(one, other)
}

/// The leading axes.
#[inline]
fn leading<const N: usize>(axes: &Axes) -> [f64; N] {
    let mut leading = [0.0; N];
    for (leading, axis) in leading.iter_mut().zip(axes) {
        *leading = *axis;
    }
    leading
}

/// Combines two numbers of each axis.
#[inline]
fn each<const N: usize>(
    one: &[f64; N],
    other: &[f64; N],
    combined: impl Fn(f64, f64) -> f64,
) -> [f64; N] {
    let mut result = [0.0; N];
    for ((result, one), other) in result.iter_mut().zip(one).zip(other) {
        *result = combined(*one, *other);
    }
    result
}
