//! Quirks of positions of the machine.

use gaugeblock_vocabulary::{Axis, Position};

use super::{LinuxCnc, Shows};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::positions::{MachinePositionRules, traverse};
use crate::rs274::modes::units::is_rotary;
use crate::rs274::modes::{converted, each};
use crate::rs274::state::State;
use crate::rs274::task::Record;

impl MachinePositionRules for LinuxCnc {
    /// Quirk rs274.tool-offset-unit. G53, G28, G30 and M6 take the number of the tool offset for one of the active
    /// length unit. Quirk rs274.machine-rotary-offset. G53, G28, G30 and an M6 at the position of G30 do not take the
    /// tool offset of A, B and C into account.
    fn reached(&self, axis: Axis, coordinate: f64, state: &State) -> f64 {
        let by = if is_rotary(axis) && state.shows(quirk::rs274::MACHINE_ROTARY_OFFSET) {
            state.modes.tool_offset.get(axis)
        } else {
            beside(state).get(axis)
        };
        // Nothing moves nothing, not even a zero out of its quadrant.
        if by == 0.0 {
            return Documented.reached(axis, coordinate, state);
        }
        coordinate + by
    }

    /// Quirk rs274.position-move-in-place. A move of no length goes before.
    fn go_straight(&self, first: u32, state: &mut State, record: &mut Record) {
        if state.shows(quirk::rs274::POSITION_MOVE_IN_PLACE) {
            traverse(state.modes.machine_point(state.position), state, record);
        }
        Documented.go_straight(first, state, record);
    }

    /// Quirk rs274.tool-offset-unit. What is stored and measured is beside the point as far in the other direction.
    fn measured(&self, machine: Position, state: &State) -> Position {
        each(machine, beside(state), |point, beside| point - beside)
    }
}

/// Quirk rs274.tool-offset-unit. How far a point is beside the one that is meant, active length unit.
fn beside(state: &State) -> Position {
    if !state.shows(quirk::rs274::TOOL_OFFSET_UNIT) {
        return Position::default();
    }
    let modes = &state.modes;
    let number = converted(modes.tool_offset, modes.units, modes.memory.get().tool_offset_unit);
    each(modes.tool_offset, number, |offset, number| offset - number)
}
