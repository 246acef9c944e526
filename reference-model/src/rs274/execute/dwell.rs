//! G4.

use gaugeblock_vocabulary::{Effect, FaultKind};

use super::{pass, whole, word};
use crate::ids::{quirk, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Waits.
///
/// Rule dwell.seconds. P is the time in seconds; fractions count, and zero is no fault (dwell.zero-time).
/// Rule dwell.changes-nothing. Nothing else is affected.
///
/// # Errors
/// Rule dwell.negative-time.
///
/// # Panics
/// There is no P, which the check asks for: a fault of the model.
pub fn perform(words: &Words, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let seconds = word(words, 'p').expect("check: G4 has P");
    let any = whole(seconds) != Some(-1) && state.choices.quirk(quirk::rs274::NEGATIVE_DWELL);
    if seconds < 0.0 && !any {
        let message = format!("a dwell of {seconds} seconds");
        return Err(refuse(rule::dwell::NEGATIVE_TIME, FaultKind::WordOutOfRange, message));
    }
    for rule in [rule::dwell::SECONDS, rule::dwell::CHANGES_NOTHING, rule::dwell::ONCE] {
        state.coverage.accepted(rule);
    }
    if seconds == 0.0 {
        state.coverage.accepted(rule::dwell::ZERO_TIME);
    }
    record.effect(state, Effect::Dwell { seconds });
    pass(seconds, state);
    Ok(())
}
