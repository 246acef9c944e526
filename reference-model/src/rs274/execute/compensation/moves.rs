//! Moves while the cutter is compensated.

use gaugeblock_vocabulary::{
    Compensation, ControllerMode, Effect, FeedMode, Motion, Plane, Position,
};

use super::ending::{check_fit, stop_waiting};
use super::orientation::shifted;
use super::{entry, gouges, slack};
use crate::ids::choice::compensation::CornerBeforeTraverse;
use crate::ids::rule;
use crate::rs274::execute::plane_axes::{Axes, axes};
use crate::rs274::planar::{Corner, Curve, Cutter, InPlane, Leg, ProgrammedArc, corner};
use crate::rs274::refusal::StepError;
use crate::rs274::state::{CompensatedPath, State};
use crate::rs274::task::Record;

/// A move in the plane as its block programs it.
#[derive(Clone, Copy, Debug)]
struct Programmed {
    motion: Motion,
    /// All axes.
    end: Position,
    /// Where it starts in the plane.
    start: InPlane,
    axes: Axes,
    /// Turns of an arc; 0 for a line.
    turns: i32,
}

/// Whether moves are compensated. With a radius of zero they are as without compensation.
pub(crate) fn applies(state: &State) -> bool {
    state.modes.compensation != Compensation::Off && state.modes.compensation_radius != 0.0
}

/// The point from which words count: the programmed one while the cutter is compensated, or the controlled one.
pub(crate) fn programmed_point(state: &State) -> Position {
    state.contour.path.as_ref().map_or(state.position, |path| path.programmed)
}

/// The side and the radius of the tool. A negative diameter changes the side.
fn cutter(state: &State) -> Cutter {
    let radius = state.modes.compensation_radius;
    let left = matches!(state.modes.compensation, Compensation::Left | Compensation::DynamicLeft);
    let side = if left == (radius > 0.0) { 1.0 } else { -1.0 };
    Cutter { radius: radius.abs(), side }
}

/// Moves straight, G0 or G1, to a programmed point.
///
/// # Errors
/// The tool has no place. What the documents leave open.
pub(crate) fn line(
    motion: Motion,
    end: Position,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    check_specified(end, state)?;
    let axes = axes(state)?;
    let start = axes.in_plane(programmed_point(state));
    let (to, cutter) = (axes.in_plane(end), cutter(state));
    let next = if state.contour.path.is_none() {
        entry::line(start, to, cutter, state)?
    } else if start == to {
        out_of_plane(motion, end, axes, state, record);
        return Ok(());
    } else {
        Leg::line(start, to, cutter)
    };
    let programmed = Programmed { motion, end, start, axes, turns: 0 };
    follow(next, &programmed, cutter, state, record)
}

/// Moves along a programmed arc.
///
/// # Errors
/// The tool has no place. What the documents leave open.
pub(crate) fn arc(
    motion: Motion,
    end: Position,
    axes: Axes,
    (centre, turns): (InPlane, i32),
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    check_specified(end, state)?;
    let (start, cutter) = (axes.in_plane(programmed_point(state)), cutter(state));
    let arc = ProgrammedArc { start, end: axes.in_plane(end), centre, turns };
    let next = if state.contour.path.is_none() {
        entry::arc(arc, cutter, state)?
    } else {
        Leg::arc(arc, cutter, slack(state)).ok_or_else(|| {
            let message = "the radius of the arc is not greater than that of the cutter";
            gouges(rule::compensation::ARC_RADIUS, message)
        })?
    };
    let programmed = Programmed { motion, end, start, axes, turns };
    follow(next, &programmed, cutter, state, record)
}

/// What the documents leave open of a compensated move.
fn check_specified(end: Position, state: &State) -> Result<(), StepError> {
    let from = programmed_point(state);
    let why = if state.modes.controller_mode == ControllerMode::Mdi {
        "a compensated move, entered by hand"
    } else if (end.u, end.v, end.w) != (from.u, from.v, from.w) {
        "a compensated move along U, V or W"
    } else if !matches!(state.modes.plane, Plane::Xy | Plane::Zx) {
        "a compensated move in another plane than XY and ZX"
    } else {
        return Ok(());
    };
    Err(StepError::Unspecified(why.to_owned()))
}

/// Rule compensation.third-axis. Without displacement in the plane, other axes go to their programmed points.
/// Rule compensation.skipped. They do so in a traverse, too.
fn out_of_plane(motion: Motion, end: Position, axes: Axes, state: &mut State, record: &mut Record) {
    state.coverage.accepted(rule::compensation::THIRD_AXIS);
    if motion == Motion::Traverse {
        state.coverage.accepted(rule::compensation::SKIPPED);
    }
    let here = axes.in_plane(state.position);
    state.position = axes.with(end, here);
    if let Some(path) = &mut state.contour.path {
        path.programmed = end;
    }
    state.modes.motion = motion;
    let end = axes.with(end, shifted(here, state));
    record.effect(state, straight(motion, end));
}

/// The effect of a straight move.
fn straight(motion: Motion, end: Position) -> Effect {
    if motion == Motion::Traverse {
        Effect::StraightTraverse { end }
    } else {
        Effect::StraightFeed { end }
    }
}

/// A move in the plane follows the one before it.
fn follow(
    mut next: Leg,
    programmed: &Programmed,
    cutter: Cutter,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    if ![next.start, next.end].iter().all(|point| point.0.is_finite() && point.1.is_finite()) {
        let why = "a compensated move whose points are beyond all numbers";
        return Err(StepError::Unspecified(why.to_owned()));
    }
    let before = state.contour.path.clone();
    if let Some(path) = &before {
        turn_corner(path, &mut next, programmed, cutter, state, record)?;
    }
    report(programmed, before.is_none(), state);
    let Programmed { motion, end, axes, turns, .. } = *programmed;
    state.modes.motion = motion;
    state.position = state.modes.rounding.of(axes.with(end, next.end), end);
    state.contour = crate::rs274::state::Contour {
        path: Some(CompensatedPath { programmed: end, last: next, waits: true }),
        exit: None,
    };
    let end = axes.with(state.position, shifted(axes.in_plane(state.position), state));
    let effect = match next.curve {
        Curve::Straight(_) => straight(motion, end),
        Curve::Round { circle, .. } => {
            let (first_centre, second_centre) = shifted(circle.centre, state);
            Effect::ArcFeed { end, first_centre, second_centre, turns }
        }
    };
    record.effect(state, effect);
    Ok(())
}

/// Reports the rules that a compensated move in the plane follows.
///
/// Rules compensation.side, compensation.line, compensation.arc, compensation.arc-radius, compensation.rapid,
/// compensation.plane. Its curve has the distance R from the programmed one.
/// Rules compensation.entry, compensation.entry-length, compensation.entry-rapids, compensation.entry-arc. So ends the
/// first one, and (compensation.holds) so does each that follows.
/// Rule compensation.programmed-path. The next one leads from the programmed point.
fn report(programmed: &Programmed, is_entry: bool, state: &mut State) {
    use rule::compensation as rules;
    let is_line = programmed.turns == 0;
    let coverage = &mut state.coverage;
    for rule in [rule::tool::COMPENSATION, rules::SIDE, rules::PROGRAMMED_PATH] {
        coverage.accepted(rule);
    }
    let of_form =
        if is_line { [rules::LINE, rules::LINE] } else { [rules::ARC, rules::ARC_RADIUS] };
    let of_place = match (is_entry, is_line) {
        (true, true) => [rules::ENTRY, rules::ENTRY_LENGTH],
        (true, false) => [rules::ENTRY_ARC, rules::ENTRY_ARC],
        (false, _) => [rules::HOLDS, rules::HOLDS],
    };
    for rule in of_form.into_iter().chain(of_place) {
        coverage.accepted(rule);
    }
    if programmed.motion == Motion::Traverse {
        coverage.accepted(rules::RAPID);
        coverage.accepted(rules::ENTRY_RAPIDS);
    }
    if state.modes.plane == Plane::Zx {
        coverage.accepted(rules::PLANE);
    }
}

/// Ends the move before at its corner with the next one, and begins the next one there.
///
/// Rule compensation.next-move. Rules compensation.tangent-corner, compensation.inside-corner,
/// compensation.outside-corner: which corner it is decides the end.
fn turn_corner(
    path: &CompensatedPath,
    next: &mut Leg,
    programmed: &Programmed,
    cutter: Cutter,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let last = &path.last;
    match corner(last, next, cutter, state.modes.rounding.margin()) {
        Corner::Tangent => {
            state.coverage.accepted(rule::compensation::TANGENT_CORNER);
            next.begins = last.end;
            stop_waiting(state, record);
        }
        Corner::Inner(_) if last.is_turned_over() => {
            let why = "an inner corner after an arc as entry that is turned over";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        Corner::Touching => {
            let why = "an inner corner whose compensated curves touch within rounding";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        Corner::Inner(_) if !path.waits => after_pause(last, next)?,
        Corner::Inner(None) => {
            let message = "the compensated curves of a corner do not cross";
            return Err(gouges(rule::compensation::GOUGING, message));
        }
        Corner::Inner(Some(point)) => {
            check_fit(last, point, state)?;
            state.coverage.accepted(rule::compensation::INSIDE_CORNER);
            let units = state.modes.units;
            record.amend(programmed.axes.of_plane(), shifted(point, state), units);
            next.begins = point;
            stop_waiting(state, record);
        }
        Corner::Outer => {
            if path.waits && programmed.turns == 0 {
                check_fit(last, last.end, state)?;
            }
            state.coverage.accepted(rule::compensation::OUTSIDE_CORNER);
            stop_waiting(state, record);
            join(next, programmed, cutter, state, record)?;
        }
    }
    state.coverage.accepted(rule::compensation::NEXT_MOVE);
    Ok(())
}

/// A pause has put the move out in front of an inner corner. A line begins where it has left the tool, and need not
/// fit.
///
/// # Errors
/// One of both moves is an arc: that is open.
fn after_pause(last: &Leg, next: &mut Leg) -> Result<(), StepError> {
    match (last.curve, next.curve) {
        (Curve::Straight(_), Curve::Straight(_)) => {
            next.begins = last.end;
            next.has_to_fit = false;
            Ok(())
        }
        (Curve::Round { .. }, _) | (_, Curve::Round { .. }) => {
            let why = "a pause in front of an inner corner at an arc";
            Err(StepError::Unspecified(why.to_owned()))
        }
    }
}

/// The joining move of an outer corner: an arc about the programmed corner. Choice
/// compensation.corner-before-traverse: in front of a G0 it may be a straight traverse. The axis at right angles to the
/// plane stays, and rotary axes go where the new block leads them.
///
/// # Errors
/// The joining move is an arc in front of a G0, and no feed rate is set: the documents do not say how fast it is.
fn join(
    next: &Leg,
    programmed: &Programmed,
    cutter: Cutter,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let axes = programmed.axes;
    let in_rapid = programmed.motion == Motion::Traverse;
    let is_straight = in_rapid && state.choices.is(CornerBeforeTraverse::Straight);
    let has_rate = state.modes.feed_rate > 0.0 && state.modes.feed_mode != FeedMode::InverseTime;
    if in_rapid && !is_straight && !has_rate {
        let why = "an arc at a corner in front of a traverse, without a feed rate";
        return Err(StepError::Unspecified(why.to_owned()));
    }
    let there = axes.with_normal_of(axes.with(programmed.end, next.start), state.position);
    state.position = there;
    let end = axes.with(there, shifted(next.start, state));
    let effect = if is_straight {
        Effect::StraightTraverse { end }
    } else {
        let (first_centre, second_centre) = shifted(programmed.start, state);
        let turns = if cutter.side > 0.0 { -1 } else { 1 };
        Effect::ArcFeed { end, first_centre, second_centre, turns }
    };
    record.effect(state, effect);
    Ok(())
}
