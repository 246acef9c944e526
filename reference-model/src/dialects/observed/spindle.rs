//! Quirks of spindles.

use gaugeblock_vocabulary::SpindleTurn;

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::ids::Rule;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::spindle::SpindleRules;
use crate::rs274::execute::{clear_orientation, word};
use crate::rs274::modes::Modes;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl SpindleRules for Observed {
    /// Quirk rs274.speed-of-all-spindles. S with $-1 and without G96 or G97 sets the speed of all spindles.
    /// Quirk rs274.chosen-spindle. G96 and G97 select the spindle of later blocks without $.
    fn spindles_of_speed(&self, words: &Words, state: &mut State) -> Result<Vec<usize>, StepError> {
        let mode_too = words.g_tenths.iter().any(|code| [960, 970].contains(code));
        let every = !mode_too && word(words, '$') == Some(-1.0);
        if every && state.has_quirk(quirk::rs274::SPEED_OF_ALL_SPINDLES) {
            return Ok(state.all_spindles());
        }
        let spindles = Documented.spindles_of_speed(words, state)?;
        if mode_too {
            choose_spindle(spindles[0], state);
            state.memory.follows_surface_speed.retain(|place| !spindles.contains(place));
        }
        Ok(spindles)
    }

    fn set_speed_of(&self, place: usize, speed: f64, state: &mut State) {
        Documented.set_speed_of(place, speed, state);
        send_speed(place, state);
    }

    fn set_turn(&self, turn: SpindleTurn, place: usize, state: &mut State) {
        state.modes.memory.get_mut().regarded_as_stopped.remove(&place);
        set_released(false, place, state);
        Documented.set_turn(turn, place, state);
    }

    /// Quirk linuxcnc.speed-while-oriented. An oriented spindle that got a speed turns as it did before M19.
    fn commanded_turn(&self, place: usize, state: &State) -> SpindleTurn {
        let turn = Documented.commanded_turn(place, state);
        if turn == SpindleTurn::Oriented && state.memory.turning_again.contains(&place) {
            return state.memory.turned_before.get(&place).copied().unwrap_or(turn);
        }
        turn
    }

    /// Quirk rs274.orient-forgets-turning. A spindle that the interpreter regards as stopped is reported as stopped.
    fn known_turn(&self, place: usize, state: &State) -> SpindleTurn {
        known_turn(place, &state.modes)
    }

    /// Quirk rs274.spindle-number-cut. The fraction of $ is cut off.
    fn named_spindle(&self, number: f64, state: &State, rule: Rule) -> Result<usize, StepError> {
        let cut = state.has_quirk(quirk::rs274::SPINDLE_NUMBER_CUT);
        Documented.named_spindle(if cut { number.trunc() } else { number }, state, rule)
    }
}

/// Quirk rs274.orient-forgets-turning. The turning of a spindle as the interpreter regards it.
pub(super) fn known_turn(place: usize, modes: &Modes) -> SpindleTurn {
    let turn = modes.spindles[place].turn;
    let turns = matches!(turn, SpindleTurn::Clockwise | SpindleTurn::Counterclockwise);
    if turns && modes.memory.get().regarded_as_stopped.contains(&place) {
        return SpindleTurn::Stopped;
    }
    turn
}

/// Quirk rs274.chosen-spindle. Selects the spindle of later cycles, synchronised moves and feeds per revolution without
/// $. A $ in a block with G33, G33.1 or G76 selects it; so does a block with G93 to G97, in which no $ means spindle 0.
pub(super) fn choose_spindle(place: usize, state: &mut State) {
    if state.has_quirk(quirk::rs274::CHOSEN_SPINDLE) {
        state.memory.chosen_spindle = place;
    }
}

/// The machine gets the speed of a spindle. Whether that may change more than the speed.
///
/// Quirk linuxcnc.speed-releases-brake. It releases the brake of a spindle that is stopped, until the next stop.
/// Quirk linuxcnc.speed-while-oriented. It unlocks an oriented spindle, which then turns as it did before M19.
pub(super) fn send_speed(place: usize, state: &mut State) -> bool {
    let releases = state.has_quirk(quirk::linuxcnc::SPEED_RELEASES_BRAKE);
    if releases {
        set_released(true, place, state);
    }
    let is_oriented = state.modes.spindles[place].turn == SpindleTurn::Oriented;
    let unlocks = is_oriented && state.has_quirk(quirk::linuxcnc::SPEED_WHILE_ORIENTED);
    if unlocks {
        clear_orientation(place, state);
        state.memory.turning_again.insert(place);
        state.pin_snapshot = None;
    }
    releases || unlocks
}

/// Records whether an S word has released the brake of a spindle. If that changes, the pins are computed again.
pub(super) fn set_released(released: bool, place: usize, state: &mut State) {
    let all = &mut state.modes.memory.get_mut().brake_released;
    let changes = if released { all.insert(place) } else { all.remove(&place) };
    if changes {
        state.pin_snapshot = None;
    }
}
