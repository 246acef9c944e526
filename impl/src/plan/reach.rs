//! How fast a piece may be entered so that it, and all after it, can be kept to.
//!
//! With the parameter accelerated by a constant u, the square of its speed y changes evenly along the piece, by 2u per
//! unit. On a bend the acceleration of each axis is p'·u + p''·y, which then runs evenly too: within limits at both ends it is within
//! limits between. All that is within limits makes a convex set that holds rest, so that whatever is slower than a plan can be kept to as well:
//! neither overrides nor holds can trap the machine. (Pham and Pham, time-optimal path parameterisation by reachability.)

use super::limits::Limits;
use super::parameters::Axes;
use super::piece::{Circle, Law, Piece};
use crate::math;

/// Where z / (1 + z/2 + z²/12) is greatest: the root of 12, or a little less.
const MOST_FAR: f64 = 3.464;
/// The most corners of the set that are looked at before a simpler answer is taken.
const CORNERS: u32 = 8;

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
    use super::piece::Pace;
    let (mut start, mut end) = (piece.ceiling, piece.last_ceiling);
    if piece.rapid || piece.pace == Pace::Rapid {
        let share = scale.rapid * scale.rapid;
        (start, end) = (start * share, end * share);
    }
    let feed = match piece.pace {
        Pace::Rapid => return (start, end),
        Pace::Second => piece.feed * scale.feed,
        Pace::Turn => piece.feed * scale.turns,
    };
    let feed = feed * feed;
    (math::lesser(start, feed), math::lesser(end, feed))
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
        Law::Bent { .. } => bent(piece, (&piece.rate, &last(piece)), (exit, cap), limits),
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
        Law::Bent { .. } => {
            let (first, last) = (last(piece).map(|rate| -rate), piece.rate.map(|rate| -rate));
            bent(piece, (&first, &last), (exit, cap), limits)
        }
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

fn last(piece: &Piece) -> Axes {
    let mut last = piece.rate;
    for (rate, bend) in last.iter_mut().zip(&piece.bend).take(piece.axes) {
        *rate += piece.length * bend;
    }
    last
}

/// A bound of the entry y: a line over the exit y.
#[derive(Clone, Copy, Debug)]
struct Edge {
    value: f64,
    slope: f64,
}

/// What an axis allows at one end of a bend: |entry + slope·exit| ≤ limit; or |exit| ≤ limit, where `slope` is infinite.
#[derive(Clone, Copy, Debug)]
struct Strip {
    slope: f64,
    limit: f64,
}

const NONE: Strip = Strip { slope: 0.0, limit: f64::INFINITY };

impl Strip {
    /// |entering·entry + leaving·exit| ≤ limit.
    fn new(entering: f64, leaving: f64, limit: f64) -> Self {
        if entering.abs() < 1e-12 {
            let limit = limit / math::greater(leaving.abs(), 1e-12);
            return Self { slope: f64::INFINITY, limit };
        }
        let inverse = 1.0 / entering;
        Self { slope: leaving * inverse, limit: (limit * inverse).abs() }
    }

    fn high(&self, exit: f64) -> Edge {
        Edge { value: self.limit - self.slope * exit, slope: -self.slope }
    }

    fn low(&self, exit: f64) -> Edge {
        Edge { value: -self.limit - self.slope * exit, slope: -self.slope }
    }
}

/// Whether an axis allows an entry and an exit.
fn allows((first, last): (f64, f64), (entry, exit): (f64, f64), limit: f64) -> bool {
    let start = (2.0 * last - 3.0 * first) * entry + first * exit;
    let end = (3.0 * last - 2.0 * first) * exit - last * entry;
    start.abs() <= limit && end.abs() <= limit
}

/// The highest entry on a bend: a linear programme in two variables, walked from the highest exit down.
fn bent(piece: &Piece, ends: (&Axes, &Axes), most: (f64, f64), limits: &Limits) -> f64 {
    if piece.axes <= 3 {
        bent_over::<3>(piece, ends, most, limits)
    } else {
        bent_over::<9>(piece, ends, most, limits)
    }
}

fn bent_over<const N: usize>(
    piece: &Piece,
    (first, last): (&Axes, &Axes),
    (mut exit, cap): (f64, f64),
    limits: &Limits,
) -> f64 {
    let mut strips = [[NONE; 2]; N];
    let double = 2.0 * piece.length;
    let ends = first.iter().zip(last).zip(&limits.planned);
    if ends
        .clone()
        .take(N)
        .all(|((first, last), limit)| allows((*first, *last), (cap, exit), double * limit))
    {
        return cap;
    }
    let mut free = strips.as_flattened_mut().iter_mut();
    for ((first, last), limit) in ends.take(N) {
        let limit = double * limit;
        for strip in [
            Strip::new(2.0 * last - 3.0 * first, *first, limit),
            Strip::new(-last, 3.0 * last - 2.0 * first, limit),
        ] {
            if strip.slope.is_infinite() {
                exit = math::lesser(exit, strip.limit);
            } else if let Some(place) = free.next() {
                *place = strip;
            }
        }
    }
    let unused = free.len();
    let strips = strips.as_flattened();
    let strips = strips.get(..strips.len().saturating_sub(unused)).unwrap_or_default();
    walk(strips, exit).unwrap_or_else(|| {
        // As fast at the end as at the start is possible, if that is slow enough.
        let balanced = limits.planned.iter().zip(&piece.bend).take(N);
        balanced.fold(exit, |least, (limit, bend)| math::lesser(least, limit / bend.abs()))
    })
}

fn walk(strips: &[Strip], mut exit: f64) -> Option<f64> {
    for _ in 0..CORNERS {
        let (high, low) = tightest(strips, exit);
        if low.value > high.value * (1.0 + 1e-13) {
            let step = (low.value - high.value) / (high.slope - low.slope);
            exit += step;
            if !(step < 0.0 && exit >= 0.0) {
                return None;
            }
            continue;
        }
        if high.slope >= 0.0 || exit <= 0.0 {
            return Some(math::greater(high.value, 0.0));
        }
        // A lower exit allows a higher entry, down to where the next bound crosses.
        let (step, slope) = next_crossing(strips, exit, high);
        if exit + step <= 0.0 {
            return Some(math::greater(high.value - high.slope * exit, 0.0));
        }
        exit += step;
        if slope >= 0.0 {
            return Some(math::greater(high.value + high.slope * step, 0.0));
        }
    }
    None
}

/// The lowest upper and the highest lower bound of the entry at an exit.
fn tightest(strips: &[Strip], exit: f64) -> (Edge, Edge) {
    let mut high = Edge { value: f64::INFINITY, slope: 0.0 };
    let mut low = Edge { value: 0.0, slope: 0.0 };
    for strip in strips {
        let (upper, lower) = (strip.high(exit), strip.low(exit));
        if upper.value < high.value {
            high = upper;
        }
        if lower.value > low.value {
            low = lower;
        }
    }
    (high, low)
}

/// How far below an exit another upper bound becomes the lowest, and its slope.
fn next_crossing(strips: &[Strip], exit: f64, active: Edge) -> (f64, f64) {
    let (mut step, mut slope) = (f64::NEG_INFINITY, 0.0);
    for upper in strips.iter().map(|strip| strip.high(exit)) {
        if upper.slope > active.slope {
            let crossing = (upper.value - active.value) / (active.slope - upper.slope);
            if crossing > step {
                step = math::lesser(crossing, 0.0);
                slope = upper.slope;
            }
        }
    }
    (step, slope)
}
