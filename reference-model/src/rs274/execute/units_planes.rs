//! Planes, length units, distance modes, lathe modes and the return mode of canned cycles.

use gaugeblock_vocabulary::{Distance, FeedMode, Lathe, LengthUnit, Plane, Retract};

use super::not_under_compensation;
use crate::rs274::evaluate::Words;
use crate::rs274::modes::{converted, unit_size};
use crate::rs274::quirks::saved_state as quirks;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

/// Rules units-planes.plane and units-planes.secondary-planes. Selecting a plane moves nothing.
///
/// # Errors
/// Rule units-planes.plane-under-compensation, a choice: another one of the planes in which the cutter can be
/// compensated, or of the third beside them, while it is.
pub fn select_plane(words: &Words, state: &mut State) -> Result<(), StepError> {
    let plane = words.g.iter().find_map(|code| match code {
        170 => Some((Plane::Xy, "units-planes.plane")),
        180 => Some((Plane::Zx, "units-planes.plane")),
        190 => Some((Plane::Yz, "units-planes.plane")),
        171 => Some((Plane::Uv, "units-planes.secondary-planes")),
        181 => Some((Plane::Wu, "units-planes.secondary-planes")),
        191 => Some((Plane::Vw, "units-planes.secondary-planes")),
        _ => None,
    });
    if let Some((plane, rule)) = plane {
        if rule == "units-planes.plane" && plane != state.modes.plane {
            not_under_compensation("units-planes.plane-under-compensation", state)?;
        }
        state.coverage.accepted(rule);
        state.coverage.accepted("units-planes.plane-moves-nothing");
        state.modes.plane = plane;
    }
    Ok(())
}

/// Rule units-planes.units. G20 makes inches and G21 millimetres the length unit.
///
/// Rules units-planes.diameter and units-planes.radius. G7 makes X words diameters, and G8 radii.
pub fn select_units(words: &Words, state: &mut State) {
    for code in &words.g {
        let rule = match code {
            200 => {
                use_units(LengthUnit::Inch, state);
                "units-planes.units"
            }
            210 => {
                use_units(LengthUnit::Millimetre, state);
                "units-planes.units"
            }
            70 => {
                state.modes.lathe = Lathe::Diameter;
                "units-planes.diameter"
            }
            80 => {
                state.modes.lathe = Lathe::Radius;
                "units-planes.radius"
            }
            _ => continue,
        };
        state.coverage.accepted(rule);
    }
}

/// Tells everything that is a length in another unit; nothing moves and nothing is longer or shorter than before.
///
/// Rules units-planes.position-over-unit-change, units-planes.offsets-over-unit-change,
/// units-planes.tool-offset-over-unit-change. Rotary axes stay (units-planes.rotary-axes).
pub fn use_units(units: LengthUnit, state: &mut State) {
    let before = state.modes.units;
    if units == before {
        return;
    }
    for rule in [
        "units-planes.position-over-unit-change",
        "units-planes.offsets-over-unit-change",
        "units-planes.tool-offset-over-unit-change",
        "units-planes.rotary-axes",
    ] {
        state.coverage.accepted(rule);
    }
    let modes = &mut state.modes;
    modes.units = units;
    let here = state.position;
    state.position = modes.rounding.of(converted(here, before, units), here);
    modes.g5x_offset = converted(modes.g5x_offset, before, units);
    modes.g92_offset = converted(modes.g92_offset, before, units);
    modes.tool_offset = converted(modes.tool_offset, before, units);
    let factor = unit_size(before) / unit_size(units);
    modes.blend_tolerance *= factor;
    modes.naive_cam_tolerance *= factor;
    modes.compensation_radius *= factor;
    convert_feed(before, state);
}

/// Rule units-planes.feed-over-unit-change. What becomes of the feed is a choice; under inverse time it is no length.
fn convert_feed(before: LengthUnit, state: &mut State) {
    state.coverage.accepted("units-planes.feed-over-unit-change");
    let rescaled = state.choices.is("units-planes.feed-over-unit-change", "rescaled");
    if rescaled && state.modes.feed_mode != FeedMode::InverseTime {
        let modes = &mut state.modes;
        // As positions are converted: to and fro it is the same feed again.
        modes.feed_rate = modes.feed_rate * unit_size(before) / unit_size(modes.units);
    }
}

/// Rules units-planes.absolute, units-planes.incremental and units-planes.arc-distance: what axis words and arc
/// offsets count from. The distance mode and the arc distance mode do not influence each other, and changing them
/// keeps the position.
pub fn select_distance(words: &Words, state: &mut State) {
    for code in &words.g {
        let rule = match code {
            900 => {
                state.modes.distance = Distance::Absolute;
                "units-planes.distance-change"
            }
            910 => {
                state.modes.distance = Distance::Incremental;
                "units-planes.distance-change"
            }
            901 => {
                state.modes.arc_distance = Distance::Absolute;
                "units-planes.arc-distance"
            }
            911 => {
                state.modes.arc_distance = Distance::Incremental;
                "units-planes.arc-distance"
            }
            _ => continue,
        };
        state.coverage.accepted(rule);
        state.coverage.accepted("units-planes.arc-distance-apart");
    }
}

/// G98 and G99: where canned cycles return to.
pub(crate) fn select_retract(words: &Words, state: &mut State) -> Result<(), StepError> {
    quirks::retract_under_compensation(state)?;
    let r_plane = words.g.contains(&990);
    state.modes.retract = if r_plane { Retract::RPlane } else { Retract::OldZ };
    Ok(())
}
