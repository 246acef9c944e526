//! What the stand-alone interpreter has in place of a machine: a point that follows what it is told.
//!
//! It is told of moves, coordinate systems and local offsets, but not of tool offsets, nor of how a coordinate system is turned. Where the
//! interpreter asks for the point, after M6, M61 and G10 L0, it gets one that those have not changed.

use gaugeblock_trace::{LengthUnit, Position};

use super::{Input, Outside};
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

/// What M66 reads: what is read already, and one of a digital input where that is not zero.
pub(crate) fn answer(input: Input, read: f64) -> f64 {
    match input {
        Input::Digital(_) if read != 0.0 => 1.0,
        Input::Digital(_) | Input::Analog(_) => read,
    }
}

/// What the stub is told of a block's moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Told {
    /// There was none.
    Nothing,
    /// It follows them.
    Moves,
    /// A spline leads it to X0 Y0 of the program, wherever that ends.
    Spline,
}

/// A block is through: where it moved the stub has followed, and where it asked the stub has answered.
pub(crate) fn after_block(told: Told, state: &mut State) {
    let asked = std::mem::take(&mut state.outside.stub.asked);
    if !state.outside.is_stand_alone() {
        return;
    }
    match told {
        Told::Moves => stand_at(state.position, state),
        Told::Spline => {
            let point = Position { x: 0.0, y: 0.0, ..position(state) };
            stand_at(point, state);
        }
        Told::Nothing if asked => state.position = position(state),
        Told::Nothing => {}
    }
}

fn stand_at(point: Position, state: &mut State) {
    let point = each(point, offset(state), |point, offset| point + offset);
    state.outside.stub.point = converted(point, state.modes.units, LengthUnit::Millimetre);
}

/// Where the stub stands, active length unit.
pub(crate) fn position(state: &State) -> Position {
    let point = converted(state.outside.stub.point, LengthUnit::Millimetre, state.modes.units);
    each(point, offset(state), |point, offset| point - offset)
}

/// The offsets that it is told of.
fn offset(state: &State) -> Position {
    each(state.modes.g5x_offset, state.modes.g92_offset, |system, local| system + local)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_input_is_what_was_read_before() {
        for (input, read, expected) in [
            (Input::Digital(0), 0.0, 0.0),
            (Input::Digital(1), 0.3, 1.0),
            (Input::Digital(1), -1.0, 1.0),
            (Input::Analog(0), 0.3, 0.3),
            (Input::Analog(0), -1.0, -1.0),
        ] {
            assert!((answer(input, read) - expected).abs() < 1e-12, "{input:?} after {read}");
        }
    }
}
