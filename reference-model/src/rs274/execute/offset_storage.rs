//! Offsets as they are stored, and whether one in force may change.

use gaugeblock_vocabulary::{Axis, Compensation, FaultKind, Position};

use crate::ids::{choice, rule};
use crate::rs274::modes::converted;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

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
    let stored = converted(position, state.modes.units, state.machine.length_unit).get(axis);
    let place = (first..).zip(Axis::ALL).find(|(_, known)| **known == axis).map(|(place, _)| place);
    state.parameters.store(place.expect("offsets: an axis is one of nine"), stored);
}
