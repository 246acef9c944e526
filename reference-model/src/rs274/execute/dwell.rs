//! G4.

use gaugeblock_vocabulary::{Effect, FaultKind};

use super::{pass, word};
use crate::ids::rule;
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Waits.
///
/// Rule dwell.seconds. P is the time in seconds; it may have a fraction and may be zero (dwell.zero-time).
/// Rule dwell.changes-nothing. Nothing else is affected.
///
/// # Errors
/// Rule dwell.negative-time.
///
/// # Panics
/// P is missing although the check requires it: a fault of the model.
pub fn perform(words: &Words, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let seconds = word(words, 'p').expect("check: G4 has P");
    state.dialect().check_dwell(seconds, state)?;
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

/// How long a controller may dwell.
pub(crate) trait DwellRules {
    /// Rule dwell.negative-time. A dwell of fewer than no seconds is refused.
    fn check_dwell(&self, seconds: f64, _state: &State) -> Result<(), StepError> {
        if seconds < 0.0 {
            let message = format!("the dwell P must not be negative: {seconds} seconds");
            return Err(refuse(rule::dwell::NEGATIVE_TIME, FaultKind::WordOutOfRange, message));
        }
        Ok(())
    }
}
