//! Numbered parameters.

use gaugeblock_vocabulary::Axis;

use super::State;
use super::store::{PERSISTENT, at_start};
use crate::Choices;
use crate::rs274::refusal::StepError;

/// The tool in the spindle.
const TOOL: u32 = 5400;

/// The position by axis, X to W.
const POSITION: u32 = 5420;

/// Rule parameters.position. 5420 to 5428 are the position in the active coordinate system with all offsets.
/// Rule parameters.position-units. 5420 to 5428 are in the current program units.
/// Rule parameters.tool. 5400 is the tool in the spindle, 5401 to 5413 what the tool table says of it.
/// Rule parameters.local-numbers. Parameters 1 to 30 are local to a subroutine.
pub(super) fn value(number: u32, state: &State) -> Result<f64, StepError> {
    if let Some(argument) = argument(number) {
        return Ok(state.frame().arguments[argument]);
    }
    if !is_computed(number) {
        return Ok(state.parameters.stored(number));
    }
    Ok(computed(number, state))
}

/// Stores a value; the caller has checked that it can be.
///
/// Choice parameters.read-only-numbered: parameters that report the position or the tool keep reporting it.
pub(super) fn assign(number: u32, value: f64, state: &mut State) {
    if is_computed(number) {
        return;
    }
    match argument(number) {
        Some(argument) => state.frame_mut().arguments[argument] = value,
        None => state.parameters.store(number, value),
    }
}

/// The greatest number of a parameter.
pub fn last(choices: &Choices) -> u32 {
    choices.dialect().last_parameter(choices)
}

/// The parameters whose value the machine's state decides.
pub fn computed_numbers() -> impl Iterator<Item = u32> {
    (TOOL..POSITION + 9).filter(|number| is_computed(*number))
}

/// Whether a persistent parameter is not as it was when the run began.
pub fn changed_persistent(state: &State) -> bool {
    let before = at_start(&state.machine);
    let set = state.parameters.numbered.iter().filter(|(number, _)| PERSISTENT.contains(number));
    let before = |number| before.get(number).copied().unwrap_or(0.0);
    set.into_iter().any(|(number, value)| (value - before(number)).abs() > 0.0)
}

/// Whether the machine's state decides a parameter's value.
pub(super) fn is_computed(number: u32) -> bool {
    (TOOL..=5413).contains(&number) || position_of(number).is_some()
}

fn computed(number: u32, state: &State) -> f64 {
    if let Some(axis) = position_of(number) {
        return state.position.get(axis);
    }
    match (number, state.loaded_tool()) {
        (TOOL, _) => f64::from(state.known_tool),
        (_, None) => 0.0,
        (5410, Some(tool)) => tool.diameter,
        (5411, Some(tool)) => tool.front_angle,
        (5412, Some(tool)) => tool.back_angle,
        (5413, Some(tool)) => f64::from(tool.orientation),
        (_, Some(tool)) => {
            let offsets = (TOOL + 1..).zip(tool.offset.to_array());
            offsets
                .into_iter()
                .find(|(offset, _)| *offset == number)
                .map_or(0.0, |(_, value)| value)
        }
    }
}

/// The axis whose position a parameter is.
fn position_of(number: u32) -> Option<Axis> {
    let place = number.checked_sub(POSITION)?;
    Axis::ALL.get(usize::try_from(place).ok()?).copied()
}

/// The place of a local numbered parameter among the thirty.
fn argument(number: u32) -> Option<usize> {
    (1..=30).contains(&number).then_some(number as usize - 1)
}
