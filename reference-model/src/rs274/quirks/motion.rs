//! Quirks of moves, arcs, rotated systems and the tool table.

use gaugeblock_vocabulary::{Distance, FaultKind, FeedMode, Motion, Plane};

use crate::ids::quirk;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::motion::{is_arc, motion_of};
use crate::rs274::execute::word;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Quirk rs274.machine-without-axes. G53 needs no axis word where G0 or G1 stands in its block.
pub(crate) fn machine_without_axes(words: &Words, state: &State) -> bool {
    let programmed = words.g.iter().any(|code| [0, 10].contains(code));
    programmed && state.choices.quirk(quirk::rs274::MACHINE_WITHOUT_AXES)
}

/// Quirk rs274.machine-zero-sign. G53 computes the axes anew that it does not move.
pub(crate) fn computes_all_anew(state: &State) -> bool {
    state.choices.quirk(quirk::rs274::MACHINE_ZERO_SIGN)
}

/// Quirk rs274.rotation-under-local-offset. When G10 L2 turns the system in force, or the program end turns back to
/// G54, the point is turned without the local offset, which it keeps as it was.
pub(crate) fn turn_system(reload: fn(&mut State), state: &mut State) {
    if !state.choices.quirk(quirk::rs274::ROTATION_UNDER_LOCAL_OFFSET) {
        return reload(state);
    }
    let local = std::mem::take(&mut state.modes.g92_offset);
    reload(state);
    state.modes.g92_offset = local;
}

/// Quirk rs274.tool-entry-under-compensation. The tool table can be changed while the cutter is compensated.
pub(crate) fn table_under_compensation(state: &State) -> bool {
    state.choices.quirk(quirk::rs274::TOOL_ENTRY_UNDER_COMPENSATION)
}

/// Quirk rs274.per-revolution-standing. Under feed per revolution straight feeds and arcs are refused while the speed
/// of the spindle is zero, whether it turns or not. Which spindle that is, quirk rs274.chosen-spindle says.
pub(crate) fn per_revolution(words: &Words, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::PER_REVOLUTION_STANDING;
    let moves =
        motion_of(words, state).is_some_and(|motion| motion == Motion::Feed || is_arc(motion));
    let spindle = state.modes.spindles.get(state.chosen_spindle);
    let no_speed = spindle.is_some_and(|spindle| spindle.speed == 0.0);
    let per_revolution = state.modes.feed_mode == FeedMode::PerRevolution;
    if moves && no_speed && per_revolution && state.choices.quirk(rule) {
        let message = "a feed per revolution, and no speed";
        return Err(refuse(rule, FaultKind::ZeroSpeed, message));
    }
    Ok(())
}

/// Quirk rs274.inverse-time-zero-rate. Under inverse time F may be zero, with straight feeds, arcs, G5 and G5.1.
pub(crate) fn takes_no_time(state: &State) -> bool {
    state.modes.feed_mode == FeedMode::InverseTime
        && state.choices.quirk(quirk::rs274::INVERSE_TIME_ZERO_RATE)
}

/// Quirk rs274.polar-needs-angle. At the origin a polar move without an angle is refused, in absolute distance mode
/// too.
pub(crate) fn polar_angle(words: &Words, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::POLAR_NEEDS_ANGLE;
    let at_origin = state.position.x == 0.0 && state.position.y == 0.0;
    if at_origin && word(words, '^').is_none() && state.choices.quirk(rule) {
        let message = "a distance without an angle, from the origin";
        return Err(refuse(rule, FaultKind::AxisWords, message));
    }
    Ok(())
}

/// Quirk rs274.polar-to-origin. Nor may an incremental polar move with an angle end there.
pub(crate) fn polar_end(distance: f64, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::POLAR_TO_ORIGIN;
    let incremental = state.modes.distance == Distance::Incremental;
    if incremental && distance == 0.0 && state.choices.quirk(rule) {
        let message = "an incremental polar move to the origin";
        return Err(refuse(rule, FaultKind::AxisWords, message));
    }
    Ok(())
}

/// Quirk rs274.polar-plane. Polar words are refused where the block before left another plane than XY; what their own
/// block selects does not count.
pub(crate) fn polar_plane(state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::POLAR_PLANE;
    if state.plane_before != Plane::Xy && state.choices.quirk(rule) {
        let message = "polar words outside of the XY plane";
        return Err(refuse(rule, FaultKind::ModalConflict, message));
    }
    Ok(())
}
