//! What a cycle is refused for before its numbers are looked at.

use gaugeblock_vocabulary::{Compensation, FaultKind, FeedMode};

use super::cycle::axes_of;
use crate::ids::rule;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::{letter, word};
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Rule cycles.axis-words-missing. A cycle needs an axis word.
/// Rule cycles.rotary-words. A rotary axis has no place in it.
/// Rule cycles.words-of-plane. Nor have U, V and W in a plane of X, Y and Z, or the other way round.
/// Rule cycles.under-compensation. It is refused while cutter compensation is on.
/// Rule cycles.inverse-time. So it is under inverse time.
pub(super) fn check(words: &Words, state: &mut State) -> Result<(), StepError> {
    let Some(axes) = has_axis_words(words).then(|| axes_of(state.modes.plane)) else {
        let message = "a cycle without axis words";
        return Err(refuse(rule::cycles::AXIS_WORDS_MISSING, FaultKind::MissingWord, message));
    };
    let family = axes.map(letter);
    let foreign =
        "xyzuvw".chars().find(|axis| !family.contains(axis) && word(words, *axis).is_some());
    let rotary = "abc".chars().find(|axis| word(words, *axis).is_some());
    let off = state.modes.compensation == Compensation::Off;
    let inverse = state.modes.feed_mode == FeedMode::InverseTime;
    let faults = [
        (
            rotary.is_some(),
            rule::cycles::ROTARY_WORDS,
            FaultKind::AxisWords,
            "a rotary axis in a cycle",
        ),
        (
            foreign.is_some(),
            rule::cycles::WORDS_OF_PLANE,
            FaultKind::AxisWords,
            "an axis of the other family of planes in a cycle",
        ),
        (
            !off,
            rule::cycles::UNDER_COMPENSATION,
            FaultKind::CompensationActive,
            "a cycle while cutter compensation is on",
        ),
        (
            inverse,
            rule::cycles::INVERSE_TIME,
            FaultKind::ModalConflict,
            "a cycle under inverse time",
        ),
    ];
    for (fault, rule, kind, message) in faults {
        if fault && !state.dialect().accepts_cycle(rule, state) {
            return Err(refuse(rule, kind, message));
        }
        state.coverage.accepted(rule);
    }
    state.coverage.accepted(rule::cycles::AXIS_WORDS_MISSING);
    Ok(())
}
