//! Quirks of the whole controller.

use gaugeblock_vocabulary::ControllerMode;

use super::settings::speed_while_standing;
use crate::ids::quirk;
use crate::rs274::modes::{Modes, converted};
use crate::rs274::state::State;

/// Quirk linuxcnc.modes-of-last-motion. An abort brings back the modes that were in force at the last motion, or at
/// the beginning where nothing has moved, then without the speeds; but not the motion mode itself, and none where
/// that motion was in a sub.
pub(crate) fn modes_of_last_motion(modes: &Modes, has_moved: bool, state: &mut State) {
    if state.choices.quirk(quirk::linuxcnc::MODES_OF_LAST_MOTION) {
        let machine = state.modes.machine_point(state.position);
        let machine = converted(machine, state.modes.units, modes.units);
        let restored = Modes { motion: state.modes.motion, ..modes.clone() };
        let before = std::mem::replace(&mut state.modes, restored);
        state.position = state.modes.program_point(machine);
        for (place, spindle) in before.spindles.iter().enumerate() {
            state.modes.spindles[place].brake_released = spindle.brake_released;
            if !has_moved {
                state.modes.spindles[place].speed = spindle.speed;
            } else if (state.modes.spindles[place].speed - spindle.speed).abs() > 0.0 {
                speed_while_standing(place, state);
            }
        }
    }
}

/// Quirk linuxcnc.auto-while-running. A request for the mode that a program runs in drops the program.
pub(crate) fn drops_program(mode: ControllerMode, state: &State) -> bool {
    mode == ControllerMode::Auto && state.choices.quirk(quirk::linuxcnc::AUTO_WHILE_RUNNING)
}

/// Quirk linuxcnc.returned-value-kept. What the last sub has returned is still there when a program starts.
pub(crate) fn keeps_value(state: &State) -> bool {
    state.choices.quirk(quirk::linuxcnc::RETURNED_VALUE_KEPT)
}
