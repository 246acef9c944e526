//! Planes, length units, distance modes, lathe modes and the return mode of canned cycles.

use gaugeblock_vocabulary::{Distance, FeedMode, Lathe, LengthUnit, Plane, ReturnMode};

use super::not_under_compensation;
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::modes::{converted, unit_size};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

/// Rules units-planes.plane and units-planes.secondary-planes. Selecting a plane moves nothing.
///
/// # Errors
/// Rule units-planes.plane-under-compensation, a choice: another one of the planes in which the cutter can be
/// compensated, or of the third beside them, while it is.
pub fn select_plane(words: &Words, state: &mut State) -> Result<(), StepError> {
    let plane = words.g_tenths.iter().find_map(|code| match code {
        170 => Some((Plane::Xy, rule::units_planes::PLANE)),
        180 => Some((Plane::Zx, rule::units_planes::PLANE)),
        190 => Some((Plane::Yz, rule::units_planes::PLANE)),
        171 => Some((Plane::Uv, rule::units_planes::SECONDARY_PLANES)),
        181 => Some((Plane::Wu, rule::units_planes::SECONDARY_PLANES)),
        191 => Some((Plane::Vw, rule::units_planes::SECONDARY_PLANES)),
        _ => None,
    });
    if let Some((plane, rule)) = plane {
        if rule == rule::units_planes::PLANE && plane != state.modes.plane {
            not_under_compensation(
                rule::units_planes::PLANE_UNDER_COMPENSATION,
                choice::units_planes::PlaneUnderCompensation::Refused,
                state,
            )?;
        }
        state.coverage.accepted(rule);
        state.coverage.accepted(rule::units_planes::PLANE_MOVES_NOTHING);
        state.modes.plane = plane;
    }
    Ok(())
}

/// Rule units-planes.units. G20 makes inches and G21 millimetres the length unit.
///
/// Rules units-planes.diameter and units-planes.radius. G7 makes X words diameters, and G8 radii.
///
/// # Errors
/// Choice units-planes.units-under-compensation: G20 or G21 while the cutter is compensated.
pub fn select_units(words: &Words, state: &mut State) -> Result<(), StepError> {
    if let Some(units) = programmed_units(words) {
        not_under_compensation(
            rule::units_planes::UNITS,
            choice::units_planes::UnitsUnderCompensation::Refused,
            state,
        )?;
        use_units(units, state);
        state.coverage.accepted(rule::units_planes::UNITS);
    }
    for code in &words.g_tenths {
        let rule = match code {
            70 => {
                state.modes.lathe = Lathe::Diameter;
                rule::units_planes::DIAMETER
            }
            80 => {
                state.modes.lathe = Lathe::Radius;
                rule::units_planes::RADIUS
            }
            _ => continue,
        };
        state.coverage.accepted(rule);
    }
    Ok(())
}

/// The length unit that a block selects.
pub(super) fn programmed_units(words: &Words) -> Option<LengthUnit> {
    words.g_tenths.iter().find_map(|code| match code {
        200 => Some(LengthUnit::Inch),
        210 => Some(LengthUnit::Millimetre),
        _ => None,
    })
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
        rule::units_planes::POSITION_OVER_UNIT_CHANGE,
        rule::units_planes::OFFSETS_OVER_UNIT_CHANGE,
        rule::units_planes::TOOL_OFFSET_OVER_UNIT_CHANGE,
        rule::units_planes::ROTARY_AXES,
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
    state.contour.convert(before, units, modes.rounding);
    convert_feed(before, state);
}

/// Rule units-planes.feed-over-unit-change. What becomes of the feed is a choice.
fn convert_feed(before: LengthUnit, state: &mut State) {
    state.coverage.accepted(rule::units_planes::FEED_OVER_UNIT_CHANGE);
    if state.choices.is(choice::units_planes::FeedOverUnitChange::Rescaled) {
        state.move_rate = state.move_rate * unit_size(before) / unit_size(state.modes.units);
    }
    if state.dialect().rescales_feed(state) {
        let modes = &mut state.modes;
        // As positions are converted: to and fro it is the same feed again.
        modes.feed_rate = modes.feed_rate * unit_size(before) / unit_size(modes.units);
    }
}

/// Rules units-planes.absolute, units-planes.incremental and units-planes.arc-distance: what axis words and arc
/// offsets count from. The distance mode and the arc distance mode do not influence each other, and changing them
/// keeps the position.
pub fn select_distance(words: &Words, state: &mut State) {
    for code in &words.g_tenths {
        let rule = match code {
            900 => {
                state.modes.distance = Distance::Absolute;
                rule::units_planes::DISTANCE_CHANGE
            }
            910 => {
                state.modes.distance = Distance::Incremental;
                rule::units_planes::DISTANCE_CHANGE
            }
            901 => {
                state.modes.arc_distance = Distance::Absolute;
                rule::units_planes::ARC_DISTANCE
            }
            911 => {
                state.modes.arc_distance = Distance::Incremental;
                rule::units_planes::ARC_DISTANCE
            }
            _ => continue,
        };
        state.coverage.accepted(rule);
        state.coverage.accepted(rule::units_planes::ARC_DISTANCE_APART);
    }
}

/// Operations on these modes that a dialect can replace.
pub(crate) trait UnitsAndPlanesRules {
    /// Choice units-planes.feed-over-unit-change. Whether a change of the unit converts the feed; under inverse time it
    /// is not a length.
    fn rescales_feed(&self, state: &State) -> bool {
        state.choices.is(choice::units_planes::FeedOverUnitChange::Rescaled)
            && state.modes.feed_mode != FeedMode::InverseTime
    }

    /// G98 and G99: where canned cycles return to.
    fn select_retract(&self, words: &Words, state: &mut State) -> Result<(), StepError> {
        let r_plane = words.g_tenths.contains(&990);
        state.modes.retract = if r_plane { ReturnMode::RPlane } else { ReturnMode::OldZ };
        Ok(())
    }
}
