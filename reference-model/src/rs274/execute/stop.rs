//! M0, M1, M60, and the program end.

use gaugeblock_vocabulary::Effect;

use super::{compensation, program_end};
use crate::ids::choice::pause::{OptionalStop, PalletCodes};
use crate::ids::rule;
use crate::rs274::evaluate::Words;
use crate::rs274::order::AfterPhase;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Pauses the program, or ends it.
///
/// Rule pause.always. M0 pauses the program.
/// Rule pause.optional. M1 pauses it only while the optional-stop switch is on.
/// Rule pause.optional-stop. Whether M1 does that, or nothing, is a choice.
/// Rule pause.last-in-block. Everything else of the block comes before.
/// Choice pause.pallet-codes. One document says of M30 and M60 in its table what its sections say of the other.
/// Rule pause.pallet. M60 exchanges the pallet shuttles and then pauses it, whatever that switch is.
///
/// # Errors
/// A compensated move is put out, and the tool does not fit along it.
pub fn perform(
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<AfterPhase, StepError> {
    let (ends, pauses) = match state.choices.get::<PalletCodes>() {
        PalletCodes::Table => (60, 30),
        PalletCodes::Sections => (30, 60),
    };
    if words.m.contains(&2) || words.m.contains(&ends) {
        compensation::put_out(state, record)?;
        compensation::end_of_run(state);
        program_end::perform(words, state, record);
        return Ok(AfterPhase::ProgramEnd);
    }
    let optional = words.m.contains(&1);
    if optional {
        state.coverage.accepted(rule::pause::OPTIONAL_STOP);
        if state.choices.is(OptionalStop::Ignored) {
            return Ok(AfterPhase::Execute);
        }
    }
    compensation::put_out(state, record)?;
    if words.m.contains(&pauses) {
        state.coverage.accepted(rule::pause::PALLET);
        record.effect(state, Effect::PalletShuttle {});
    } else {
        state.coverage.accepted(if optional { rule::pause::OPTIONAL } else { rule::pause::ALWAYS });
    }
    state.coverage.accepted(rule::pause::LAST_IN_BLOCK);
    record.effect(state, Effect::Stop { optional });
    let switched_off = optional && !state.panel.optional_stop;
    Ok(if switched_off || state.environment.is_stand_alone() {
        AfterPhase::Execute
    } else {
        AfterPhase::Pause
    })
}
