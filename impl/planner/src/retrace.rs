//! How fast the path that the motion has passed may be run in reverse.
//!
//! It is planned from an earlier element up to the motion, which may run back to the start of that element and no
//! farther. Near elements come first, so that the motion need not wait for all. While it runs back, planning starts
//! again from farther and farther back. Values of earlier runs are not used, since the path may have changed.

use crate::entry_speed::{
    OVERRIDE_MIN, OverrideScale, max_reverse_entry_speed_sq, speed_sq_limits,
};
use crate::limits::{LimitTable, squared};
use crate::math;
use crate::path_element::PathElement;
use crate::ring::Ring;

/// How many of the last elements are planned before it reverses.
const FIRST_REVERSE_ELEMENTS: u64 = 64;

/// The plan while the motion is to run in reverse.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Retrace {
    planned: Option<ReversePass>,
}

#[derive(Clone, Copy, Debug)]
struct ReversePass {
    /// The element at which planning began.
    from: u64,
    /// The next element to plan.
    next: u64,
    /// From this element on everything is planned, though for a path that ends there.
    known: Option<u64>,
}

impl Retrace {
    /// Whether the motion is to run in reverse.
    #[inline]
    pub(crate) fn is_requested(&self) -> bool {
        self.planned.is_some()
    }

    /// Requests reverse motion. Returns whether the motion may reverse at an element.
    pub(crate) fn may_turn(&mut self, elements: &mut Ring<PathElement>, at: u64) -> bool {
        let near = at.saturating_sub(FIRST_REVERSE_ELEMENTS);
        let planned = self.planned.get_or_insert_with(|| ReversePass::begin(elements, near, None));
        planned.next > at
    }

    /// The motion runs forward, so the path before it may change.
    pub(crate) fn forget(&mut self) {
        self.planned = None;
    }

    /// The element to whose start the motion may run back.
    pub(crate) fn reverse_end(&self) -> u64 {
        match self.planned {
            Some(ReversePass { next, known: Some(known), .. }) if next < known => known,
            Some(ReversePass { from, .. }) => from,
            None => 0,
        }
    }

    /// Plans the next element up to the motion. When all are planned and the motion runs back, starts again from
    /// farther back.
    #[cold]
    #[inline(never)]
    pub(crate) fn advance(
        &mut self,
        elements: &mut Ring<PathElement>,
        (at, backwards): (u64, bool),
        scale: OverrideScale,
        limits: &LimitTable,
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
    /// In the plan, the path ends where the first element begins.
    fn begin(elements: &mut Ring<PathElement>, from: u64, known: Option<u64>) -> Self {
        let from = from.max(elements.first());
        if let Some(before) = from.checked_sub(1).and_then(|before| elements.get_mut(before)) {
            before.reverse_entry_speed_sq = 0.0;
        }
        Self { from, next: from, known }
    }

    /// Computes how fast the next element may be entered from its end. Where that is no more than known already,
    /// everything up to the motion is known.
    fn plan(
        &mut self,
        elements: &mut Ring<PathElement>,
        at: u64,
        scale: OverrideScale,
        limits: &LimitTable,
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
        // It is planned for one spindle speed, and so for some speed even where the spindle stood still when the
        // motion reversed.
        let slowest =
            OverrideScale { feed: OVERRIDE_MIN, rapid: OVERRIDE_MIN, spindle_speed: OVERRIDE_MIN };
        let back = max_reverse_entry_speed_sq(
            element,
            exit,
            speed_sq_limits(element, scale.max(slowest)),
            limits.of(element),
        );
        // The motion may be there already, and relies on what is known.
        if self.known.is_some_and(|known| known <= place) && back <= element.reverse_entry_speed_sq
        {
            self.next = at.saturating_add(1);
        } else if let Some(element) = elements.get_mut(place) {
            element.reverse_entry_speed_sq = back;
        }
    }
}
