//! What waits under cutter compensation: each effect has its place in the block that programmed it.

use gaugeblock_vocabulary::Step;

/// The places of effects that wait.
#[derive(Debug, Default)]
pub(super) struct Held {
    /// The places that are not released, in program order.
    places: Vec<Place>,
    /// The number of the last place.
    last: u64,
    /// What has been released and comes next.
    released: Released,
}

/// A place in the trace.
#[derive(Clone, Copy, Debug)]
struct Place {
    number: u64,
    step: usize,
    event: usize,
}

/// What has been released.
#[derive(Clone, Copy, Debug, Default)]
enum Released {
    #[default]
    Nothing,
    /// Settings, which were recorded when they were held.
    Settings,
    Effect(Place),
}

impl Held {
    /// The number of all places of settings.
    pub(super) const SETTINGS: u64 = 0;

    /// Reserves the place of an effect in a step.
    pub(super) fn hold(&mut self, step: usize, event: usize) -> u64 {
        self.last += 1;
        self.places.push(Place { number: self.last, step, event });
        self.last
    }

    /// What comes next has waited at this place.
    pub(super) fn release(&mut self, number: u64) {
        let place = self.places.iter().position(|place| place.number == number);
        self.released = match place {
            Some(at) => Released::Effect(self.places.remove(at)),
            None => Released::Settings,
        };
    }

    /// Whether settings that come now were recorded already.
    pub(super) fn is_recorded(&mut self) -> bool {
        matches!(std::mem::take(&mut self.released), Released::Settings)
    }

    /// The step and the event of the effect that comes now, where it has waited.
    pub(super) fn take_released(&mut self) -> Option<(usize, usize)> {
        match std::mem::take(&mut self.released) {
            Released::Effect(place) => Some((place.step, place.event)),
            Released::Nothing | Released::Settings => None,
        }
    }

    /// The block that would become this step is not recorded.
    pub(super) fn discard_block(&mut self, step: usize) {
        self.places.retain(|place| place.step < step);
    }

    /// Removes effects that were never released.
    pub(super) fn remove_lost(&mut self, steps: &mut [Step]) {
        for place in self.places.drain(..).rev() {
            if let Some(step) = steps.get_mut(place.step)
                && place.event < step.events.len()
            {
                step.events.remove(place.event);
            }
        }
    }
}
