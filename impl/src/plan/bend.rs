//! A cycle of motion on a bend, where each axis is looked at by itself.
//!
//! An acceleration that is kept up to the end of a bend is within the limits of an axis everywhere if it is so at both ends. A motion may do
//! what it likes as long as after each cycle there is such an acceleration that leads to what the next piece allows.

use super::limits::{Limits, PLANNED, squared};
use super::piece::Piece;
use super::step::{End, Motion, SMALL, Wish, wanted};
use crate::math;

/// Half of what lies between a limit and what is planned with.
const HARDLY: f64 = 1.0 + 0.5 * (1.0 - PLANNED);
/// How often an acceleration is halved in that leaves another one to be kept up.
const TRIALS: u32 = 6;

impl Motion {
    pub(super) fn bend<const N: usize>(
        &mut self,
        piece: &Piece,
        end: End,
        (limits, wish): (&Limits, &Wish),
        left: f64,
    ) -> f64 {
        let End { exit, remaining } = end;
        let mut most = f64::NEG_INFINITY;
        if !wish.rest {
            let eased = End { exit: wish.ease * exit, remaining };
            let met = (eased.exit - squared(self.speed)) / (2.0 * remaining);
            let asked = (wanted(piece, wish) - self.speed) / left;
            most = math::lesser(asked, met);
            if most > 0.0 {
                let (high, calm) = self.greatest::<N>(piece, remaining, limits);
                most = math::lesser(most, high);
                if calm {
                    let even = math::greater(most, 0.0);
                    let most = self.quicker::<N>(piece, eased, (even, asked), limits, left);
                    return self.go(piece, most, end, left);
                }
            } else if self.allows::<N>(piece, remaining, most, limits) {
                let most = self.quicker::<N>(piece, eased, (most, asked), limits, left);
                return self.go(piece, most, end, left);
            }
        }
        let low = self.least::<N>(piece, remaining, limits);
        if most >= low {
            let (high, _) = self.greatest::<N>(piece, remaining, limits);
            most = math::lesser(most, math::greater(high, low));
            return self.go(piece, most, end, left);
        }
        // More than can be kept up to the end of the piece may be possible within this cycle.
        let near = math::lesser(self.speed * left, remaining);
        let now = self.least::<N>(piece, near, limits);
        self.go(piece, math::greater(most, math::lesser(now, low)), end, left)
    }

    /// On a bend that lasts longer than the cycle, more than the acceleration that could be kept up to its end: as much as is asked for, if then
    /// another one can be kept up.
    fn quicker<const N: usize>(
        &self,
        piece: &Piece,
        end: End,
        (even, asked): (f64, f64),
        limits: &Limits,
        left: f64,
    ) -> f64 {
        let travel = |acceleration: f64| (self.speed + 0.5 * acceleration * left) * left;
        let rests = even < 0.0 && self.speed + even * left <= 0.0;
        if even >= asked || rests || travel(even) >= end.remaining {
            return even;
        }
        let here = math::lesser(asked, self.greatest::<N>(piece, 0.0, limits).0);
        let near = math::lesser(travel(here), end.remaining);
        let mut high = math::lesser(asked, self.greatest::<N>(piece, near, limits).0);
        let mut low = even;
        let mut tried = high;
        for _ in 0..TRIALS {
            if tried <= low {
                break;
            }
            let way = travel(tried);
            if way < end.remaining && self.leads::<N>(piece, end, (tried, way), limits, left) {
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

    /// Whether after a cycle with an acceleration another one can be kept up to the end of a bend.
    fn leads<const N: usize>(
        &self,
        piece: &Piece,
        End { exit, remaining }: End,
        (acceleration, way): (f64, f64),
        limits: &Limits,
        left: f64,
    ) -> bool {
        let y = squared(self.speed + acceleration * left);
        let (sense, last) = if self.backwards { (-1.0, 0.0) } else { (1.0, piece.length) };
        let x = self.x + sense * way;
        let along = if y > exit { sense * (exit - y) / (2.0 * (remaining - way)) } else { 0.0 };
        let exit = math::lesser(exit, y);
        let axes = piece.rate.iter().zip(&piece.bend).zip(&limits.planned).take(N);
        let mut leads = true;
        for ((rate, bend), limit) in axes {
            let next = along * (rate + x * bend) + bend * y;
            let then = along * (rate + last * bend) + bend * exit;
            leads &= math::greater(next.abs(), then.abs()) <= *limit;
        }
        leads
    }

    /// Whether all axes allow an acceleration up to the end of a bend: what is asked for mostly is.
    fn allows<const N: usize>(
        &self,
        piece: &Piece,
        remaining: f64,
        acceleration: f64,
        limits: &Limits,
    ) -> bool {
        let y = squared(self.speed);
        let later = 3.0 * remaining * acceleration;
        let along = if self.backwards { -acceleration } else { acceleration };
        let axes = piece.rate.iter().zip(&piece.bend).zip(&limits.planned).take(N);
        let mut allows = true;
        for ((rate, bend), limit) in axes {
            let here = along * (rate + self.x * bend) + bend * y;
            allows &= here.abs() <= *limit && (here + later * bend).abs() <= *limit;
        }
        allows
    }

    /// The greatest acceleration that is planned with up to the end of a bend; and whether none is allowed too.
    pub(super) fn greatest<const N: usize>(
        &self,
        piece: &Piece,
        remaining: f64,
        limits: &Limits,
    ) -> (f64, bool) {
        let (mut high, mut calm) = (f64::INFINITY, true);
        let (y, thrice) = (squared(self.speed), 3.0 * remaining);
        let sense = if self.backwards { -1.0 } else { 1.0 };
        let axes = piece.rate.iter().zip(&piece.bend).zip(&limits.planned).take(N);
        for ((rate, bend), limit) in axes {
            let across = bend * y;
            calm &= across.abs() <= HARDLY * limit;
            let here = sense * (rate + self.x * bend);
            for share in [here, here + thrice * bend] {
                // Towards the greater acceleration an axis has what p''·y leaves it.
                let used = across.copysign(across * share);
                high = math::lesser(high, (limit - used) / math::greater(share.abs(), SMALL));
            }
        }
        (high, calm)
    }

    /// The least acceleration that all axes allow on a bend from here to so far ahead. It is a little below what is planned
    /// with, so that a speed that rounding has made too high comes down again.
    pub(super) fn least<const N: usize>(&self, piece: &Piece, ahead: f64, limits: &Limits) -> f64 {
        let mut low = f64::NEG_INFINITY;
        let (y, thrice) = (squared(self.speed), 3.0 * ahead);
        let sense = if self.backwards { -1.0 } else { 1.0 };
        let axes = piece.rate.iter().zip(&piece.bend).zip(&limits.acceleration).take(N);
        for ((rate, bend), limit) in axes {
            let across = bend * y;
            let here = sense * (rate + self.x * bend);
            for share in [here, here + thrice * bend] {
                let used = across.copysign(across * share);
                low = math::greater(low, (-limit - used) / math::greater(share.abs(), SMALL));
            }
        }
        low
    }
}
