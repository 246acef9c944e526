//! The states that M70 and M73 have saved, by call level.

use alloc::vec::Vec;

use gaugeblock_vocabulary::Motion;

use super::modes::Modes;

/// The state that M70 and M73 save.
#[derive(Clone, Copy, Debug)]
pub(super) struct Saved {
    pub(super) modes: Modes,
    pub(super) motion: Motion,
    pub(super) compensation_radius: f64,
    pub(super) feed_spindle: u32,
}

/// A place in which state is saved.
#[derive(Clone, Debug)]
pub(super) struct SaveSlot {
    /// Call level to which it belongs.
    pub(super) level: u32,
    /// 70 or 73 where the codes save apart, else 70.
    pub(super) code: u16,
    /// Whether M70 ever saved in it.
    pub(super) by_m70: bool,
    /// Whether it can be restored from.
    pub(super) valid: bool,
    /// Whether the end of the sub restores from it.
    pub(super) autorestore: bool,
    pub(super) state: Saved,
}

/// The saved states of all call levels, innermost last. A level that saves nothing costs nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct SavedStates {
    pub(super) level: u32,
    pub(super) places: Vec<SaveSlot>,
    /// The places of the level before the block changed them.
    pub(super) before: Vec<SaveSlot>,
    /// Whether it has.
    pub(super) noted: bool,
}

impl SavedStates {
    /// The places of the current call level, the one saved in last first.
    pub(super) fn here(&mut self) -> impl Iterator<Item = &mut SaveSlot> {
        let level = self.level;
        self.places.iter_mut().rev().take_while(move |place| place.level == level)
    }

    /// Begins a block that can be rolled back.
    #[inline]
    pub(super) fn begin_notes(&mut self) {
        self.noted = false;
    }

    /// Notes the places of the level before they change.
    pub(super) fn note(&mut self) {
        if !self.noted {
            self.noted = true;
            self.before.clear();
            let level = self.level;
            let here = self.places.iter().filter(|place| place.level == level);
            self.before.extend(here.cloned());
        }
    }

    /// Rolls back what the block did.
    pub(super) fn roll_back(&mut self) {
        if self.noted {
            let level = self.level;
            self.places.retain(|place| place.level != level);
            self.places.append(&mut self.before);
            self.noted = false;
        }
    }

    pub(super) fn save(&mut self, place: u16, code: u16, state: Saved) {
        let level = self.level;
        let same = |saved: &SaveSlot| saved.level == level && saved.code == place;
        let earlier = self.places.iter().rposition(same).map(|at| self.places.remove(at));
        self.places.push(SaveSlot {
            level,
            code: place,
            by_m70: code == 70 || earlier.as_ref().is_some_and(|place| place.by_m70),
            valid: true,
            autorestore: code == 73 || earlier.is_some_and(|place| place.autorestore),
            state,
        });
    }

    /// No call is open any more; what was saved in one is gone.
    pub(super) fn leave_calls(&mut self) {
        self.level = 0;
        self.places.retain(|place| place.level == 0);
    }
}
