//! Effects that wait until the next compensated move is known.
//!
//! Each is recorded in its own block at once, so that the record has the order of the program; the end of a move may be
//! amended there.

use gaugeblock_vocabulary::{Axis, Effect, Event, LengthUnit, Position};

use super::Record;
use super::effects::Waiting;
use crate::rs274::modes::converted;

impl Record {
    /// The moves that wait end at another point of the plane, in `units`.
    pub(crate) fn amend(&mut self, axes: [Axis; 2], point: (f64, f64), units: LengthUnit) {
        for place in self.waiting.clone() {
            let Some(end) = self.event_mut(place).and_then(end_of) else { continue };
            let mut there = Position::default();
            *there.get_mut(axes[0]) = point.0;
            *there.get_mut(axes[1]) = point.1;
            let there = converted(there, units, place.units);
            for axis in axes {
                *end.get_mut(axis) = there.get(axis);
            }
        }
    }

    /// Whether a compensated move waits.
    pub(super) fn waits(&self) -> bool {
        !self.waiting.is_empty()
    }

    /// The time that dwells take which wait, seconds.
    pub(super) fn waiting_seconds(&self) -> f64 {
        let events = self.waiting.iter().filter_map(|place| {
            let events = self.steps.get(place.step).map_or(&self.events, |step| &step.events);
            events.get(place.event)
        });
        events
            .map(|event| match event {
                Event::Do(Effect::Dwell { seconds }) => *seconds,
                Event::Do(_) | Event::Set(_) | Event::Unknown(_) => 0.0,
            })
            .sum()
    }

    /// Nothing waits any more.
    pub(crate) fn put_out(&mut self) {
        self.waiting.clear();
    }

    /// What waits is lost.
    pub(super) fn lose_waiting(&mut self) {
        let mut places = std::mem::take(&mut self.waiting);
        while let Some(Waiting { step, event, .. }) = places.pop() {
            let events = self.events_of(step);
            if let Some(events) = events.filter(|events| event < events.len()) {
                events.remove(event);
            }
        }
    }

    /// The events of a block: one that has been executed, or the present one.
    fn events_of(&mut self, step: usize) -> Option<&mut Vec<Event>> {
        if step == self.steps.len() {
            return Some(&mut self.events);
        }
        self.steps.get_mut(step).map(|step| &mut step.events)
    }

    fn event_mut(&mut self, place: Waiting) -> Option<&mut Event> {
        self.events_of(place.step)?.get_mut(place.event)
    }
}

/// The end of a compensated move.
fn end_of(event: &mut Event) -> Option<&mut Position> {
    match event {
        Event::Do(
            Effect::StraightTraverse { end }
            | Effect::StraightFeed { end }
            | Effect::ArcFeed { end, .. },
        ) => Some(end),
        Event::Do(_) | Event::Set(_) | Event::Unknown(_) => None,
    }
}
