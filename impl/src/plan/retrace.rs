//! How fast the path behind the motion may be run back.
//!
//! It is planned from far behind up to the motion, for which the path ends there. What lies near behind it comes first, so that it need not wait
//! for all; while it runs back, the rest follows, each time from twice as far.

use super::SLOWEST;
use super::limits::{Limits, squared};
use super::piece::Piece;
use super::reach::{Scale, backward, caps};
use super::ring::Ring;
use crate::math;

/// How many pieces behind the motion are planned before it turns round.
const NEAR: u64 = 64;

/// What is planned of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Retrace {
    /// The next piece to be planned; none while nobody asks.
    next: Option<u64>,
    /// The piece that planning began from.
    from: u64,
    /// From this piece on it is planned already, for a path that ends nearer.
    known: Option<u64>,
}

impl Retrace {
    /// Whether the motion is to run back.
    #[inline]
    pub(super) fn is_asked_for(&self) -> bool {
        self.next.is_some()
    }

    /// The motion is to turn round; whether it may, at a piece.
    pub(super) fn may_turn(&mut self, ring: &mut Ring<Piece>, at: u64) -> bool {
        if self.next.is_none() {
            self.known = None;
            self.begin(ring, at.saturating_sub(NEAR));
        }
        self.next.is_some_and(|next| next > at)
    }

    /// The motion goes on, and the path behind it may change.
    pub(super) fn forget(&mut self) {
        self.next = None;
    }

    /// For the path as it is, it ends where this begins.
    fn begin(&mut self, ring: &mut Ring<Piece>, from: u64) {
        self.from = from.max(ring.first());
        if let Some(before) = self.from.checked_sub(1).and_then(|before| ring.get_mut(before)) {
            before.back = 0.0;
        }
        self.next = Some(self.from);
    }

    /// Plans the next piece up to the motion; where all are planned and it runs back, begins farther behind.
    pub(super) fn work(
        &mut self,
        ring: &mut Ring<Piece>,
        (at, backwards): (u64, bool),
        scale: Scale,
        limits: &Limits,
    ) {
        let Some(next) = self.next else { return };
        if next <= at {
            // What is known already holds on from where it is found again.
            let last = if self.plan(ring, next, scale, limits) { next } else { at };
            self.next = Some(last.saturating_add(1));
        } else if backwards && self.from > ring.first() {
            self.known = Some(self.from);
            let far = at.saturating_sub(self.from).saturating_add(NEAR);
            self.begin(ring, self.from.saturating_sub(far));
        }
    }

    /// How fast a piece may be entered from its end; whether that is new.
    fn plan(&self, ring: &mut Ring<Piece>, place: u64, scale: Scale, limits: &Limits) -> bool {
        let before = place.checked_sub(1).and_then(|before| ring.get(before));
        let Some(piece) = ring.get(place) else { return true };
        let exit = match before {
            Some(before) => math::lesser(before.back * squared(before.exit), piece.entry),
            None => 0.0,
        };
        // It is planned for one speed, and so for some where the motion turned at rest.
        let slowest = Scale { feed: SLOWEST, rapid: SLOWEST, turns: SLOWEST };
        let back = backward(piece, exit, caps(piece, scale.most(slowest)), limits);
        if self.known.is_some_and(|known| known <= place) && back <= piece.back {
            return false;
        }
        if let Some(piece) = ring.get_mut(place) {
            piece.back = back;
        }
        true
    }
}
