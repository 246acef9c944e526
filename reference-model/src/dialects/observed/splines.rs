//! Quirks of splines. G codes are in tenths: 52 is G5.2.

use gaugeblock_vocabulary::{FaultKind, Motion};

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::splines::SplineRules;
use crate::rs274::execute::word;
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl SplineRules for Observed {
    /// Quirk rs274.spline-not-modal. G5 and G5.1 leave the motion mode as it was.
    fn set_spline_mode(&self, motion: Motion, state: &mut State) {
        if !state.has_quirk(quirk::rs274::SPLINE_NOT_MODAL) {
            Documented.set_spline_mode(motion, state);
        }
    }

    /// Quirk rs274.cubic-without-direction. The first G5 of a series needs no I and J.
    fn needs_first_direction(&self, state: &State) -> bool {
        !state.has_quirk(quirk::rs274::CUBIC_WITHOUT_DIRECTION)
            && Documented.needs_first_direction(state)
    }

    /// Quirk rs274.quadratic-needs-both. G5.1 needs both I and J.
    /// Quirk rs274.quadratic-of-zero. I and J of G5.1 may both be zero.
    fn check_quadratic_offset(&self, words: &Words, state: &State) -> Result<(), StepError> {
        let rule = quirk::rs274::QUADRATIC_NEEDS_BOTH;
        let both = ['i', 'j'].iter().all(|letter| word(words, *letter).is_some());
        if !both && state.has_quirk(rule) {
            return Err(refuse(rule, FaultKind::MissingWord, "G5.1 with only one of I and J"));
        }
        if state.has_quirk(quirk::rs274::QUADRATIC_OF_ZERO) {
            return Ok(());
        }
        Documented.check_quadratic_offset(words, state)
    }

    /// Quirk rs274.nurbs-weight. Each control point after that of G5.2 needs P.
    fn control_point_weight(&self, words: &Words, state: &State) -> Result<f64, StepError> {
        let rule = quirk::rs274::NURBS_WEIGHT;
        let is_after_opening = has_axis_words(words) && !words.g_tenths.contains(&52);
        if is_after_opening && word(words, 'p').is_none() && state.has_quirk(rule) {
            let message = "a control point without its weight";
            return Err(refuse(rule, FaultKind::WordOutOfRange, message));
        }
        Documented.control_point_weight(words, state)
    }

    /// Quirk rs274.nurbs-order-two. A NURBS of order two needs three control points, like one of order three.
    fn check_control_points(
        &self,
        points: u32,
        order: u32,
        state: &State,
    ) -> Result<(), StepError> {
        Documented.check_control_points(points, order, state)?;
        let rule = quirk::rs274::NURBS_ORDER_TWO;
        if points == 2 && state.has_quirk(rule) {
            let message = "a NURBS of two control points";
            return Err(refuse(rule, FaultKind::MissingWord, message));
        }
        Ok(())
    }
}
