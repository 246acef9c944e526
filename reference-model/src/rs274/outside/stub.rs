//! What the stand-alone interpreter has in place of a machine: a point that follows what it is told.
//!
//! It is told of moves, coordinate systems and local offsets, but not of tool offsets, nor of how a coordinate system is turned. Where the
//! interpreter asks for the point, after M6, M61 and G10 L0, it gets one that those have not changed.

use gaugeblock_trace::{LengthUnit, Position};

use super::Outside;
use crate::rs274::machine::State;
use crate::rs274::modes::{converted, each};

/// The stub of a machine.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stub {
    /// The point, in millimetres and degrees, as far as it is told.
    point: Position,
    /// Whether the block that is executed asks for it.
    asked: bool,
}

impl Outside {
    /// The block that is executed asks the machine where it stands once it is through.
    pub(crate) fn machine_is_asked(&mut self) {
        self.stub.asked = true;
    }
}

/// A block is through: where it moved the stub has followed, and where it asked the stub has answered.
pub(crate) fn after_block(moved: bool, state: &mut State) {
    let asked = std::mem::take(&mut state.outside.stub.asked);
    if !state.outside.is_stand_alone() {
        return;
    }
    let modes = &state.modes;
    let offset = each(modes.g5x_offset, modes.g92_offset, |system, local| system + local);
    if moved {
        let point = each(state.position, offset, |point, offset| point + offset);
        state.outside.stub.point = converted(point, modes.units, LengthUnit::Millimetre);
    } else if asked {
        let point = converted(state.outside.stub.point, LengthUnit::Millimetre, modes.units);
        state.position = each(point, offset, |point, offset| point - offset);
    }
}
