//! Quirks of the whole controller.

use std::borrow::Cow;

use gaugeblock_vocabulary::{ControllerMode, End, Position, SpindleLimit, SpindleMode};

use super::spindle::{set_released, speed_while_standing};
use super::{LinuxCnc, Shows};
use crate::Choices;
use crate::dialects::quirk;
use crate::rs274::control::{Control, Frame};
use crate::rs274::dialect::Documented;
use crate::rs274::modes::{Modes, Spindle, converted};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;
use crate::rs274::task::TaskRules;

impl TaskRules for LinuxCnc {
    /// Quirk rs274.stored-rotation. Where the machine is at the start is told without the stored rotation.
    fn stand_at_start(&self, state: &mut State) {
        Documented.stand_at_start(state);
        if state.shows(quirk::rs274::STORED_ROTATION) {
            let seen = Modes { rotation: 0.0, ..state.modes.clone() };
            state.position = seen.program_point(Position::default());
        }
        if state.shows(quirk::linuxcnc::MODES_OF_LAST_MOTION) {
            state.memory.at_last_motion = Some(Box::new(state.modes.clone()));
        }
    }

    /// Quirk rs274.surface-limit-zero. Surface speed that is limited to zero is reported as revolutions per minute.
    fn reported_modes<'s>(&self, state: &'s State) -> Cow<'s, Modes> {
        let limited = |spindle: &Spindle| spindle.limit == SpindleLimit::Rpm(0.0);
        let any = state.modes.spindles.iter().any(limited);
        if !any || !state.shows(quirk::rs274::SURFACE_LIMIT_ZERO) {
            return Documented.reported_modes(state);
        }
        let mut modes = state.modes.clone();
        for spindle in modes.spindles.iter_mut().filter(|spindle| limited(spindle)) {
            spindle.mode = SpindleMode::Rpm;
            spindle.limit = SpindleLimit::None;
        }
        Cow::Owned(modes)
    }

    /// Quirk linuxcnc.returned-value-kept. It is still there.
    fn forget_returned_value(&self, state: &mut State) {
        if !state.shows(quirk::linuxcnc::RETURNED_VALUE_KEPT) {
            Documented.forget_returned_value(state);
        }
    }

    /// Quirk linuxcnc.modes-of-last-motion. An abort brings back the modes that were in force at the last motion, or
    /// at the beginning where nothing has moved, then without the speeds; but not the motion mode itself, and none
    /// where that motion was in a sub.
    fn change_modes_at_abort(&self, state: &mut State) -> bool {
        let Some(modes) = state.memory.at_last_motion.clone() else {
            return Documented.change_modes_at_abort(state);
        };
        let machine = state.modes.machine_point(state.position);
        let machine = converted(machine, state.modes.units, modes.units);
        let restored = Modes { motion: state.modes.motion, ..*modes };
        let before = std::mem::replace(&mut state.modes, restored);
        state.position = state.modes.program_point(machine);
        for (place, spindle) in before.spindles.iter().enumerate() {
            let released = before.memory.get().brake_released.contains(&place);
            set_released(released, place, state);
            if !state.memory.has_moved {
                state.modes.spindles[place].speed = spindle.speed;
            } else if (state.modes.spindles[place].speed - spindle.speed).abs() > 0.0 {
                speed_while_standing(place, state);
            }
        }
        true
    }

    /// Quirk linuxcnc.auto-while-running. A request for the mode that a program runs in drops the program.
    fn request_same_mode(&self, is_running: bool, state: &State) -> Result<(), StepError> {
        let auto = state.modes.controller_mode == ControllerMode::Auto;
        if is_running && auto && state.shows(quirk::linuxcnc::AUTO_WHILE_RUNNING) {
            return Err(StepError::Ended(End::Aborted));
        }
        Documented.request_same_mode(is_running, state)
    }

    /// Quirk linuxcnc.cycle-start-while-paused. It is refused.
    fn goes_on_after_pallets(&self, state: &State) -> bool {
        !state.shows(quirk::linuxcnc::CYCLE_START_WHILE_PAUSED)
            && Documented.goes_on_after_pallets(state)
    }

    /// Quirk rs274.fanuc-changes-at-end. What a subprogram changed of #1 to #30 is lost: they are those at the last
    /// O-word call.
    fn arguments_left(&self, called: &Frame, control: &Control, choices: &Choices) -> [f64; 30] {
        if choices.shows(quirk::rs274::FANUC_CHANGES_AT_END) {
            return control.memory.at_last_call;
        }
        Documented.arguments_left(called, control, choices)
    }
}

/// Quirk linuxcnc.modes-of-last-motion. Something moves, in the modes that are in force.
pub(super) fn moved(state: &mut State) {
    if state.shows(quirk::linuxcnc::MODES_OF_LAST_MOTION) {
        let in_main = state.call_level() == 0;
        state.memory.at_last_motion = in_main.then(|| Box::new(state.modes.clone()));
        state.memory.has_moved = true;
    }
}
