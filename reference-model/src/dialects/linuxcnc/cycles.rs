//! Quirks of canned cycles.

use gaugeblock_vocabulary::PathControlMode;

use super::path::tolerances_as_numbers;
use super::{LinuxCnc, Shows};
use crate::ids::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::cycles::{Cycle, CycleRules};
use crate::rs274::execute::word;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;
use crate::rs274::task::Record;

impl CycleRules for LinuxCnc {
    /// Quirk rs274.cycle-dollar. No cycle takes $: it is another code's.
    /// Quirk rs274.chosen-spindle. Without $ it is the spindle that an earlier block chose.
    fn spindle_of_cycle(&self, words: &Words, state: &mut State) -> Result<usize, StepError> {
        if word(words, '$').is_none() || state.shows(quirk::rs274::CYCLE_DOLLAR) {
            return Ok(state.memory.chosen_spindle);
        }
        Documented.spindle_of_cycle(words, state)
    }

    /// Quirk rs274.cycle-exact-path. A cycle is executed on the exact path, and G64 is programmed again after it.
    fn perform_repeats(
        &self,
        cycle: &Cycle,
        places: &mut dyn Iterator<Item = [f64; 2]>,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        if !state.shows(quirk::rs274::CYCLE_EXACT_PATH) {
            return Documented.perform_repeats(cycle, places, state, record);
        }
        let path = std::mem::replace(&mut state.modes.path, PathControlMode::ExactPath);
        Documented.perform_repeats(cycle, places, state, record)?;
        if path == PathControlMode::Continuous {
            tolerances_as_numbers(state);
        }
        state.modes.path = path;
        Ok(())
    }
}
