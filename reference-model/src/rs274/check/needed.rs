//! Words that a code needs beside it, whatever modes are in force. Without them the block is refused before it waits
//! for anything.
//!
//! What G43.2 needs it is asked for when its phase comes.

use gaugeblock_vocabulary::FaultKind;

use crate::ids::{Rule, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::execute::word;
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Refuses a code without a word that it needs.
pub(super) fn check(words: &Words, state: &State) -> Result<(), StepError> {
    words.g_tenths.iter().try_for_each(|code| match code {
        40 => dwell(words),
        431 => state.dialect().check_dynamic_length(words, state),
        520 => axis_word(rule::offsets::LOCAL_NEEDS_AXES, "G52", words),
        920 => axis_word(rule::offsets::POSITION_NEEDS_AXES, "G92", words),
        _ => Ok(()),
    })
}

/// Rule dwell.needs-time. G4 has P.
fn dwell(words: &Words) -> Result<(), StepError> {
    if word(words, 'p').is_some() {
        return Ok(());
    }
    Err(refuse(rule::dwell::NEEDS_TIME, FaultKind::MissingWord, "G4 needs P, the seconds"))
}

/// The words that a code needs.
pub(crate) trait NeededWordRules {
    /// Rule tool.dynamic-length-needs-axes. G43.1 has an axis word.
    fn check_dynamic_length(&self, words: &Words, _state: &State) -> Result<(), StepError> {
        axis_word(rule::tool::DYNAMIC_LENGTH_NEEDS_AXES, "G43.1", words)
    }
}

fn axis_word(rule: Rule, code: &str, words: &Words) -> Result<(), StepError> {
    if has_axis_words(words) {
        return Ok(());
    }
    Err(refuse(rule, FaultKind::MissingWord, format!("{code} needs an axis word")))
}
