//! Words that a code needs beside it, whatever modes are in force. Without them the block is refused before it waits
//! for anything.
//!
//! What G43.2 needs it is asked for when its phase comes: quirk rs274.rest-of-restore-block can drop it before.

use gaugeblock_vocabulary::FaultKind;

use crate::rs274::evaluate::Words;
use crate::rs274::execute::word;
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Refuses a code without a word that it needs.
pub(super) fn check(words: &Words, state: &State) -> Result<(), StepError> {
    words.g.iter().try_for_each(|code| match code {
        40 => dwell(words),
        431 => dynamic_length(words, state),
        520 => axis_word("offsets.local-needs-axes", "G52", words),
        920 => axis_word("offsets.position-needs-axes", "G92", words),
        _ => Ok(()),
    })
}

/// Rule dwell.needs-time. G4 has P.
fn dwell(words: &Words) -> Result<(), StepError> {
    if word(words, 'p').is_some() {
        return Ok(());
    }
    Err(refuse("dwell.needs-time", FaultKind::MissingWord, "G4 needs P, the seconds"))
}

/// Rule tool.dynamic-length-needs-axes. G43.1 has an axis word.
fn dynamic_length(words: &Words, state: &State) -> Result<(), StepError> {
    if state.choices.quirk("rs274.dynamic-length-without-axes") {
        return Ok(());
    }
    axis_word("tool.dynamic-length-needs-axes", "G43.1", words)
}

fn axis_word(rule: &'static str, code: &str, words: &Words) -> Result<(), StepError> {
    if has_axis_words(words) {
        return Ok(());
    }
    Err(refuse(rule, FaultKind::MissingWord, format!("{code} needs an axis word")))
}
