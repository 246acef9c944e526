//! Quirks of subroutines and control.

use crate::rs274::control::{Control, Frame, Next, Place, Structure, turns};
use crate::rs274::machine::State;
use crate::rs274::read;
use crate::rs274::refusal::Halt;
use crate::rs274::syntax::Expression;

/// Quirk rs274.later-conditions-evaluated. The condition of an elseif is evaluated even after a true one.
///
/// # Errors
/// The condition has no value.
pub fn evaluate_later_condition(values: &[Expression], state: &mut State) -> Result<(), Halt> {
    values.iter().try_for_each(|value| read::evaluate(value, state).map(|_| ()))
}

/// Quirk rs274.repeat-counter-shared. All invocations of a sub share the counter of a repeat.
///
/// The head takes a turn from the counter when it finds one, whoever left it there; a counter that is used up ends the
/// loop and is gone, so that the next head that comes by begins again.
///
/// # Errors
/// The count has no value, or the loop has no end.
pub fn shared_repeat(
    control: &mut Control,
    label: &str,
    values: &[Expression],
    state: &mut State,
) -> Result<Next, Halt> {
    let turns_left = match control.shared_counters.remove(&control.place) {
        Some(left) => left,
        None => turns(values, state)?,
    };
    if turns_left == 0 {
        return control.past_repeat(label, state);
    }
    control.shared_counters.insert(control.place, turns_left - 1);
    control.enter(label, Structure::Repeat { turns_left: 0 }, state);
    Ok(Next::Following)
}

/// Quirk rs274.fanuc-zero-loops. A call with L0 leaves a call level behind: what follows is executed as if it belonged
/// to the subprogram.
pub fn level_left_behind(control: &Control, frame: Frame, state: &mut State) -> Next {
    state.frames.push(frame);
    Next::At(Place { line: control.place.line + 1, ..control.place })
}

/// Quirk rs274.fanuc-zero-loops. Whether what is executed may belong to a level left behind, where the labels of the
/// program around it are not known.
pub fn is_left_behind(state: &State) -> bool {
    state.readings.quirk("rs274.fanuc-zero-loops") && state.frame().shares_parameters()
}

/// Quirk rs274.nine-levels. The main program counts as a level.
pub fn levels(documented: u32) -> u32 {
    documented - 1
}
