//! How fast a piece may be entered so that it, and all after it, can be kept to.
//!
//! With the parameter accelerated by a constant u, the square of its speed y changes evenly along the piece, by 2u per
//! unit. On a bend the acceleration of each axis is p'·u + p''·y, which then runs evenly too: within limits at both ends it is within
//! limits between. All that is within limits makes a convex set that holds rest, so that whatever is slower than a plan can be kept to as well:
//! neither overrides nor holds can trap the machine. (Pham and Pham, time-optimal path parameterisation by reachability.)

use super::limits::Limits;
use super::parameters::Axes;
use super::piece::{Circle, Law, Pace, Piece};
use crate::math;

/// Where z / (1 + z/2 + z²/12) is greatest: the root of 12, or a little less.
const MOST_FAR: f64 = 3.464;
/// The most corners of the set that are looked at before a simpler answer is taken.
const CORNERS: u32 = 8;

/// An axis with less of the entry than this at an end of a bend limits the exit alone.
const FLAT: f64 = 1e-12;

/// Overrides that look-ahead plans for, and turns of the spindle per second times that of the feed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub(super) feed: f64,
    pub(super) rapid: f64,
    pub(super) turns: f64,
}

impl Scale {
    /// The greater of both in everything.
    pub(super) fn most(self, other: Self) -> Self {
        Self {
            feed: math::greater(self.feed, other.feed),
            rapid: math::greater(self.rapid, other.rapid),
            turns: math::greater(self.turns, other.turns),
        }
    }
}

/// The squares of the speeds that a piece is never run beyond where it begins and where it ends.
#[inline]
pub(super) fn caps(piece: &Piece, scale: Scale) -> (f64, f64) {
    let (start, end) = if piece.rapid || piece.pace == Pace::Rapid {
        rapid_caps(piece, scale)
    } else {
        (piece.ceiling, piece.last_ceiling)
    };
    let feed = match piece.pace {
        Pace::Rapid => return (start, end),
        Pace::Second => piece.feed * scale.feed,
        Pace::Turn => piece.feed * scale.turns,
    };
    let feed = feed * feed;
    (math::lesser(start, feed), math::lesser(end, feed))
}

#[cold]
#[inline(never)]
fn rapid_caps(piece: &Piece, scale: Scale) -> (f64, f64) {
    let share = scale.rapid * scale.rapid;
    (piece.ceiling * share, piece.last_ceiling * share)
}

/// The highest y at a piece's start from which y at its end is at most `exit`.
pub(super) fn forward(
    piece: &Piece,
    exit: f64,
    (cap, last_cap): (f64, f64),
    limits: &Limits,
) -> f64 {
    let exit = math::lesser(exit, last_cap);
    let entry = match piece.law {
        Law::Bent { .. } => bent(piece, true, (exit, cap), limits),
        Law::Even { .. } | Law::Round { .. } | Law::Shared { .. } | Law::Dwell(_) => {
            along(piece.law, &piece.circle, exit, piece.length)
        }
    };
    math::lesser(math::lesser(entry, cap), piece.entry)
}

/// The highest y at its end from which, running back, y at its start is at most `exit`.
pub(super) fn backward(
    piece: &Piece,
    exit: f64,
    (first_cap, cap): (f64, f64),
    limits: &Limits,
) -> f64 {
    let exit = math::lesser(exit, first_cap);
    let entry = match piece.law {
        Law::Bent { .. } => bent(piece, false, (exit, cap), limits),
        Law::Even { .. } | Law::Round { .. } | Law::Shared { .. } | Law::Dwell(_) => {
            along(piece.law, &piece.circle, exit, piece.length)
        }
    };
    math::lesser(entry, cap)
}

/// The highest y some way before an exit, where that has a closed form.
pub(super) fn along(law: Law, circle: &Option<Circle>, exit: f64, distance: f64) -> f64 {
    match (law, circle) {
        (Law::Even { acceleration }, _) => exit + 2.0 * acceleration * distance,
        (Law::Round { planned, .. }, Some(circle)) => {
            // dy/dx = -2·√(planned² - (turn·y)²) gives turn·y = planned·sin(angle).
            let angle = 2.0 * circle.turn * distance;
            let share = (circle.turn * exit / planned).min(1.0);
            if angle >= core::f64::consts::FRAC_PI_2 {
                return planned / circle.turn;
            }
            let (sine, cosine) = math::turned(angle);
            let other = math::sqrt((1.0 - share * share).max(0.0));
            // Beyond the quarter turn the sine would fall again.
            if cosine <= share {
                planned / circle.turn
            } else {
                planned / circle.turn * (share * cosine + other * sine)
            }
        }
        (Law::Shared { most, less }, _) => {
            // dy/dx = -2·(most - less·y) gives an exponential. What stands here for 1 - e^-z is never more, and rises no steeper than what is
            // left of its way to 1.
            let far = math::lesser(2.0 * less * distance, MOST_FAR);
            let way = if far < MOST_FAR { distance } else { MOST_FAR / (2.0 * less) };
            let share = 1.0 / (1.0 + far * (0.5 + far * (1.0 / 12.0)));
            exit + 2.0 * (most - less * exit) * way * share
        }
        (Law::Dwell(_) | Law::Round { .. } | Law::Bent { .. }, _) => 0.0,
    }
}

/// What the axes allow at both ends of a bend: |entering·entry + leaving·exit| ≤ limit.
#[derive(Clone, Copy, Debug)]
struct Ends<const N: usize> {
    entering: [[f64; N]; 2],
    leaving: [[f64; N]; 2],
    limit: [f64; N],
}

/// The same as |entry + slope·exit| ≤ limit, which is infinite where an axis does not limit the entry.
#[derive(Clone, Copy, Debug)]
struct Strips<const N: usize> {
    slopes: [[f64; N]; 2],
    limits: [[f64; N]; 2],
}

/// The highest entry on a bend: a linear programme in two variables, walked from the highest exit down.
fn bent(piece: &Piece, forward: bool, most: (f64, f64), limits: &Limits) -> f64 {
    if piece.axes <= 3 {
        bent_over::<3>(piece, forward, most, limits)
    } else {
        bent_over::<9>(piece, forward, most, limits)
    }
}

#[inline]
fn bent_over<const N: usize>(
    piece: &Piece,
    forward: bool,
    (exit, cap): (f64, f64),
    limits: &Limits,
) -> f64 {
    let ends = Ends::<N>::new(piece, forward, limits);
    if ends.allow(cap, exit) {
        return cap;
    }
    let mut strips = ends.strips();
    let exit = if ends.any_flat() { ends.take_out_flat(&mut strips, exit) } else { exit };
    walk(&strips, exit).unwrap_or_else(|| {
        // As fast at the end as at the start is possible, if that is slow enough.
        let balanced = limits.planned.iter().zip(&piece.bend).take(N);
        balanced.fold(exit, |least, (limit, bend)| math::lesser(least, limit / bend.abs()))
    })
}

fn walk<const N: usize>(strips: &Strips<N>, mut exit: f64) -> Option<f64> {
    for _ in 0..CORNERS {
        // The entry is at most limit - slope·exit, and no less than -(limit + slope·exit) and 0.
        let highs = strips.bounds(|limit, slope| limit - slope * exit);
        let lows = strips.bounds(|limit, slope| limit + slope * exit);
        let (high, slope) = strips.tightest(&highs);
        let low = lows.as_flattened().iter().copied().fold(f64::INFINITY, math::lesser);
        let low = math::greater(0.0, -low);
        if low > high * (1.0 + 1e-13) {
            let lower = if low > 0.0 { strips.tightest(&lows).1 } else { 0.0 };
            let step = (low - high) / (lower - slope);
            exit += step;
            if !(step < 0.0 && exit >= 0.0) {
                return None;
            }
            continue;
        }
        if slope <= 0.0 || exit <= 0.0 {
            return Some(math::greater(high, 0.0));
        }
        // A lower exit allows a higher entry, down to where the next bound crosses.
        let (step, next) = strips.next_crossing(&highs, (high, slope));
        if exit + step <= 0.0 {
            return Some(math::greater(high + slope * exit, 0.0));
        }
        exit += step;
        if next <= 0.0 {
            return Some(math::greater(high - slope * step, 0.0));
        }
    }
    None
}

impl<const N: usize> Ends<N> {
    #[inline]
    fn new(piece: &Piece, forward: bool, limits: &Limits) -> Self {
        let (rate, bend) = (leading(&piece.rate), leading(&piece.bend));
        let last = each(&rate, &bend, |rate, bend| rate + piece.length * bend);
        let (first, last) =
            if forward { (rate, last) } else { (last.map(|rate| -rate), rate.map(|rate| -rate)) };
        let double = 2.0 * piece.length;
        Self {
            entering: [each(&first, &last, |f, l| 2.0 * l - 3.0 * f), last.map(|l| -l)],
            leaving: [first, each(&first, &last, |f, l| 3.0 * l - 2.0 * f)],
            limit: leading(&limits.planned).map(|limit| double * limit),
        }
    }

    /// Whether they allow an entry and an exit.
    #[inline]
    fn allow(&self, entry: f64, exit: f64) -> bool {
        self.entering.iter().zip(&self.leaving).all(|(entering, leaving)| {
            let used =
                each(entering, leaving, |entering, leaving| entering * entry + leaving * exit);
            used.iter().zip(&self.limit).all(|(used, limit)| used.abs() <= *limit)
        })
    }

    #[inline]
    fn strips(&self) -> Strips<N> {
        let mut strips = Strips { slopes: self.leaving, limits: [self.limit; 2] };
        let all = self.entering.iter().zip(strips.slopes.iter_mut().zip(&mut strips.limits));
        for (entering, (slopes, limits)) in all {
            let inverse = entering.map(|entering| 1.0 / entering);
            *slopes = each(slopes, &inverse, |leaving, inverse| leaving * inverse);
            *limits = each(limits, &inverse, |limit, inverse| (limit * inverse).abs());
        }
        strips
    }

    /// Whether an axis limits the exit alone.
    #[inline]
    fn any_flat(&self) -> bool {
        self.entering.as_flattened().iter().any(|entering| entering.abs() < FLAT)
    }

    /// Takes out what limits no entry; the exit that it allows.
    #[inline(never)]
    fn take_out_flat(self, strips: &mut Strips<N>, mut exit: f64) -> f64 {
        let slopes = strips.slopes.as_flattened_mut().iter_mut();
        let strips = slopes.zip(strips.limits.as_flattened_mut());
        let ends = self.entering.as_flattened().iter().zip(self.leaving.as_flattened());
        for ((strip, (entering, leaving)), limit) in strips.zip(ends).zip(self.limit.iter().cycle())
        {
            if entering.abs() < FLAT {
                exit = math::lesser(exit, limit / math::greater(leaving.abs(), FLAT));
                (*strip.0, *strip.1) = (0.0, f64::INFINITY);
            }
        }
        exit
    }
}

impl<const N: usize> Strips<N> {
    #[inline]
    fn bounds(&self, bound: impl Fn(f64, f64) -> f64) -> [[f64; N]; 2] {
        let mut bounds = [[0.0; N]; 2];
        for ((bounds, limits), slopes) in bounds.iter_mut().zip(&self.limits).zip(&self.slopes) {
            *bounds = each(limits, slopes, &bound);
        }
        bounds
    }

    /// The least of some bounds, and the slope of the first strip, axis by axis, that has it.
    #[inline]
    fn tightest(&self, bounds: &[[f64; N]; 2]) -> (f64, f64) {
        let least = bounds.as_flattened().iter().copied().fold(f64::INFINITY, math::lesser);
        let ([here, there], [slopes, slopes_there]) = (bounds, &self.slopes);
        let axes = here.iter().zip(there).zip(slopes.iter().zip(slopes_there));
        for ((here, there), (slope, slope_there)) in axes {
            if *here <= least {
                return (least, *slope);
            }
            if *there <= least {
                return (least, *slope_there);
            }
        }
        (least, 0.0)
    }

    /// How far below an exit another upper bound becomes the lowest, and its slope.
    fn next_crossing(&self, highs: &[[f64; N]; 2], (high, slope): (f64, f64)) -> (f64, f64) {
        let (mut step, mut next) = (f64::NEG_INFINITY, 0.0);
        let mut look_at = |bound: f64, other: f64| {
            if other < slope {
                let crossing = (bound - high) / (other - slope);
                if crossing > step {
                    (step, next) = (math::lesser(crossing, 0.0), other);
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
