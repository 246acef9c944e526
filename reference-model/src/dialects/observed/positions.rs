//! Quirks of positions of the machine.

use gaugeblock_vocabulary::{Axis, Effect, Position};

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::positions::{MachinePositionRules, traverse};
use crate::rs274::modes::units::is_rotary;
use crate::rs274::modes::{converted, each};
use crate::rs274::state::State;
use crate::rs274::task::Record;

impl MachinePositionRules for Observed {
    /// Quirk rs274.tool-offset-unit. G53, G28, G30 and M6 read the number of the tool offset in the active length unit,
    /// whatever its unit was. Quirk rs274.machine-rotary-offset. G53, G28, G30 and an M6 at the position of G30 do not
    /// take the tool offset of A, B and C into account.
    fn reached(&self, axis: Axis, coordinate: f64, state: &State) -> f64 {
        let error = if is_rotary(axis) && state.has_quirk(quirk::rs274::MACHINE_ROTARY_OFFSET) {
            state.modes.tool_offset.get(axis)
        } else {
            offset_error(state).get(axis)
        };
        // Adding a zero would change the sign of a negative zero.
        if error == 0.0 {
            return Documented.reached(axis, coordinate, state);
        }
        coordinate + error
    }

    /// Quirk rs274.position-move-in-place. G28 and G30 make a move of no length first.
    fn go_straight(&self, first: u32, state: &mut State, record: &mut Record) {
        if state.has_quirk(quirk::rs274::POSITION_MOVE_IN_PLACE) {
            traverse(state.modes.machine_point(state.position), state, record);
        }
        Documented.go_straight(first, state, record);
    }

    /// Quirk nist.home-without-rotary. The rotary axes do not move; the interpreter counts on the stored position.
    fn go_to_stored(&self, machine: Position, state: &mut State, record: &mut Record) {
        if !state.has_quirk(quirk::nist::HOME_WITHOUT_ROTARY) {
            return Documented.go_to_stored(machine, state, record);
        }
        let Position { a, b, c, .. } = state.position;
        state.position = state.modes.program_point(machine);
        record.effect(
            state,
            Effect::StraightTraverse { end: Position { a, b, c, ..state.position } },
        );
    }

    /// Quirk rs274.tool-offset-unit. Stored and measured points are off by the same distance in the other direction.
    fn measured(&self, machine: Position, state: &State) -> Position {
        each(machine, offset_error(state), |point, error| point - error)
    }
}

/// Quirk rs274.tool-offset-unit. The error of a point: the tool offset minus its number in the active length unit.
fn offset_error(state: &State) -> Position {
    if !state.has_quirk(quirk::rs274::TOOL_OFFSET_UNIT) {
        return Position::default();
    }
    let modes = &state.modes;
    let number = converted(modes.tool_offset, modes.units, modes.memory.get().tool_offset_unit);
    each(modes.tool_offset, number, |offset, number| offset - number)
}
