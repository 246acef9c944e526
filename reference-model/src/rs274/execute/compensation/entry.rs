//! The first compensated move.

use super::orientation::shifts;
use super::{gouges, slack};
use crate::ids::rule;
use crate::rs274::planar::{
    Circle, Curve, Cutter, InPlane, Leg, ProgrammedArc, along, away, between, direction, length,
};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

/// Rules compensation.entry, compensation.entry-length. The entry along a line ends at Q + R n.
///
/// # Errors
/// It is shorter than R in the plane; one out of the plane has no length there.
pub(super) fn line(
    start: InPlane,
    end: InPlane,
    cutter: Cutter,
    state: &State,
) -> Result<Leg, StepError> {
    let displacement = length(between(start, end));
    if start == end || !state.dialect().is_entry(displacement + slack(state), cutter.radius, state)
    {
        let message = "the entry is shorter than the radius of the cutter";
        return Err(gouges(rule::compensation::ENTRY_LENGTH, message));
    }
    Ok(Leg { has_to_fit: false, ..Leg::line(start, end, cutter) })
}

/// Rule compensation.entry-arc. The entry along an arc ends at E = Q - k R u1 in the programmed direction, and starts at P.
///
/// # Errors
/// Its chord is shorter than R, or the tool does not fit into the arc.
pub(super) fn arc(arc: ProgrammedArc, cutter: Cutter, state: &State) -> Result<Leg, StepError> {
    if shifts(state.modes.compensation_orientation) {
        let why = "an arc as entry with a tool that has an orientation";
        return Err(StepError::Unspecified(why.to_owned()));
    }
    let chord = length(between(arc.start, arc.end));
    if !state.dialect().is_entry(chord + slack(state), cutter.radius, state) {
        let message = "the chord of the entry is shorter than the radius of the cutter";
        return Err(gouges(rule::compensation::ENTRY_ARC, message));
    }
    let Some(leg) = Leg::arc(arc, cutter, slack(state)) else {
        let message = "the radius of the entry is not greater than that of the cutter";
        return Err(gouges(rule::compensation::ENTRY_ARC, message));
    };
    let outward = direction(between(arc.centre, arc.end));
    let back = between(leg.end, arc.start);
    let radius = -along(back, back) / (2.0 * along(back, outward));
    if !radius.is_finite() {
        return Err(StepError::Unspecified("an arc as entry that becomes straight".to_owned()));
    }
    let circle = Circle { centre: away(leg.end, -radius, outward), radius: radius.abs() };
    let curve = match leg.curve {
        Curve::Straight(_) => leg.curve,
        Curve::Round { sense, inside, sweep, .. } => Curve::Round { circle, sense, inside, sweep },
    };
    Ok(Leg { has_to_fit: false, curve, start: arc.start, begins: arc.start, ..leg })
}
