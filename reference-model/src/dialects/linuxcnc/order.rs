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

    /// Quirk rs274.rest-of-restore-block. The rest of a block is not executed after a restore that changed something.
    /// A missing feed rate in the rest is not refused. Whether rs274 checks anything else of the rest first is unknown.
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
            let why = "the block restores the modal state; the rest of it would be refused, and it is not known whether \
                       rs274 checks it";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        Ok(false)
    }
}

/// Whether a rule about feed rates refuses the block.
fn is_of_feed(error: &StepError) -> bool {
    let StepError::Refused(refusal) = error else { return false };
    refusal.rule.chapter() == "feed"
}
