//! Quirks of the program end.

use gaugeblock_vocabulary::{Position, SpindleLimit, SpindleMode, Switch};

use super::spindle::send_speed;
use super::task::{machine_point_in_mm, read_point_back};
use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::program_end::ProgramEndRules;
use crate::rs274::order::Phase;
use crate::rs274::state::State;
use crate::rs274::task::{Record, update_pins};

impl ProgramEndRules for Observed {
    /// Quirk rs274.spindle-mode-at-end. The program end selects G97 for all spindles.
    /// Quirk rs274.feed-zero-at-end. The program end sets the feed rate to zero.
    /// Quirk nist.offset-kept-at-end. The local offset of Y and Z is still in force, although no coordinates have it.
    fn reset_at_end(&self, state: &mut State) {
        let Position { y, z, .. } = state.modes.g92_offset;
        let leaves_surface_speed = state.has_quirk(quirk::rs274::SPINDLE_MODE_AT_END);
        if leaves_surface_speed {
            send_speeds_at_end(state);
        }
        Documented.reset_at_end(state);
        if leaves_surface_speed {
            for spindle in &mut state.modes.spindles {
                spindle.mode = SpindleMode::Rpm;
                spindle.limit = SpindleLimit::None;
            }
        }
        if state.has_quirk(quirk::nist::OFFSET_KEPT_AT_END) {
            state.modes.g92_offset = Position { y, z, ..state.modes.g92_offset };
        }
        if state.has_quirk(quirk::rs274::FEED_ZERO_AT_END) {
            state.modes.feed_rate = 0.0;
            state.modes.memory.get_mut().has_read_end = true;
        }
    }

    /// Quirk rs274.rotation-under-local-offset. The program end rotates back to G54 without the local offset.
    fn select_first_system(&self, state: &mut State) {
        without_local_offset(|state| Documented.select_first_system(state), state);
    }

    /// Quirk rs274.speed-override-at-end. The program end does not change the speed overrides.
    fn enable_overrides_at_end(&self, state: &mut State) {
        if state.has_quirk(quirk::rs274::SPEED_OVERRIDE_AT_END) {
            state.modes.feed_override = Switch::On;
            return;
        }
        Documented.enable_overrides_at_end(state);
    }

    /// Quirk linuxcnc.auto-after-program-end. The controller stays in auto mode.
    /// Quirk linuxcnc.point-read-back. The interpreter reads back where the machine is.
    fn change_mode_at_end(&self, state: &mut State, record: &mut Record) {
        read_point_back(state);
        if !state.has_quirk(quirk::linuxcnc::AUTO_AFTER_PROGRAM_END) {
            Documented.change_mode_at_end(state, record);
        }
    }
}

/// Quirk rs274.spindle-mode-at-end. With the new mode, the machine gets the speed of each spindle that followed G96,
/// before the spindles are stopped.
fn send_speeds_at_end(state: &mut State) {
    let read_back = std::mem::take(&mut state.memory.follows_surface_speed);
    let mut may_change_pins = false;
    for place in state.all_spindles() {
        let by_mode = state.modes.spindles[place].mode == SpindleMode::SurfaceSpeed;
        if by_mode || read_back.contains(&place) {
            may_change_pins |= send_speed(place, state);
        }
    }
    if may_change_pins {
        update_pins(state, Some(Phase::SpindleSpeed));
    }
}

/// Quirk rs274.rotation-under-local-offset. When G10 L2 rotates the active system, or the program end returns to
/// the rotation of G54, the controlled point is rotated as if the local offset were zero. The offset does not change.
pub(super) fn without_local_offset(turn: fn(&mut State), state: &mut State) {
    if !state.has_quirk(quirk::rs274::ROTATION_UNDER_LOCAL_OFFSET) {
        return turn(state);
    }
    let machine = machine_point_in_mm(&state.modes, state.position);
    state.memory.machine_point.get_or_insert(machine);
    let local = std::mem::take(&mut state.modes.g92_offset);
    turn(state);
    state.modes.g92_offset = local;
}
