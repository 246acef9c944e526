//! Quirks of splines.

use gaugeblock_vocabulary::FaultKind;

use crate::ids::quirk;
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Quirk rs274.spline-not-modal. G5 and G5.1 leave the motion mode as it was.
pub(crate) fn is_not_modal(state: &State) -> bool {
    state.choices.quirk(quirk::rs274::SPLINE_NOT_MODAL)
}

/// Quirk rs274.cubic-without-direction. The first G5 of a row needs no I and J.
pub(crate) fn begins_without_direction(state: &State) -> bool {
    state.choices.quirk(quirk::rs274::CUBIC_WITHOUT_DIRECTION)
}

/// Quirk rs274.quadratic-needs-both. G5.1 needs both I and J.
pub(crate) fn quadratic_needs_both(words: &Words, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::QUADRATIC_NEEDS_BOTH;
    let both = ['i', 'j'].iter().all(|letter| words.letters.contains_key(letter));
    if !both && state.choices.quirk(rule) {
        return Err(refuse(rule, FaultKind::MissingWord, "G5.1 with only one of I and J"));
    }
    Ok(())
}

/// Quirk rs274.quadratic-of-zero. Both may be zero.
pub(crate) fn quadratic_of_zero(state: &State) -> bool {
    state.choices.quirk(quirk::rs274::QUADRATIC_OF_ZERO)
}

/// Quirk rs274.nurbs-weight. Each control point behind that of G5.2 needs P.
pub(crate) fn needs_weight(words: &Words, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::NURBS_WEIGHT;
    let opens = words.g.contains(&52);
    if !opens && !words.letters.contains_key(&'p') && state.choices.quirk(rule) {
        return Err(refuse(rule, FaultKind::WordOutOfRange, "a control point without its weight"));
    }
    Ok(())
}

/// Quirk rs274.nurbs-order-two. A NURBS of order two needs three control points too.
pub(crate) fn of_two_points(points: u32, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::NURBS_ORDER_TWO;
    if points == 2 && state.choices.quirk(rule) {
        let message = "a NURBS of two control points";
        return Err(refuse(rule, FaultKind::MissingWord, message));
    }
    Ok(())
}

/// A spline without X and Y: no document says where it would lead.
pub(crate) fn without_axis_words(_state: &State) -> StepError {
    StepError::Unspecified("a spline without X and Y".to_owned())
}
