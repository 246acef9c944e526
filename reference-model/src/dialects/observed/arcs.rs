//! Quirks of arcs.

use gaugeblock_vocabulary::{FaultKind, LengthUnit, Plane, Position};

use super::task::machine_point_in_mm;
use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::ids::{choice, rule};
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::arc::{ArcRules, InPlane, names_axis, rounding_tolerance};
use crate::rs274::execute::plane_axes::Axes;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl ArcRules for Observed {
    /// Quirk grbl.radius-helix. All three coordinates are compared.
    fn ends_where_it_starts(
        &self,
        start: Position,
        end: Position,
        axes: Axes,
        state: &State,
    ) -> bool {
        let ends = Documented.ends_where_it_starts(start, end, axes, state);
        ends && (start == end || !state.has_quirk(quirk::grbl::RADIUS_HELIX))
    }

    /// Quirk linuxcnc.great-arc. The machine skips an arc if the square of its radius exceeds the largest number.
    fn skips_arc(&self, radius: f64, state: &mut State) -> bool {
        let skips = (radius * radius).is_infinite() && state.has_quirk(quirk::linuxcnc::GREAT_ARC);
        if skips {
            state.memory.led_to = Some(machine_point_in_mm(&state.modes, state.position));
        }
        skips
    }

    /// Quirk rs274.arc-radius-tolerance. The radii may be about five times as far apart as documented.
    fn radius_tolerances(&self, state: &State) -> (f64, f64) {
        if !state.has_quirk(quirk::rs274::ARC_RADIUS_TOLERANCE) {
            return Documented.radius_tolerances(state);
        }
        let diagonal = std::f64::consts::SQRT_2;
        match state.modes.units {
            LengthUnit::Inch => (0.2 * diagonal, 0.002 * diagonal),
            LengthUnit::Millimetre => (2.0 * diagonal, 0.02 * diagonal),
        }
    }

    /// Quirk rs274.arc-least-radius. An arc is refused if its centre is closer to its start or end than the rounding
    /// tolerance.
    fn check_radius(&self, to_start: f64, to_end: f64, state: &mut State) -> Result<(), StepError> {
        let rule = quirk::rs274::ARC_LEAST_RADIUS;
        if to_start.min(to_end) < rounding_tolerance(state) && state.has_quirk(rule) {
            let message = "an arc whose centre is at its start or its end";
            return Err(refuse(rule, FaultKind::BadArc, message));
        }
        Documented.check_radius(to_start, to_end, state)
    }

    /// Quirk rs274.polar-arc-plane. For an arc with a radius outside of the XY plane polar words name no axis of the
    /// plane.
    fn names_axis_of_plane(&self, axes: Axes, words: &Words, state: &State) -> bool {
        if state.modes.plane != Plane::Xy && state.has_quirk(quirk::rs274::POLAR_ARC_PLANE) {
            return names_axis(axes, words);
        }
        Documented.names_axis_of_plane(axes, words, state)
    }

    /// Quirk grbl.radius-helix. The centre between two equal points of the plane is not a number.
    /// Quirk rs274.arc-no-radius. With a radius of zero and half a chord within the rounding tolerance, the arc has a
    /// centre that is not a number.
    fn centre_from_radius(
        &self,
        start: InPlane,
        chord: (f64, InPlane),
        radius: f64,
        clockwise: bool,
        state: &mut State,
    ) -> Result<InPlane, StepError> {
        let rule = rule::arcs::RADIUS_JUST_TOO_SMALL;
        let (half, _) = chord;
        if half == 0.0 && radius != 0.0 && state.has_quirk(quirk::grbl::RADIUS_HELIX) {
            return Ok((f64::NAN, f64::NAN));
        }
        if radius == 0.0
            && half <= rounding_tolerance(state)
            && state.choices.is(choice::arcs::RadiusJustTooSmall::HalfCircle)
            && state.has_quirk(quirk::rs274::ARC_NO_RADIUS)
        {
            state.coverage.accepted(rule);
            // Quirk linuxcnc.point-read-back. The machine skips such an arc.
            state.memory.led_to = Some(machine_point_in_mm(&state.modes, state.position));
            return Ok((f64::NAN, f64::NAN));
        }
        Documented.centre_from_radius(start, chord, radius, clockwise, state)
    }
}
