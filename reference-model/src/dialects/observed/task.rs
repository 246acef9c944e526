//! Quirks of the whole controller.

use std::borrow::Cow;

use gaugeblock_vocabulary::{
    ControllerMode, End, Fault, LengthUnit, Position, SpindleLimit, SpindleMode,
};

use super::spindle::{send_speed, set_released};
use super::{HasQuirk, Observed};
use crate::Choices;
use crate::dialects::quirk;
use crate::rs274::control::{Control, Frame};
use crate::rs274::dialect::Documented;
use crate::rs274::modes::{Modes, Spindle, converted};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;
use crate::rs274::task::TaskRules;

impl TaskRules for Observed {
    /// Quirk rs274.stored-rotation. The position at the start is reported without the stored rotation.
    fn stand_at_start(&self, state: &mut State) {
        Documented.stand_at_start(state);
        if state.has_quirk(quirk::rs274::STORED_ROTATION) {
            let unrotated = Modes { rotation: 0.0, ..state.modes.clone() };
            state.position = unrotated.program_point(Position::default());
        }
    }

    /// Quirk rs274.surface-limit-zero. G96 with a limit of zero is reported as G97.
    fn reported_modes<'s>(&self, state: &'s State) -> Cow<'s, Modes> {
        let limited = |spindle: &Spindle| spindle.limit == SpindleLimit::Rpm(0.0);
        let any = state.modes.spindles.iter().any(limited);
        if !any || !state.has_quirk(quirk::rs274::SURFACE_LIMIT_ZERO) {
            return Documented.reported_modes(state);
        }
        let mut modes = state.modes.clone();
        for spindle in modes.spindles.iter_mut().filter(|spindle| limited(spindle)) {
            spindle.mode = SpindleMode::Rpm;
            spindle.limit = SpindleLimit::None;
        }
        Cow::Owned(modes)
    }

    /// Quirk linuxcnc.returned-value-kept. The next program can read the value that the last one returned.
    fn forget_returned_value(&self, state: &mut State) {
        if !state.has_quirk(quirk::linuxcnc::RETURNED_VALUE_KEPT) {
            Documented.forget_returned_value(state);
        }
    }

    /// Quirk linuxcnc.value-lost-in-mdi. In MDI mode what a sub has returned is zero.
    fn mode_has_changed(&self, state: &mut State) {
        let is_mdi = state.modes.controller_mode == ControllerMode::Mdi;
        if is_mdi && state.has_quirk(quirk::linuxcnc::VALUE_LOST_IN_MDI) {
            state.parameters.returned = 0.0;
            state.parameters.has_returned = false;
        }
    }

    /// Quirk linuxcnc.modes-of-last-motion. An abort restores the modes that were active at the last motion, except the
    /// motion mode, and F once a program end has been read. If no motion was executed, or the last one was in a sub, it
    /// restores nothing.
    /// Quirk linuxcnc.spindle-mode-read-back. It sets every spindle to revolutions mode.
    fn change_modes_at_abort(&self, state: &mut State) -> bool {
        let Some(modes) = state.memory.at_last_motion.clone() else {
            return read_spindle_modes_back(state);
        };
        let machine = state.modes.machine_point(state.position);
        let machine = converted(machine, state.modes.units, modes.units);
        let restored = Modes { motion: state.modes.motion, ..*modes };
        let before = std::mem::replace(&mut state.modes, restored);
        if before.memory.get().has_read_end {
            state.modes.feed_rate = before.feed_rate;
        }
        state.position = state.modes.program_point(machine);
        for (place, spindle) in before.spindles.iter().enumerate() {
            let released = before.memory.get().brake_released.contains(&place);
            set_released(released, place, state);
            if (state.modes.spindles[place].speed - spindle.speed).abs() > 0.0 {
                send_speed(place, state);
            }
        }
        read_spindle_modes_back(state);
        true
    }

    /// Quirk linuxcnc.auto-while-running. A request for auto mode while a program runs in it aborts the program.
    fn request_same_mode(&self, is_running: bool, state: &State) -> Result<(), StepError> {
        let auto = state.modes.controller_mode == ControllerMode::Auto;
        if is_running && auto && state.has_quirk(quirk::linuxcnc::AUTO_WHILE_RUNNING) {
            return Err(StepError::Ended(End::Aborted));
        }
        Documented.request_same_mode(is_running, state)
    }

    /// Quirk linuxcnc.fault-read-ahead. A block that is refused while it is read ahead ends the program at once. How
    /// many of the blocks before it have been executed by then is chance.
    fn end_before_fault(&self, fault: Fault, is_first: bool, state: &State) -> End {
        if !state.has_quirk(quirk::linuxcnc::FAULT_READ_AHEAD) {
            return Documented.end_before_fault(fault, is_first, state);
        }
        match fault.block {
            Some(block) if !is_first => {
                let why = "how much is executed before a fault that is found by reading ahead";
                End::Unspecified { block, why: why.to_owned() }
            }
            _ => End::Fault(fault),
        }
    }

    /// Quirk linuxcnc.cycle-start-while-paused. Cycle start is refused while the program pauses at M60.
    fn goes_on_after_pallets(&self, state: &State) -> bool {
        !state.has_quirk(quirk::linuxcnc::CYCLE_START_WHILE_PAUSED)
            && Documented.goes_on_after_pallets(state)
    }

    /// Quirk rs274.fanuc-changes-at-end. When a subprogram ends, #1 to #30 get the values that they had at the last
    /// O-word call: changes by the subprogram are lost.
    fn arguments_left(&self, called: &Frame, control: &Control, choices: &Choices) -> [f64; 30] {
        if choices.has_quirk(quirk::rs274::FANUC_CHANGES_AT_END) {
            return control.memory.at_last_call;
        }
        Documented.arguments_left(called, control, choices)
    }
}

/// Quirk linuxcnc.modes-of-last-motion. Records the active modes at a motion.
///
/// Quirk linuxcnc.point-read-back. A motion leads to a point that the interpreter knows, except some taps.
pub(super) fn record_modes_at_motion(state: &mut State) {
    state.memory.machine_point = state.memory.led_to.take();
    if state.has_quirk(quirk::linuxcnc::MODES_OF_LAST_MOTION) {
        if state.modes.memory.get().has_read_end {
            state.modes.memory.get_mut().has_read_end = false;
        }
        let in_main = state.call_level() == 0;
        state.memory.at_last_motion = in_main.then(|| Box::new(state.modes.clone()));
    }
}

/// Updates the state after the interpreter has waited for the machine.
pub(super) fn synchronise(state: &mut State) {
    read_point_back(state);
    read_spindle_modes_back(state);
}

/// Quirk linuxcnc.spindle-mode-read-back. Every spindle is in revolutions mode; the speed of one under G96 follows it
/// still. Whether a mode has changed.
fn read_spindle_modes_back(state: &mut State) -> bool {
    let mut has_changed = false;
    if state.has_quirk(quirk::linuxcnc::SPINDLE_MODE_READ_BACK) {
        for (place, spindle) in state.modes.spindles.iter_mut().enumerate() {
            if spindle.mode == SpindleMode::SurfaceSpeed {
                state.memory.follows_surface_speed.insert(place);
                spindle.mode = SpindleMode::Rpm;
                has_changed = true;
            }
        }
    }
    has_changed
}

/// Quirk linuxcnc.point-read-back. Sets the controlled point from the machine.
pub(super) fn read_point_back(state: &mut State) {
    if let Some(machine) = state.memory.machine_point.take()
        && state.has_quirk(quirk::linuxcnc::POINT_READ_BACK)
    {
        let machine = converted(machine, LengthUnit::Millimetre, state.modes.units);
        state.position = state.modes.program_point(machine);
    }
}

/// Where the machine is at a point of the program, in its own coordinates and in millimetres.
pub(super) fn machine_point_in_mm(modes: &Modes, point: Position) -> Position {
    converted(modes.machine_point(point), modes.units, LengthUnit::Millimetre)
}
