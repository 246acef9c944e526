//! Quirks of moves. G codes are in tenths: 52 is G5.2.

use gaugeblock_vocabulary::{Distance, FaultKind, FeedMode, Motion, Plane, Position};

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::math;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::compensation::programmed_point;
use crate::rs274::execute::feed::length_for_feed;
use crate::rs274::execute::motion::MotionRules;
use crate::rs274::execute::programmed_motion::{is_arc, is_spline, motion_of};
use crate::rs274::execute::word;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl MotionRules for Observed {
    fn straight_move_leads(
        &self,
        motion: Motion,
        start: Position,
        end: Position,
        state: &mut State,
    ) {
        feed_of_move(motion, start, end, state);
    }

    /// Quirk grblhal.words-after-cancel. Axis words of G10, G28, G30 and G92 are accepted.
    fn refuses_words_after_cancel(&self, words: &Words, state: &State) -> bool {
        let uses = |codes: &[u32]| words.g_tenths.iter().any(|code| codes.contains(code));
        let accepts = state.has_quirk(quirk::grblhal::WORDS_AFTER_CANCEL);
        !(accepts && uses(&[100, 280, 300, 920]))
            && Documented.refuses_words_after_cancel(words, state)
    }

    /// Quirk rs274.nurbs-machine-coordinates. G53 can be in the block of G5.2, but not in those of the points after
    /// it. A spline of one point is refused, so that no effect of this G53 is observable.
    fn check_machine_coordinates(
        &self,
        motion: Motion,
        words: &Words,
        state: &mut State,
    ) -> Result<(), StepError> {
        if words.g_tenths.contains(&52) && state.has_quirk(quirk::rs274::NURBS_MACHINE_COORDINATES)
        {
            return Ok(());
        }
        Documented.check_machine_coordinates(motion, words, state)
    }

    /// Quirk rs274.machine-without-axes. G53 needs no axis word where G0 or G1 is in its block.
    fn names_machine_point(&self, words: &Words, state: &State) -> bool {
        let programmed = words.g_tenths.iter().any(|code| [0, 10].contains(code));
        programmed && state.has_quirk(quirk::rs274::MACHINE_WITHOUT_AXES)
            || Documented.names_machine_point(words, state)
    }

    /// Quirk rs274.machine-incremental. G53 needs absolute distance mode.
    fn check_machine_distance(&self, state: &mut State) -> Result<(), StepError> {
        let quirk = quirk::rs274::MACHINE_INCREMENTAL;
        if state.modes.distance == Distance::Incremental && state.has_quirk(quirk) {
            let message = "G53 in incremental distance mode";
            return Err(refuse(quirk, FaultKind::ModalConflict, message));
        }
        Documented.check_machine_distance(state)
    }

    /// Quirk rs274.machine-under-zero-radius. Compensation with a radius of zero does not refuse G53.
    fn is_compensated(&self, state: &State) -> bool {
        let no_radius = state.modes.compensation_radius == 0.0;
        !(no_radius && state.has_quirk(quirk::rs274::MACHINE_UNDER_ZERO_RADIUS))
            && Documented.is_compensated(state)
    }

    /// Quirk rs274.inverse-time-zero-rate. In inverse time mode straight feeds, arcs, G5 and G5.1 accept a feed
    /// rate of zero.
    /// Quirk rs274.spline-per-revolution. In G95 mode splines need no feed rate.
    fn needs_feed_rate(&self, words: &Words, state: &State) -> bool {
        let mode = state.modes.feed_mode;
        let takes_no_time =
            mode == FeedMode::InverseTime && state.has_quirk(quirk::rs274::INVERSE_TIME_ZERO_RATE);
        let spline = mode == FeedMode::PerRevolution
            && motion_of(words, state).is_some_and(is_spline)
            && state.has_quirk(quirk::rs274::SPLINE_PER_REVOLUTION);
        !takes_no_time && !spline && Documented.needs_feed_rate(words, state)
    }

    /// Quirk rs274.per-revolution-standing. In G95 mode straight feeds and arcs are refused while the spindle's speed
    /// is zero, whether it turns or not. Quirk rs274.chosen-spindle says which spindle that is.
    fn check_spindle_of_feed(&self, words: &Words, state: &mut State) -> Result<(), StepError> {
        Documented.check_spindle_of_feed(words, state)?;
        let quirk = quirk::rs274::PER_REVOLUTION_STANDING;
        let moves =
            motion_of(words, state).is_some_and(|motion| motion == Motion::Feed || is_arc(motion));
        let spindle = state.modes.spindles.get(state.memory.chosen_spindle);
        let no_speed = spindle.is_some_and(|spindle| spindle.speed == 0.0);
        let per_revolution = state.modes.feed_mode == FeedMode::PerRevolution;
        if moves && no_speed && per_revolution && state.has_quirk(quirk) {
            let message = "a feed per revolution, and no speed";
            return Err(refuse(quirk, FaultKind::ZeroSpeed, message));
        }
        Ok(())
    }

    /// Quirk rs274.surface-speed-while-stopped. A feed move under G96 needs no turning spindle.
    fn surface_speed_stands(&self, state: &State) -> bool {
        !state.has_quirk(quirk::rs274::SURFACE_SPEED_WHILE_STOPPED)
            && Documented.surface_speed_stands(state)
    }

    /// Quirk rs274.machine-zero-sign. G53 recomputes the axes that it does not move, so that −0 becomes 0.
    fn keeps_unmoved_axes(&self, state: &State) -> bool {
        !state.has_quirk(quirk::rs274::MACHINE_ZERO_SIGN) && Documented.keeps_unmoved_axes(state)
    }

    /// Quirks rs274.polar-plane, rs274.polar-needs-angle and rs274.polar-to-origin.
    fn check_polar(&self, words: &Words, state: &State) -> Result<(), StepError> {
        polar_plane(state)?;
        polar_angle(words, state)?;
        Documented.check_polar(words, state)?;
        polar_end(words, state)
    }
}

/// Quirk rs274.polar-plane. Polar words are refused if a plane other than XY was active before their block. A plane
/// that their own block selects does not count.
fn polar_plane(state: &State) -> Result<(), StepError> {
    let quirk = quirk::rs274::POLAR_PLANE;
    let other = state.memory.plane_before.is_some_and(|plane| plane != Plane::Xy);
    if other && state.has_quirk(quirk) {
        let message = "polar words outside of the XY plane";
        return Err(refuse(quirk, FaultKind::ModalConflict, message));
    }
    Ok(())
}

/// Quirk rs274.polar-needs-angle. A polar move from the origin without an angle is refused, in absolute distance mode
/// too.
fn polar_angle(words: &Words, state: &State) -> Result<(), StepError> {
    let quirk = quirk::rs274::POLAR_NEEDS_ANGLE;
    let here = programmed_point(state);
    let at_origin = here.x == 0.0 && here.y == 0.0;
    if at_origin && word(words, '^').is_none() && state.has_quirk(quirk) {
        let message = "a distance without an angle, from the origin";
        return Err(refuse(quirk, FaultKind::AxisWords, message));
    }
    Ok(())
}

/// Quirk rs274.polar-to-origin. An incremental polar move with an angle cannot end at the origin.
fn polar_end(words: &Words, state: &State) -> Result<(), StepError> {
    let quirk = quirk::rs274::POLAR_TO_ORIGIN;
    let (Some(more), Some(_)) = (word(words, '@'), word(words, '^')) else { return Ok(()) };
    let here = programmed_point(state);
    let distance = math::hypotenuse(here.x, here.y) + more;
    let incremental = state.modes.distance == Distance::Incremental;
    if incremental && distance == 0.0 && state.has_quirk(quirk) {
        let message = "an incremental polar move to the origin";
        return Err(refuse(quirk, FaultKind::AxisWords, message));
    }
    Ok(())
}

/// Quirk rs274.feed-name-inverse-time. In inverse time mode a straight feed sets `_feed` to the feed rate that it had:
/// the length of the move times F, at least 0.1. The length is that of X, Y and Z if one of these axes moves, else that
/// of U, V and W, else that of A, B and C.
fn feed_of_move(motion: Motion, start: Position, end: Position, state: &mut State) {
    if motion != Motion::Feed
        || state.modes.feed_mode != FeedMode::InverseTime
        || !state.has_quirk(quirk::rs274::FEED_NAME_INVERSE_TIME)
    {
        return;
    }
    let length = length_for_feed(start, end);
    let modes = &mut state.modes;
    modes.memory.get_mut().feed_number = (length * modes.feed_rate).max(0.1);
}
