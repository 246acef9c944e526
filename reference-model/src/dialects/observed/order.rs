//! Quirks of the order of execution.

use super::task::{record_modes_at_motion, synchronise};
use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::word;
use crate::rs274::order::{OrderRules, Phase, Phases, fault_after};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl OrderRules for Observed {
    /// Quirk rs274.polar-plane. The plane that is active before the block is recorded for `check_polar`.
    /// Quirk nist.cycle-repeats-last-word. The words of X, Y and Z are recorded.
    /// Quirk linuxcnc.modes-of-last-motion. The moves to where the tool is changed have the modes before their block.
    fn phases(&self, words: &Words, state: &mut State) -> Phases {
        state.memory.plane_before = Some(state.modes.plane);
        for (last, letter) in state.memory.last_words.iter_mut().zip(['x', 'y', 'z']) {
            *last = word(words, letter).unwrap_or(*last);
        }
        let change = state.machine.tool_change;
        let moves = words.m.contains(&6) && (change.at_g30 || change.quill_up);
        if moves && state.has_quirk(quirk::linuxcnc::MODES_OF_LAST_MOTION) {
            let in_main = state.call_level() == 0;
            state.memory.at_last_motion = in_main.then(|| Box::new(state.modes.clone()));
        }
        Documented.phases(words, state)
    }

    /// Quirk rs274.rest-of-restore-block. The rest of a block is not executed after a restore that changed something.
    /// A missing feed rate in the rest is not refused. If anything else in the rest would be refused, the result is
    /// unspecified: it is unknown whether rs274 checks the rest.
    ///
    /// Quirk linuxcnc.modes-of-last-motion. The modes at each motion are recorded.
    ///
    /// Quirk linuxcnc.point-read-back. G28 and G30 lead to a point that the interpreter knows. At M6, M61 and M66 it
    /// waits for the machine and reads the point back.
    fn goes_on_after(
        &self,
        phase: Phase,
        phases: Phases,
        words: &Words,
        state: &mut State,
    ) -> Result<bool, StepError> {
        if phase == Phase::Motion {
            record_modes_at_motion(state);
        }
        if phase == Phase::OffsetData && words.g_tenths.iter().any(|code| matches!(code, 280 | 300))
        {
            state.memory.machine_point = None;
        }
        let waits = |code: &u32| {
            phase == Phase::InputsOutputs && *code == 66
                || phase == Phase::ChangeTool && matches!(code, 6 | 61)
        };
        if words.m.iter().any(waits) {
            synchronise(state);
        }
        if !std::mem::take(&mut state.memory.drops_rest) {
            return Ok(true);
        }
        let later = fault_after(phase, phases, words, state);
        if later.is_some_and(|error| !is_feed_refusal(&error)) {
            let why = "the block restores the modal state; the rest of it would be refused, and it is not known whether \
                       rs274 checks it";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        Ok(false)
    }
}

/// Whether a rule of the chapter `feed` refuses the block.
fn is_feed_refusal(error: &StepError) -> bool {
    let StepError::Refused(refusal) = error else { return false };
    refusal.rule.chapter() == "feed"
}
