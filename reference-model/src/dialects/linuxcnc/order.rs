//! Quirks of the order of execution.

use super::LinuxCnc;
use super::task::moved;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::order::{OrderRules, Phase, Phases, fault_after};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl OrderRules for LinuxCnc {
    /// Quirk rs274.polar-plane. The plane before the block is remembered.
    fn phases(&self, words: &Words, state: &mut State) -> Phases {
        state.memory.plane_before = Some(state.modes.plane);
        Documented.phases(words, state)
    }

    /// Quirk rs274.rest-of-restore-block. Nothing of the block is executed after a restore that changed something. A
    /// feed is not asked for; what else is asked before is not known.
    fn goes_on_after(
        &self,
        phase: Phase,
        phases: Phases,
        words: &Words,
        state: &mut State,
    ) -> Result<bool, StepError> {
        if phase == Phase::Motion {
            moved(state);
        }
        if !std::mem::take(&mut state.memory.drops_rest) {
            return Ok(true);
        }
        let later = fault_after(phase, phases, words, state);
        if later.is_some_and(|error| !is_of_feed(&error)) {
            let why =
                "a restore in a block whose rest is not executed, and would be refused or open";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        Ok(false)
    }
}

/// Whether a rule of feeds refuses it.
fn is_of_feed(error: &StepError) -> bool {
    let StepError::Refused(refusal) = error else { return false };
    refusal.rule.chapter() == "feed"
}
