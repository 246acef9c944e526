//! The move that leads away from a compensated path.

use gaugeblock_vocabulary::{Compensation, Position};

use super::{gouges, slack};
use crate::ids::rule;
use crate::math;
use crate::rs274::refusal::StepError;
use crate::rs274::state::{Exit, State};

/// A straight move, compensated or not, is about to lead away from where compensation has ended.
///
/// Rule compensation.exit. It leads from where the tool is to its programmed end.
/// Rule compensation.zero-radius. So do all moves with a radius of zero.
///
/// # Errors
/// Rule compensation.exit-length.
pub(crate) fn lead_away(end: Position, state: &mut State) -> Result<(), StepError> {
    if let Some(exit) = state.contour.exit {
        state.dialect().check_exit_line(&exit, end, state)?;
        state.coverage.accepted(rule::compensation::EXIT);
        state.contour.exit = None;
    }
    if state.modes.compensation != Compensation::Off && state.modes.compensation_radius == 0.0 {
        state.coverage.accepted(rule::compensation::ZERO_RADIUS);
    }
    Ok(())
}

/// Rule compensation.exit-length. The line after G40 is longer than the diameter of the tool.
///
/// The manual does not say whether the line begins at the programmed point or where the tool is, and calls one that is
/// as long as the diameter neither an error nor allowed.
pub(super) fn check_line(exit: &Exit, end: Position, state: &mut State) -> Result<(), StepError> {
    let here = state.position;
    let programmed = [end.x - here.x, end.y - here.y, end.z - here.z];
    let [x, y, z] = programmed;
    let travelled = [x - exit.tool[0], y - exit.tool[1], z - exit.tool[2]];
    let lengths = [programmed, travelled].map(|way| length(way) + slack(state));
    let turned = exit.rotation.to_bits() != state.modes.rotation.to_bits();
    if !turned && lengths.iter().all(|length| *length > exit.diameter) {
        state.coverage.accepted(rule::compensation::EXIT_LENGTH);
        return Ok(());
    }
    let by_other_axes = end.to_array()[3..] != here.to_array()[3..];
    if !turned && !by_other_axes && lengths.iter().all(|length| *length < exit.diameter) {
        let message = "the line after compensation is shorter than the diameter of the cutter";
        return Err(gouges(rule::compensation::EXIT_LENGTH, message));
    }
    let why = "how long the line after compensation is";
    Err(StepError::Unspecified(why.to_owned()))
}

/// The length of a way along X, Y and Z.
fn length([x, y, z]: [f64; 3]) -> f64 {
    math::hypotenuse(math::hypotenuse(x, y), z)
}
