//! G28, G28.1, G30, G30.1: positions of the machine that a program goes to by way of another point.

use gaugeblock_vocabulary::{Axis, Compensation, Effect, FaultKind, Position};

use super::target::{end_point, letter};
use super::word;
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::modes::converted;
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// The parameter with X of the position of G28, machine unit; the other axes follow.
const G28_POSITION: u32 = 5161;

/// The parameter with X of the position of G30, machine unit.
pub(super) const G30_POSITION: u32 = 5181;

/// Operations on positions of the machine that a dialect can replace; active length unit.
pub(crate) trait MachinePositionRules {
    /// Where on the machine G53, G28, G30 and M6 lead for a machine coordinate: there.
    fn reached(&self, _axis: Axis, coordinate: f64, _state: &State) -> f64 {
        coordinate
    }

    /// Rule positions.go. G28 alone moves every axis to the stored position at rapid speed; what the machine has no
    /// axis for does not move, wherever the rotation of a coordinate system has led it.
    fn go_straight(&self, first: u32, state: &mut State, record: &mut Record) {
        let here = state.modes.machine_point(state.position);
        let mut there = destination(first, state);
        for axis in Axis::ALL.iter().filter(|axis| !state.machine.axes.contains(axis)) {
            *there.get_mut(*axis) = here.get(*axis);
        }
        state.dialect().go_to_stored(there, state, record);
    }

    /// Rule positions.go. The last move of G28 and G30, to a machine position in the active length unit.
    fn go_to_stored(&self, machine: Position, state: &mut State, record: &mut Record) {
        traverse(machine, state, record);
    }

    /// The position of the machine that G28.1 and G30.1 store, G10 measures and parameters have: where it is.
    fn measured(&self, machine: Position, _state: &State) -> Position {
        machine
    }
}

/// Whether a block goes to a stored position.
pub(crate) fn moves(words: &Words) -> bool {
    words.g_tenths.iter().any(|code| [280, 300].contains(code))
}

/// Goes to a stored position, or stores where the machine is.
///
/// Rule positions.second. G30 and G30.1 are a second pair of codes with parameters of their own.
/// Rule positions.store-with-motion. Axis words in a block with G28.1 or G30.1 belong to the motion mode, which moves
/// after the position is stored.
///
/// # Errors
/// Rule positions.under-compensation: none of the four codes is allowed while the cutter is compensated.
pub(super) fn perform(
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    if state.modes.compensation != Compensation::Off {
        let message = "a stored position while cutter compensation is on";
        let rule = rule::positions::UNDER_COMPENSATION;
        return Err(refuse(rule, FaultKind::CompensationActive, message));
    }
    let second = words.g_tenths.iter().any(|code| [300, 301].contains(code));
    let first = if second { G30_POSITION } else { G28_POSITION };
    if second {
        state.coverage.accepted(rule::positions::SECOND);
    }
    let turns = [Axis::X, Axis::Y].iter().all(|axis| state.machine.axes.contains(axis));
    if state.modes.rotation != 0.0 && !turns {
        let why = "where a stored position is in a rotated system of a machine without X or Y";
        return Err(StepError::Unspecified(why.to_owned()));
    }
    if !moves(words) {
        if has_axis_words(words) {
            state.coverage.accepted(rule::positions::STORE_WITH_MOTION);
        }
        store(first, state);
        return Ok(());
    }
    state.dialect().lead_away_by_other_move(false, state);
    if has_axis_words(words) {
        return by_way_of(first, words, state, record);
    }
    straight(first, state, record);
    Ok(())
}

/// Rule positions.store. G28.1 stores the machine position, in the machine's unit: all nine parameters are named, and
/// the position of an axis that the machine does not have is zero.
fn store(first: u32, state: &mut State) {
    let machine = state.modes.machine_point(state.position);
    let machine = state.dialect().measured(machine, state);
    let machine = converted(machine, state.modes.units, state.stored_unit());
    for (number, axis) in (first..).zip(Axis::ALL) {
        state.parameters.store(number, machine.get(*axis));
    }
    state.coverage.accepted(rule::positions::STORE);
}

/// A stored position on the machine, active length unit; an axis that nothing was stored for is at zero.
fn stored(first: u32, state: &State) -> Position {
    let mut there = Position::default();
    for (number, axis) in (first..).zip(Axis::ALL) {
        if state.machine.axes.contains(axis) {
            *there.get_mut(*axis) = state.parameters.stored(number);
        }
    }
    converted(there, state.stored_unit(), state.modes.units)
}

/// Rule positions.go. Without axis words every axis goes to the stored position.
/// Rule positions.not-stored. That is the machine's zero where nothing was stored.
fn straight(first: u32, state: &mut State, record: &mut Record) {
    state.coverage.accepted(rule::positions::GO);
    if (first..first + 9).all(|number| state.parameters.stored(number) == 0.0) {
        state.coverage.accepted(rule::positions::NOT_STORED);
    }
    state.dialect().go_straight(first, state, record);
}

/// Where G28 and G30 lead, machine position in the active length unit.
pub(super) fn destination(first: u32, state: &State) -> Position {
    let mut there = stored(first, state);
    for axis in Axis::ALL.iter().copied() {
        *there.get_mut(axis) = state.dialect().reached(axis, there.get(axis), state);
    }
    there
}

/// Rule positions.by-way-of. With axis words the machine first goes to the point that they name, as G0 would.
/// Rule positions.named-axes. From there the axes that they name go to the stored position, and no other.
/// Rule positions.home-axes. Whether an axis without a word goes there, too, is a choice.
/// Rule positions.rotated-axes. Whether those are axes of the machine or of a rotated coordinate system is a choice.
fn by_way_of(
    first: u32,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let between = end_point(words, state)?;
    state.coverage.accepted(rule::positions::BY_WAY_OF);
    traverse(state.modes.machine_point(between), state, record);
    let of_machine = state.choices.is(choice::positions::RotatedAxes::Machine);
    let to = |point: Position, state: &State| {
        if of_machine { state.modes.machine_point(point) } else { point }
    };
    let there = to(state.modes.program_point(destination(first, state)), state);
    let mut end = to(state.position, state);
    state.coverage.accepted(rule::positions::HOME_AXES);
    let has_all = state.choices.is(choice::positions::HomeAxes::All);
    if !has_all {
        state.coverage.accepted(rule::positions::NAMED_AXES);
    }
    let goes = |axis: &Axis| {
        word(words, letter(*axis)).is_some() || has_all && state.machine.axes.contains(axis)
    };
    for axis in Axis::ALL.iter().copied().filter(goes) {
        *end.get_mut(axis) = there.get(axis);
    }
    if state.modes.rotation != 0.0 {
        state.coverage.accepted(rule::positions::ROTATED_AXES);
    }
    let machine = if of_machine { end } else { state.modes.machine_point(end) };
    state.dialect().go_to_stored(machine, state, record);
    Ok(())
}

/// A rapid move to a machine position, active length unit.
pub(crate) fn traverse(machine: Position, state: &mut State, record: &mut Record) {
    state.position = state.modes.program_point(machine);
    record.effect(state, Effect::StraightTraverse { end: state.position });
}
