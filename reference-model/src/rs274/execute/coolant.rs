//! M7, M8, M9.

use gaugeblock_vocabulary::Switch;

use crate::ids::rule;
use crate::rs274::evaluate::Words;
use crate::rs274::state::State;

/// Turns coolant on and off.
///
/// Rules coolant.mist and coolant.flood. Each turns one coolant on and leaves the other alone.
/// Rule coolant.off. M9 turns both off.
/// Rules coolant.both and coolant.repeated. Any state is allowed before any code.
pub fn perform(words: &Words, state: &mut State) {
    state.coverage.accepted(rule::coolant::REPEATED);
    for code in &words.m {
        match code {
            7 => {
                state.coverage.accepted(rule::coolant::MIST);
                state.modes.mist = Switch::On;
            }
            8 => {
                state.coverage.accepted(rule::coolant::FLOOD);
                state.modes.flood = Switch::On;
            }
            9 => {
                state.coverage.accepted(rule::coolant::OFF);
                state.modes.mist = Switch::Off;
                state.modes.flood = Switch::Off;
            }
            _ => {}
        }
    }
    if state.modes.mist == Switch::On && state.modes.flood == Switch::On {
        state.coverage.accepted(rule::coolant::BOTH);
    }
}
