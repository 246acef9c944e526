//! Quirks of moves, arcs, rotated systems and the tool table.

use gaugeblock_vocabulary::{Distance, FaultKind, FeedMode, LengthUnit, Motion, Plane, Position};

use crate::ids::quirk;
use crate::math;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::motion::{is_arc, motion_of};
use crate::rs274::execute::word;
use crate::rs274::modes::each;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Quirk rs274.arc-radius-tolerance. How far the radii at start and end of an arc may be apart: about five times as
/// far as documented. The larger holds always, the smaller for arcs of which it is more than a thousandth.
pub(crate) fn radius_tolerances(state: &State) -> Option<(f64, f64)> {
    if !state.choices.quirk(quirk::rs274::ARC_RADIUS_TOLERANCE) {
        return None;
    }
    let diagonal = std::f64::consts::SQRT_2;
    Some(match state.modes.units {
        LengthUnit::Inch => (0.2 * diagonal, 0.002 * diagonal),
        LengthUnit::Millimetre => (2.0 * diagonal, 0.02 * diagonal),
    })
}

/// Quirk rs274.arc-least-radius. An arc whose centre is nearer than this to its start or its end has no radius.
pub(crate) fn least_radius(state: &State) -> f64 {
    match state.modes.units {
        _ if !state.choices.quirk(quirk::rs274::ARC_LEAST_RADIUS) => 0.0,
        LengthUnit::Inch => 0.000_05,
        LengthUnit::Millimetre => 0.001_27,
    }
}

/// Quirk rs274.arc-no-radius. A radius of zero that is within what is lost when numbers are written has a centre that
/// is no number.
pub(crate) fn arcs_without_radius(state: &State) -> bool {
    state.choices.quirk(quirk::rs274::ARC_NO_RADIUS)
}

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

/// Quirk rs274.feed-name-inverse-time. Under inverse time a straight feed leaves its own feed rate: the length of its
/// way, of X, Y and Z where one of them moves, times F, and a tenth at least.
pub(crate) fn feed_of_move(motion: Motion, end: Position, state: &mut State) {
    let modes = &mut state.modes;
    if motion != Motion::Feed || modes.feed_mode != FeedMode::InverseTime {
        return;
    }
    let way = each(end, state.position, |end, start| end - start);
    let length = |[x, y, z]: [f64; 3]| math::hypotenuse(math::hypotenuse(x, y), z);
    let lengths = [[way.x, way.y, way.z], [way.u, way.v, way.w], [way.a, way.b, way.c]].map(length);
    let length = lengths.into_iter().find(|length| *length > 0.0).unwrap_or_default();
    if state.choices.quirk(quirk::rs274::FEED_NAME_INVERSE_TIME) {
        modes.feed_number = (length * modes.feed_rate).max(0.1);
    }
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

/// Quirk rs274.polar-arc-plane. For an arc with a radius outside of the XY plane polar words name no axis of the plane.
pub(crate) fn polar_names_none(state: &State) -> bool {
    state.modes.plane != Plane::Xy && state.choices.quirk(quirk::rs274::POLAR_ARC_PLANE)
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
