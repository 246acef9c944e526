//! The states that M70 and M73 have saved, by call level.

use alloc::vec::Vec;

use gaugeblock_vocabulary::Motion;

use super::compensation::Cutter;
use super::modes::Modes;

/// The state that M70 and M73 save.
#[derive(Clone, Copy, Debug)]
pub(super) struct Saved {
    pub(super) modes: Modes,
    pub(super) motion: Motion,
    pub(super) cutter: Cutter,
    pub(super) feed_spindle: u32,
}

/// A slot of one call level for a saved state.
#[derive(Clone, Debug)]
pub(super) struct SaveSlot {
    /// The call level at which it was saved.
    pub(super) level: u32,
    /// 70 or 73 if M70 and M73 save in separate slots, else 70.
    pub(super) code: u16,
    /// Whether M70 has saved in this slot.
    pub(super) by_m70: bool,
    /// False after M71: the state cannot be restored.
    pub(super) valid: bool,
    /// Whether the end of the sub restores this state.
    pub(super) autorestore: bool,
    pub(super) state: Saved,
}

/// The saved states of all call levels, innermost last. A level that saves nothing has no slot.
#[derive(Clone, Debug, Default)]
pub(crate) struct SavedStates {
    /// The current call level, 0 in the main program.
    pub(super) level: u32,
    pub(super) places: Vec<SaveSlot>,
    /// The slots of the current level before the block changed them.
    pub(super) before: Vec<SaveSlot>,
    /// Whether `before` was recorded for this block.
    pub(super) noted: bool,
}

impl SavedStates {
    /// The slots of the current call level, the latest save first.
    pub(super) fn here(&mut self) -> impl Iterator<Item = &mut SaveSlot> {
        let level = self.level;
        self.places.iter_mut().rev().take_while(move |place| place.level == level)
    }

    /// Begins a block that can be rolled back.
    #[inline]
    pub(super) fn begin_notes(&mut self) {
        self.noted = false;
    }

    /// Records the slots of the current level before their first change in a block.
    pub(super) fn note(&mut self) {
        if !self.noted {
            self.noted = true;
            self.before.clear();
            let level = self.level;
            let here = self.places.iter().filter(|place| place.level == level);
            self.before.extend(here.cloned());
        }
    }

    /// Reverts the changes of the block.
    pub(super) fn roll_back(&mut self) {
        if self.noted {
            let level = self.level;
            self.places.retain(|place| place.level != level);
            self.places.append(&mut self.before);
            self.noted = false;
        }
    }

    /// Saves in the slot of `slot_code` (70 or 73); `code` is the M code that saves.
    pub(super) fn save(&mut self, slot_code: u16, code: u16, state: Saved) {
        let level = self.level;
        let same = |saved: &SaveSlot| saved.level == level && saved.code == slot_code;
        let earlier = self.places.iter().rposition(same).map(|at| self.places.remove(at));
        self.places.push(SaveSlot {
            level,
            code: slot_code,
            by_m70: code == 70 || earlier.as_ref().is_some_and(|place| place.by_m70),
            valid: true,
            autorestore: code == 73 || earlier.is_some_and(|place| place.autorestore),
            state,
        });
    }

    /// Ends all calls: their saved states are removed.
    pub(super) fn leave_calls(&mut self) {
        self.level = 0;
        self.places.retain(|place| place.level == 0);
    }
}
