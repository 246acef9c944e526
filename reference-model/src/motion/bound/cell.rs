//! A short part of a curve, and what the limits allow on it.
//!
//! Along a curve p(τ) a motion is y = τ̇² over τ, and u = τ̈, with dy/dτ = 2u. The limits are |p'|²y ≤ v² and
//! |p'u + p''y| ≤ a, axis by axis. On a cell of width w about its middle m they are replaced twice by constraints on the
//! value of y where the cell starts and on one u: once by weaker ones, which every lawful motion meets in the mean
//! over the cell, and once by stronger ones, which imply the limits at each of its points for a steady u. With Mₖ the
//! k-th derivative in the middle, Bₖ a bound of it on the whole curve, U a bound of |u| and Y one of y on the cell:
//!
//! * the mean of p'u + p''y is M₁ū + M₂(y₀ + wū) up to |M₂|Uw/4 + w²(B₃U/8 + |M₃|U/6 + B₄Y/24): what is linear in
//!   τ - m contributes -M₂/w·∫(τ - m)u, by parts;
//! * at a point it is M₁u + M₂(y₀ + wu) up to |u|(3|M₂|w/2 + 5B₃w²/8) + |M₃|(y₀ + wu)w/2 + B₄Yw²/8.

use super::smooth::Smooth;
use crate::math::square_root;
use crate::motion::envelope::Envelope;
use crate::motion::vector::{AxisVector, length};

/// What an axis demands of u and of y where the cell starts: |slope·u + bend·y| + stiff·|u| + twist·(y + w·u) ≤ limit.
#[derive(Clone, Copy, Debug)]
struct Demand {
    slope: f64,
    bend: f64,
    stiff: f64,
    twist: f64,
    limit: f64,
}

/// Which way constraints are replaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// By weaker ones: times become lower bounds.
    Outer,
    /// By stronger ones: times can be achieved.
    Inner,
}

/// A part of a curve.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    /// Its width in the curve's parameter.
    pub(super) width: f64,
    /// The highest y on it.
    pub(super) highest: f64,
    /// A bound of |u| on it.
    pub(super) steepest: f64,
    /// Whether nothing bends on it: its constraints are the limits themselves.
    pub(super) straight: bool,
    /// |p'| where it starts and where it ends.
    pub(super) scales: (f64, f64),
    demands: Vec<Demand>,
}

impl Cell {
    /// The part of a curve from a parameter on. `feed` is the highest speed in the coordinates that a feed counts.
    pub(super) fn of(
        curve: &dyn Smooth,
        (from, width): (f64, f64),
        (envelope, feed): (&Envelope, f64),
        side: Side,
    ) -> Self {
        let [first, second, third] = curve.derivatives(from + width / 2.0);
        let bounds = curve.bounds();
        let bow = |axis: usize| {
            second[axis].abs() * width / 2.0 + bounds.third[axis] * width * width / 8.0
        };
        // The slope of each axis on the cell: the least for weaker constraints, the largest for stronger ones.
        let slope = |axis: usize| match side {
            Side::Outer => (first[axis].abs() - bow(axis)).max(0.0),
            Side::Inner => first[axis].abs() + bow(axis),
        };
        let bows: AxisVector = std::array::from_fn(bow);
        let counted = curve.counted(&first);
        let counted = match side {
            Side::Outer => (counted - curve.counted(&bows)).max(0.0),
            Side::Inner => counted + curve.counted(&bows),
        };
        // On a circle the speed is the same everywhere.
        let counted = curve.steady(&first).unwrap_or(counted);
        let speed =
            (0..9).map(|axis| envelope.velocity[axis] / slope(axis)).fold(feed / counted, f64::min);
        let highest = speed * speed;
        let steepest = (0..9)
            .map(|axis| {
                let bend = second[axis].abs() + bounds.third[axis] * width / 2.0;
                let least = (first[axis].abs() - bow(axis)).max(0.0);
                (envelope.acceleration[axis] + bend * highest) / least
            })
            .fold(f64::INFINITY, f64::min);
        let demands = (0..9).filter(|axis| envelope.acceleration[*axis].is_finite()).map(|axis| {
            let (m1, m2, m3) = (first[axis], second[axis], third[axis].abs());
            let (b3, b4, w) = (bounds.third[axis], bounds.fourth[axis], width);
            let off = m2.abs() * steepest * w / 4.0
                + w * w * (b3 * steepest / 8.0 + m3 * steepest / 6.0 + b4 * highest / 24.0);
            let limit = envelope.acceleration[axis];
            let (slope, bend) = (m1 + m2 * w, m2);
            match side {
                Side::Outer => Demand { slope, bend, stiff: 0.0, twist: 0.0, limit: limit + off },
                Side::Inner => Demand {
                    slope,
                    bend,
                    stiff: 1.5 * m2.abs() * w + 0.625 * b3 * w * w,
                    twist: m3 * w / 2.0,
                    limit: limit - b4 * highest * w * w / 8.0,
                },
            }
        });
        let demands = demands.filter(|demand| demand.slope != 0.0 || demand.bend != 0.0).collect();
        let ends = [from, from + width].map(|part| length(&curve.derivatives(part)[0]));
        let straight =
            second.iter().all(|bend| *bend == 0.0) && bounds.third.iter().all(|bend| *bend == 0.0);
        Self { width, highest, steepest, straight, scales: (ends[0], ends[1]), demands }
    }

    /// The lowest and the highest u at a y where the cell starts; the first may be above the second, and then there
    /// is none.
    fn rates(&self, y: f64) -> (f64, f64) {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for demand in &self.demands {
            for sign in [1.0, -1.0] {
                let slope = sign * demand.slope + demand.twist * self.width;
                let left = demand.limit - (sign * demand.bend + demand.twist) * y;
                // slope·u + stiff·|u| ≤ left: two straight parts that meet at zero.
                let (rising, falling) = (slope + demand.stiff, slope - demand.stiff);
                if left >= 0.0 {
                    if rising > 0.0 {
                        high = high.min(left / rising);
                    }
                    if falling < 0.0 {
                        low = low.max(left / falling);
                    }
                } else if rising < 0.0 {
                    low = low.max(left / rising);
                } else if falling > 0.0 {
                    high = high.min(left / falling);
                } else {
                    return (f64::INFINITY, f64::NEG_INFINITY);
                }
            }
        }
        (low, high)
    }

    /// The highest y where the cell starts from which a y of at most `next` can be met where it ends.
    ///
    /// Standing still meets every constraint and the set is convex, so that it is all from zero up.
    pub(super) fn controllable(&self, next: f64, side: Side) -> f64 {
        let meets = |y: f64| {
            let (low, high) = self.rates(y);
            let least = low.max(-y / (2.0 * self.width));
            least <= high && y + 2.0 * self.width * least <= next
        };
        if meets(self.highest) {
            return self.highest;
        }
        let (mut inside, mut outside) = (0.0, self.highest);
        for _ in 0..60 {
            let middle = inside + (outside - inside) / 2.0;
            if meets(middle) { inside = middle } else { outside = middle }
        }
        if side == Side::Outer { outside } else { inside }
    }

    /// The highest y where the cell ends that a motion can have which starts it at `y`.
    pub(super) fn reached(&self, y: f64) -> f64 {
        let (_, high) = self.rates(y);
        (y + 2.0 * self.width * high).max(0.0)
    }

    /// The same for a motion that starts it at `y` or below. The highest rate is concave in y.
    pub(super) fn reached_from_below(&self, y: f64) -> f64 {
        let (mut low, mut high) = (0.0, y);
        let near_top = y * (1.0 - 1e-6);
        if self.reached(near_top) <= self.reached(y) {
            return self.reached(y);
        }
        for _ in 0..80 {
            let (one, other) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if self.reached(one) < self.reached(other) { low = one } else { high = other }
        }
        // The maximum is met up to what halving leaves.
        self.reached(low).max(self.reached(high)) * (1.0 + 1e-9)
    }

    /// The largest share of `scales` that y has in the neighbouring cell's terms.
    pub(super) fn into(&self, next: &Self) -> f64 {
        let ratio = self.scales.1 / next.scales.0;
        ratio * ratio
    }
}

/// A speed from its square.
pub(super) fn speed(square: f64) -> f64 {
    square_root(square)
}
