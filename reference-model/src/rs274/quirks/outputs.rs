//! Quirks of inputs and outputs.

use gaugeblock_vocabulary::WaitMode;

use crate::ids::quirk;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::{whole, word};
use crate::rs274::state::State;

/// Quirk rs274.output-value-optional. The value of M67 and M68 without Q.
pub(crate) const ABSENT_VALUE: f64 = -1.0;

/// Quirk rs274.io-number-rounded. A number of an input or output is rounded, halves to the even number.
pub(crate) fn number(value: f64, state: &State) -> Option<i32> {
    if state.choices.quirk(quirk::rs274::IO_NUMBER_ROUNDED) {
        whole(value.round_ties_even())
    } else {
        whole(value)
    }
}

/// Quirk linuxcnc.wait-mode-times-out. Under an L above 4 the time-out goes by, whatever the input does; its seconds.
pub(crate) fn waits_for_nothing(words: &Words, state: &State) -> Option<f64> {
    let quirk = state.choices.quirk(quirk::linuxcnc::WAIT_MODE_TIMES_OUT);
    let is_unknown = word(words, 'l').and_then(whole).is_some_and(|mode| mode > 4);
    (quirk && is_unknown).then(|| word(words, 'q').unwrap_or(0.0))
}

/// Quirk rs274.wait-mode-any. A mode above 4 waits, for what nobody can tell.
/// Quirk linuxcnc.wait-mode-times-out. On the whole controller it does not.
pub(crate) fn unknown_mode(state: &State) -> WaitMode {
    let times_out = state.choices.quirk(quirk::linuxcnc::WAIT_MODE_TIMES_OUT);
    if times_out { WaitMode::Immediate } else { WaitMode::Low }
}
