//! Quirks of offsets.

use gaugeblock_vocabulary::Position;

use super::program_end::without_local_offset;
use super::{LinuxCnc, Shows};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::local_offset::LocalOffsetRules;
use crate::rs274::execute::offsets::OffsetRules;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl OffsetRules for LinuxCnc {
    /// Quirk rs274.same-system-kept. The system in force is not read again.
    fn select_system(&self, system: u32, state: &mut State) {
        let same = system == state.modes.work_offset;
        if !(same && state.shows(quirk::rs274::SAME_SYSTEM_KEPT)) {
            Documented.select_system(system, state);
        }
    }

    /// Quirk rs274.calculate-without-axes. It needs none.
    fn check_calculated_axes(&self, words: &Words, state: &State) -> Result<(), StepError> {
        if state.shows(quirk::rs274::CALCULATE_WITHOUT_AXES) {
            return Ok(());
        }
        Documented.check_calculated_axes(words, state)
    }

    /// Quirk rs274.origin-number-cut. A fraction of a half or more of P is cut off.
    fn programmed_system(&self, words: &Words, state: &State) -> Option<f64> {
        let cuts = state.shows(quirk::rs274::ORIGIN_NUMBER_CUT);
        let is_cut = |number: f64| cuts && number - number.floor() >= 0.5;
        let number = Documented.programmed_system(words, state)?;
        Some(if is_cut(number) { number.floor() } else { number })
    }

    /// Quirk rs274.rotation-under-local-offset.
    fn reload_turned_system(&self, state: &mut State) {
        without_local_offset(|state| Documented.reload_turned_system(state), state);
    }
}

impl LocalOffsetRules for LinuxCnc {
    /// Quirk rs274.position-omitted-axes. They keep theirs.
    fn offset_without_word(&self, before: Position, state: &State) -> Position {
        if state.shows(quirk::rs274::POSITION_OMITTED_AXES) {
            return before;
        }
        Documented.offset_without_word(before, state)
    }
}
