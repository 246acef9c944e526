//! What puts a waiting move out, and the end of a compensated path.

use gaugeblock_vocabulary::{Compensation, Position};

use super::orientation::shifted;
use super::surroundings::Surroundings;
use super::{gouges, slack};
use crate::ids::rule;
use crate::rs274::execute::plane_axes::axes;
use crate::rs274::planar::{InPlane, Leg};
use crate::rs274::refusal::StepError;
use crate::rs274::state::{Contour, Exit, State};
use crate::rs274::task::Record;

/// Rule compensation.next-move. Puts out what waits: the last move in the plane ends where its own curve does.
///
/// # Errors
/// The tool does not fit.
pub(crate) fn put_out(state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let Some(path) = state.contour.path.as_ref().filter(|path| path.waits) else { return Ok(()) };
    check_fit(&path.last, path.last.end, state)?;
    state.coverage.accepted(rule::compensation::NEXT_MOVE);
    stop_waiting(state, record);
    Ok(())
}

/// The end of the last move is known.
pub(super) fn stop_waiting(state: &mut State, record: &mut Record) {
    if let Some(path) = &mut state.contour.path {
        path.waits = false;
    }
    record.put_out();
}

/// Rule compensation.gouging. A move is refused if the corner before it has left nothing of it. The entry is not checked, nor a
/// move right after a pause.
pub(super) fn check_fit(leg: &Leg, end: InPlane, state: &State) -> Result<(), StepError> {
    if leg.has_to_fit && !leg.fits(end, slack(state)) {
        let message = "the tool does not fit between the corners of a move";
        return Err(gouges(rule::compensation::GOUGING, message));
    }
    Ok(())
}

/// G40: what waits is put out, and the programmed point is current again.
///
/// # Errors
/// The tool does not fit.
pub(super) fn switch_off(state: &mut State, record: &mut Record) -> Result<(), StepError> {
    put_out(state, record)?;
    let tool = tool_point(state);
    let path = state.contour.path.take();
    if let Some(path) = &path {
        state.position = path.programmed;
    }
    if state.modes.compensation != Compensation::Off
        && state.dialect().has_exit(path.is_some(), state)
    {
        let (Position { x, y, z, .. }, here) = (tool, state.position);
        let diameter = 2.0 * state.modes.compensation_radius.abs();
        let new = Exit {
            diameter,
            tool: [x - here.x, y - here.y, z - here.z],
            rotation: state.modes.rotation,
        };
        // After another end of compensation the tool has not moved yet.
        let exit = state.contour.exit.unwrap_or(new);
        state.contour.exit = Some(Exit { diameter: exit.diameter.max(diameter), ..exit });
    }
    Ok(())
}

/// Where the machine has led the tool: the end of the last move, with the shift of its orientation along a path.
fn tool_point(state: &mut State) -> Position {
    if state.contour.path.is_none() {
        return state.position;
    }
    axes(state).map_or(state.position, |axes| {
        axes.with(state.position, shifted(axes.in_plane(state.position), state))
    })
}

/// The program has ended: the tool is where its last move has led it.
pub(crate) fn end_of_run(state: &mut State) {
    state.contour = Contour::default();
}

/// Modes were restored while the cutter was compensated along a path. A restore of G40 acts as G40.
///
/// # Errors
/// A restore of the other side is open, and so are other coordinates along the path.
pub(crate) fn restored(
    before: Option<Surroundings>,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let Some(before) = before else { return Ok(()) };
    before.check(state)?;
    if state.modes.compensation == Compensation::Off {
        return switch_off(state, record);
    }
    if !before.is_same_side(state) {
        let why = "a restore of the other side of a compensated path";
        return Err(StepError::Unspecified(why.to_owned()));
    }
    Ok(())
}
