//! Quirks of the whole controller.

use crate::rs274::machine::State;
use crate::rs274::modes::Modes;

/// Quirk linuxcnc.modes-of-last-motion. An abort brings back the modes that were in force at the last motion.
pub(crate) fn modes_of_last_motion(modes: &Modes, state: &mut State) {
    if state.readings.quirk("linuxcnc.modes-of-last-motion") {
        let machine = state.modes.machine_point(state.position);
        state.modes = modes.clone();
        state.position = state.modes.program_point(machine);
    }
}
