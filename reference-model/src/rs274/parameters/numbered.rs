//! Numbered parameters.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use gaugeblock_vocabulary::{Axis, Machine};

use super::State;
use crate::Choices;
use crate::rs274::execute::tool::loaded;
use crate::rs274::modes::start_system;
use crate::rs274::refusal::StepError;

/// While this parameter is 0 the DEBUG comments say nothing.
pub const DEBUG_SWITCH: u32 = 5599;

/// The number of the active coordinate system, 1 to 9.
const ACTIVE_SYSTEM: u32 = 5220;

/// The tool in the spindle.
const TOOL: u32 = 5400;

/// The position by axis, X to W.
const POSITION: u32 = 5420;

/// The parameters that are kept while the machine is off.
const PERSISTENT: RangeInclusive<u32> = 5161..=5390;

/// The parameters when a program starts.
///
/// Rule parameters.stored. Stored parameters have their values when a program starts: those of the user, 31 to 5000,
/// and those that are persistent, 5161 to 5390. All others are volatile and begin with zero.
/// Rule parameters.debug-switch. 5599 is 1 at the start.
pub(super) fn at_start(machine: &Machine) -> BTreeMap<u32, f64> {
    let stored = |number: &u32| (31..=5000).contains(number) || PERSISTENT.contains(number);
    let mut numbered: BTreeMap<u32, f64> = machine
        .parameters
        .0
        .iter()
        .filter(|(number, value)| stored(number) && value.is_finite())
        .map(|(number, value)| (*number, *value))
        .collect();
    let system = f64::from(start_system(machine));
    numbered.insert(ACTIVE_SYSTEM, system);
    numbered.insert(DEBUG_SWITCH, 1.0);
    numbered
}

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
/// Choice parameters.read-only-numbered: what tells the position or the tool goes on telling it.
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
    match (number, loaded(state)) {
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
