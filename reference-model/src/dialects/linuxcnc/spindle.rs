//! Quirks of spindles.

use gaugeblock_vocabulary::SpindleTurn;

use super::{LinuxCnc, Shows};
use crate::dialects::quirk;
use crate::ids::Rule;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::spindle::SpindleRules;
use crate::rs274::execute::word;
use crate::rs274::modes::Modes;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl SpindleRules for LinuxCnc {
    /// Quirk rs274.speed-of-all-spindles. S without a mode sets the speed of all of them by $-1.
    /// Quirk rs274.chosen-spindle. G96 and G97 choose a spindle.
    fn spindles_of_speed(&self, words: &Words, state: &mut State) -> Result<Vec<usize>, StepError> {
        let mode_too = words.g.iter().any(|code| [960, 970].contains(code));
        let every = !mode_too && word(words, '$') == Some(-1.0);
        if every && state.shows(quirk::rs274::SPEED_OF_ALL_SPINDLES) {
            return Ok(state.all_spindles());
        }
        let spindles = Documented.spindles_of_speed(words, state)?;
        if mode_too {
            choose(spindles[0], state);
        }
        Ok(spindles)
    }

    fn set_speed_of(&self, place: usize, speed: f64, state: &mut State) {
        Documented.set_speed_of(place, speed, state);
        speed_while_standing(place, state);
    }

    fn set_turn(&self, turn: SpindleTurn, place: usize, state: &mut State) {
        state.modes.memory.get_mut().taken_for_stopped.remove(&place);
        set_released(false, place, state);
        Documented.set_turn(turn, place, state);
    }

    /// Quirk rs274.orient-forgets-turning. A spindle that is taken for stopped is, however it turns.
    fn known_turn(&self, place: usize, state: &State) -> SpindleTurn {
        known_turn(place, &state.modes)
    }

    /// Quirk rs274.spindle-number-cut. The fraction of $ is cut off.
    fn named_spindle(&self, number: f64, state: &State, rule: Rule) -> Result<usize, StepError> {
        let cut = state.shows(quirk::rs274::SPINDLE_NUMBER_CUT);
        Documented.named_spindle(if cut { number.trunc() } else { number }, state, rule)
    }
}

/// Quirk rs274.orient-forgets-turning. How the interpreter takes a spindle to turn.
pub(super) fn known_turn(place: usize, modes: &Modes) -> SpindleTurn {
    let turn = modes.spindles[place].turn;
    let turns = matches!(turn, SpindleTurn::Clockwise | SpindleTurn::Counterclockwise);
    if turns && modes.memory.get().taken_for_stopped.contains(&place) {
        return SpindleTurn::Stopped;
    }
    turn
}

/// Quirk rs274.chosen-spindle. A block with G33, G33.1 or G76 and a $, and one with G93 to G97, where no $ means
/// spindle 0, choose the spindle that cycles, synchronised moves and feeds per revolution follow where they have no
/// $.
pub(super) fn choose(place: usize, state: &mut State) {
    if state.shows(quirk::rs274::CHOSEN_SPINDLE) {
        state.memory.chosen_spindle = place;
    }
}

/// Quirk linuxcnc.speed-releases-brake. A speed releases the brake of a spindle that stands, until the next stop.
pub(super) fn speed_while_standing(place: usize, state: &mut State) {
    if state.shows(quirk::linuxcnc::SPEED_RELEASES_BRAKE) {
        set_released(true, place, state);
    }
}

/// The brake of a spindle is released, or is no longer: its pin has to be looked at.
pub(super) fn set_released(released: bool, place: usize, state: &mut State) {
    let all = &mut state.modes.memory.get_mut().brake_released;
    let changes = if released { all.insert(place) } else { all.remove(&place) };
    if changes {
        state.pin_snapshot = None;
    }
}
