//! Quirks of arcs.

use gaugeblock_vocabulary::{FaultKind, LengthUnit, Plane};

use super::{LinuxCnc, Shows};
use crate::dialects::quirk;
use crate::ids::{choice, rule};
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::arc::{ArcRules, Axes, InPlane, lost_in_writing, names_axis};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl ArcRules for LinuxCnc {
    /// Quirk rs274.arc-radius-tolerance. The radii may be about five times as far apart as documented.
    fn radius_tolerances(&self, state: &State) -> (f64, f64) {
        if !state.shows(quirk::rs274::ARC_RADIUS_TOLERANCE) {
            return Documented.radius_tolerances(state);
        }
        let diagonal = std::f64::consts::SQRT_2;
        match state.modes.units {
            LengthUnit::Inch => (0.2 * diagonal, 0.002 * diagonal),
            LengthUnit::Millimetre => (2.0 * diagonal, 0.02 * diagonal),
        }
    }

    /// Quirk rs274.arc-least-radius. An arc whose centre is nearer to its start or its end than what numbers lose when
    /// they are written has no radius.
    fn check_radius(&self, to_start: f64, to_end: f64, state: &mut State) -> Result<(), StepError> {
        let rule = quirk::rs274::ARC_LEAST_RADIUS;
        if to_start.min(to_end) < lost_in_writing(state) && state.shows(rule) {
            let message = "an arc whose centre is at its start or its end";
            return Err(refuse(rule, FaultKind::BadArc, message));
        }
        Documented.check_radius(to_start, to_end, state)
    }

    /// Quirk rs274.polar-arc-plane. For an arc with a radius outside of the XY plane polar words name no axis of the
    /// plane.
    fn names_axis_of_plane(&self, axes: Axes, words: &Words, state: &State) -> bool {
        if state.modes.plane != Plane::Xy && state.shows(quirk::rs274::POLAR_ARC_PLANE) {
            return names_axis(axes, words);
        }
        Documented.names_axis_of_plane(axes, words, state)
    }

    /// Quirk rs274.arc-no-radius. A radius of zero that is within what is lost when numbers are written has a centre
    /// that is no number.
    fn centre_beside_start(
        &self,
        start: InPlane,
        chord: (f64, InPlane),
        radius: f64,
        clockwise: bool,
        state: &mut State,
    ) -> Result<InPlane, StepError> {
        let rule = rule::arcs::RADIUS_JUST_TOO_SMALL;
        let (half, _) = chord;
        if radius == 0.0
            && half <= lost_in_writing(state)
            && state.choices.is(choice::arcs::RadiusJustTooSmall::HalfCircle)
            && state.shows(quirk::rs274::ARC_NO_RADIUS)
        {
            state.coverage.accepted(rule);
            return Ok((f64::NAN, f64::NAN));
        }
        Documented.centre_beside_start(start, chord, radius, clockwise, state)
    }
}
