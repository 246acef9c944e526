//! Offsets as they are stored, and whether one in force may change.

use gaugeblock_vocabulary::{Axis, Compensation, FaultKind, Machine, Position};

use crate::Choices;
use crate::ids::{choice, rule};
use crate::rs274::modes::converted;
use crate::rs274::parameters::Parameters;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// The parameter that is 1 while the local offset applies; those of the axes follow.
pub(super) const LOCAL_APPLIES: u32 = 5210;

/// Rule offsets.change-under-compensation. Whether an offset that is in force can be changed while the cutter is
/// compensated is a choice.
pub(super) fn in_force_changes(state: &mut State) -> Result<(), StepError> {
    let rule = rule::offsets::CHANGE_UNDER_COMPENSATION;
    if state.modes.compensation == Compensation::Off {
        return Ok(());
    }
    if state.choices.is(choice::offsets::ChangeUnderCompensation::Refused) {
        let message = "an offset in force is changed while cutter compensation is on";
        return Err(refuse(rule, FaultKind::CompensationActive, message));
    }
    state.coverage.accepted(rule);
    Ok(())
}

/// Stores a coordinate in the machine's length unit, as one of nine parameters from a first one.
pub(super) fn store_length(first: u32, axis: Axis, value: f64, state: &mut State) {
    let mut position = Position::default();
    *position.get_mut(axis) = value;
    let stored = converted(position, state.modes.units, state.stored_unit()).get(axis);
    let place = (first..).zip(Axis::ALL).find(|(_, known)| **known == axis).map(|(place, _)| place);
    state.parameters.store(place.expect("offsets: an axis is one of nine"), stored);
}

/// A parameter as offsets read it.
///
/// Choice offsets.flag-and-rotation. Where #5210 is a parameter like any other, the stored offset applies; where #5230
/// and so on are, no system is turned. The offsets are then those of the axes that the machine has.
pub(crate) fn stored_offset(
    number: u32,
    parameters: &Parameters,
    choices: &Choices,
    machine: &Machine,
) -> f64 {
    if choices.is(choice::offsets::FlagAndRotation::None) {
        let place = usize::try_from(number % 10).expect("offsets: a digit is a small number");
        match Axis::ALL.get(place.wrapping_sub(1)) {
            None if number == LOCAL_APPLIES => return 1.0,
            None => return 0.0,
            Some(axis) if !machine.axes.contains(axis) => return 0.0,
            Some(_) => {}
        }
    }
    parameters.stored(number)
}

/// Stores whether the local offset applies, in #5210. Choice offsets.flag-and-rotation: or nowhere.
pub(super) fn store_flag(applies: bool, state: &mut State) {
    if state.choices.is(choice::offsets::FlagAndRotation::Stored) {
        state.parameters.store(LOCAL_APPLIES, if applies { 1.0 } else { 0.0 });
    }
}

/// The axes whose local offset is stored: by choice offsets.flag-and-rotation all nine, or those of the machine.
pub(super) fn stored_axes(state: &State) -> Vec<Axis> {
    let is_each = state.choices.is(choice::offsets::FlagAndRotation::Stored);
    let is_stored = |axis: &Axis| is_each || state.machine.axes.contains(axis);
    Axis::ALL.iter().copied().filter(is_stored).collect()
}
