//! How fast the path behind the motion may be run back.
//!
//! It is planned from a piece behind up to the motion, which may run back to the beginning of that piece and no
//! farther. What lies near comes first, so that the motion need not wait for all; while it runs back the rest
//! follows, in stretches that begin farther and farther behind. What earlier runs left is worth nothing, since the
//! path may have changed.

use crate::entry_speed::{
    OVERRIDE_MIN, OverrideScale, max_reverse_entry_speed_sq, speed_sq_limits,
};
use crate::limits::{Limits, squared};
use crate::math;
use crate::path_element::PathElement;
use crate::ring::Ring;

/// How many pieces behind the motion are planned before it turns round.
const FIRST_REVERSE_ELEMENTS: u64 = 64;

/// What is planned while the motion is to run back.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Retrace {
    planned: Option<ReversePass>,
}

#[derive(Clone, Copy, Debug)]
struct ReversePass {
    /// The piece that planning began from.
    from: u64,
    /// The next piece to be planned.
    next: u64,
    /// From this piece on all is planned, if only for a path that ends there.
    known: Option<u64>,
}

impl Retrace {
    /// Whether the motion is to run back.
    #[inline]
    pub(crate) fn is_requested(&self) -> bool {
        self.planned.is_some()
    }

    /// The motion is to turn round; whether it may, at a piece.
    pub(crate) fn may_turn(&mut self, elements: &mut Ring<PathElement>, at: u64) -> bool {
        let near = at.saturating_sub(FIRST_REVERSE_ELEMENTS);
        let planned = self.planned.get_or_insert_with(|| ReversePass::begin(elements, near, None));
        planned.next > at
    }

    /// The motion goes on, so that the path behind it may change.
    pub(crate) fn forget(&mut self) {
        self.planned = None;
    }

    /// The piece to whose beginning the motion may run back.
    pub(crate) fn reverse_end(&self) -> u64 {
        match self.planned {
            Some(ReversePass { next, known: Some(known), .. }) if next < known => known,
            Some(ReversePass { from, .. }) => from,
            None => 0,
        }
    }

    /// Plans the next piece up to the motion; where all are planned and it runs back, begins farther behind.
    #[cold]
    #[inline(never)]
    pub(crate) fn advance(
        &mut self,
        elements: &mut Ring<PathElement>,
        (at, backwards): (u64, bool),
        scale: OverrideScale,
        limits: &Limits,
    ) {
        let Some(planned) = &mut self.planned else { return };
        if planned.next <= at {
            planned.plan(elements, at, scale, limits);
        } else if backwards && planned.from > elements.first() {
            let far = at.saturating_sub(planned.from).saturating_add(FIRST_REVERSE_ELEMENTS);
            let from = planned.from.saturating_sub(far);
            *planned = ReversePass::begin(elements, from, Some(planned.from));
        }
    }
}

impl ReversePass {
    /// For the plan, the path ends where the first piece begins.
    fn begin(elements: &mut Ring<PathElement>, from: u64, known: Option<u64>) -> Self {
        let from = from.max(elements.first());
        if let Some(before) = from.checked_sub(1).and_then(|before| elements.get_mut(before)) {
            before.reverse_entry_speed_sq = 0.0;
        }
        Self { from, next: from, known }
    }

    /// How fast the next piece may be entered from its end. Where that is no more than is known already, so is all up
    /// to the motion.
    fn plan(
        &mut self,
        elements: &mut Ring<PathElement>,
        at: u64,
        scale: OverrideScale,
        limits: &Limits,
    ) {
        let place = self.next;
        self.next = place.saturating_add(1);
        let before = place.checked_sub(1).and_then(|before| elements.get(before));
        let Some(element) = elements.get(place) else { return };
        let exit = match before {
            Some(before) => math::min(
                before.reverse_entry_speed_sq * squared(before.end_speed_ratio),
                element.junction_limit_sq,
            ),
            None => 0.0,
        };
        // It is planned for one speed, and so for some where the motion turned at rest.
        let slowest =
            OverrideScale { feed: OVERRIDE_MIN, rapid: OVERRIDE_MIN, spindle_speed: OVERRIDE_MIN };
        let back = max_reverse_entry_speed_sq(
            element,
            exit,
            speed_sq_limits(element, scale.max(slowest)),
            limits,
        );
        // The motion may be there by now, and relies on what is known.
        if self.known.is_some_and(|known| known <= place) && back <= element.reverse_entry_speed_sq
        {
            self.next = at.saturating_add(1);
        } else if let Some(element) = elements.get_mut(place) {
            element.reverse_entry_speed_sq = back;
        }
    }
}
