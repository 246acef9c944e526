//! The stub of the interpreter program `rs274` in place of a machine: a point that follows the reported moves.
//!
//! It is told of moves, coordinate systems and local offsets, but not of tool offsets, nor of how a coordinate system
//! is turned. Where the interpreter asks for the point, after M6, M61 and G10 L0, it gets one that those have not
//! changed.

use gaugeblock_vocabulary::{Axis, LengthUnit, Position};

use super::Input;
use super::state::{EnvironmentState, Stands};
use crate::math;
use crate::rs274::modes::{converted, each};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl EnvironmentState {
    /// The executed block queries the position of the machine at its end.
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

/// How a block moves the stub of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BlockMotion {
    /// The block has no motion.
    None,
    /// The stub follows the moves.
    Moves,
    /// A spline leads the stub to X0 Y0 of the program, wherever the spline ends.
    Spline,
    /// After a spline of three control points, X and Y of the stub may not be numbers.
    NoPoint,
}

/// M61 names a tool: the words of its block take it to be in the spindle. At the end of the block the stub reports the
/// tool of the last M6 again. It reports nothing of M61 Q0.
pub(crate) fn names_tool(tool: i32, state: &mut State) {
    if tool > 0 {
        state.environment.stub.tool_after_block.get_or_insert(state.known_tool);
        state.known_tool = tool;
    }
}

/// The end of a block: the stub follows its moves, and answers its query of the position.
///
/// # Errors
/// The block queries a position that is not a number.
pub(crate) fn after_block(motion: BlockMotion, state: &mut State) -> Result<(), StepError> {
    let asked = std::mem::take(&mut state.environment.stub.asked);
    if let Some(tool) = state.environment.stub.tool_after_block.take() {
        state.known_tool = tool;
    }
    if !state.environment.is_stand_alone() {
        return Ok(());
    }
    let here = coordinates(state);
    let (point, lost) = match motion {
        BlockMotion::Moves => (state.position, false),
        BlockMotion::Spline => {
            let unknown = state.modes.rounding.of_nothing();
            (Position { x: unknown, y: unknown, ..here }, false)
        }
        BlockMotion::NoPoint => (here, true),
        BlockMotion::None => {
            if asked && state.environment.stub.lost {
                let why = "the position of a machine's stub after a spline of three points";
                return Err(StepError::Unspecified(why.to_owned()));
            }
            if asked {
                state.position = here;
            }
            return Ok(());
        }
    };
    state.environment.stub.stands = stands_at(point, state);
    state.environment.stub.lost = lost;
    state.environment.stub.led = motion == BlockMotion::Spline;
    Ok(())
}

fn stands_at(point: Position, state: &State) -> Stands {
    Stands { point, offset: offset(state), units: state.modes.units }
}

/// The controlled point after probing. With a machine it is where the machine stops. The stub retracts 0.01 inch from
/// the programmed point, along the linear axes, toward its position before the move.
///
/// # Errors
/// The direction of the retraction is unknown: the move has no length, and the position of the stub after a spline is
/// known except for a rounding error. Or the spline has three points: whether the stub follows it depends on what the
/// program has executed before.
pub(crate) fn after_probing(
    programmed: Position,
    stops_at: Position,
    state: &State,
) -> Result<Position, StepError> {
    if !state.environment.is_stand_alone() {
        return Ok(stops_at);
    }
    if state.environment.stub.lost {
        let why = "where a machine's stub retracts after a spline of three points";
        return Err(StepError::Unspecified(why.to_owned()));
    }
    let from = coordinates(state);
    let linear = [Axis::X, Axis::Y, Axis::Z];
    let back = match state.modes.units {
        LengthUnit::Inch => 0.01,
        LengthUnit::Millimetre => 0.254,
    };
    let way = linear.map(|axis| programmed.get(axis) - from.get(axis));
    let length = math::hypotenuse(math::hypotenuse(way[0], way[1]), way[2]);
    let mut end = programmed;
    // After a spline the stub is at X0 Y0, except for an unknown rounding error.
    if length == 0.0 && state.environment.stub.led {
        let why = "in which direction a machine's stub retracts from where a spline has led it";
        return Err(StepError::Unspecified(why.to_owned()));
    }
    if length > 0.0 {
        for (axis, way) in linear.into_iter().zip(way) {
            *end.get_mut(axis) -= back * way / length;
        }
    }
    Ok(end)
}

/// The position of the stub, active length unit; X and Y are the last ones that are numbers.
fn coordinates(state: &State) -> Position {
    let Stands { point, offset: known, units } = state.environment.stub.stands;
    let offset = offset(state);
    if units == state.modes.units && known == offset {
        return point;
    }
    let point = each(point, known, |point, offset| point + offset);
    let point = converted(point, units, LengthUnit::Millimetre);
    let point = converted(point, LengthUnit::Millimetre, state.modes.units);
    each(point, offset, |point, offset| point - offset)
}

/// The offsets that are reported to the stub.
fn offset(state: &State) -> Position {
    each(state.modes.g5x_offset, state.modes.g92_offset, |system, local| system + local)
}

#[cfg(test)]
mod tests {
    use gaugeblock_vocabulary::{End, Options, Scenario};

    use super::*;
    use crate::rs274::modes::Rounding;

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

    #[test]
    fn nobody_knows_which_way_it_backs_off_that_stands_where_a_spline_has_led_it() {
        let end = |probe| end_behind_spline(probe, Rounding::AsComputed);
        assert!(matches!(end("g38.3 x0"), End::Unspecified { .. }));
        assert_eq!(end("g38.3 z-1"), End::ProgramEnd);
    }

    #[test]
    fn a_small_arc_hangs_on_numbers_that_nobody_knows_behind_a_spline() {
        let end = |rounding| end_behind_spline("g38.3 z1\ng2 x0 r0.001", rounding);
        assert!(matches!(end(Rounding::AsComputed), End::Fault(_)));
        assert_eq!(end(Rounding::Up), End::ProgramEnd);
        assert_eq!(end(Rounding::Down), End::ProgramEnd);
    }

    fn end_behind_spline(then: &str, rounding: Rounding) -> End {
        let text = format!("f1\ng5 i0 j0 p0 q0 y0\n{then}\nm2\n");
        let name = Some("stand-alone rs274".to_owned());
        let environment =
            gaugeblock_vocabulary::scenario::Environment { name, ..Default::default() };
        let moves_nowhere = ("rs274.probe-same-point".into(), "observed".into());
        let small_radius = ("arcs.radius-just-too-small".into(), "half-circle".into());
        let options = Options([moves_nowhere, small_radius].into());
        crate::run_rounded(&Scenario { environment, options, ..Scenario::of(text) }, rounding).0.end
    }
}
