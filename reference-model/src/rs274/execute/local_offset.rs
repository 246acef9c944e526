//! G52 and the G92 codes: an offset of every coordinate system.

use gaugeblock_vocabulary::{Axis, Compensation, Position};

use super::offset_storage::{
    LOCAL_APPLIES, in_force_changes, store_flag, store_length, stored_axes, stored_offset,
};
use super::target::offset_words;
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::modes::each;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

/// The rules of the local offset that a controller may follow differently.
pub(crate) trait LocalOffsetRules {
    /// Whether the local offset may be set, cancelled or restored now.
    fn check_local_offset(&self, _state: &State) -> Result<(), StepError> {
        Ok(())
    }

    /// Rule offsets.local-cleared. The local offset is cancelled: the axis words of the block count without it.
    fn local_offset_ends(&self, _state: &mut State) {}

    /// Rule units-planes.absolute. The coordinate that an axis word names in absolute distance mode.
    fn named_coordinate(&self, _axis: Axis, value: f64, _words: &Words, _state: &State) -> f64 {
        value
    }

    /// Rules offsets.position-omitted-axes and offsets.position-other-axes. The local offset of axes for which G92 has
    /// no word: whether they have none, or keep theirs, is a choice.
    fn offset_without_word(&self, before: Position, state: &State) -> Position {
        match state.choices.get() {
            choice::offsets::PositionOtherAxes::Cleared => Position::default(),
            choice::offsets::PositionOtherAxes::Kept => before,
        }
    }
}

/// Changes the local offset.
///
/// # Errors
/// Those of G52 and G92.
pub(super) fn change(words: &Words, state: &mut State) -> Result<(), StepError> {
    let code = |wanted: &[u32]| words.g_tenths.iter().copied().find(|code| wanted.contains(code));
    if code(&[520, 920, 921, 922, 923]).is_some() {
        state.dialect().check_local_offset(state)?;
    }
    match code(&[520, 920]) {
        Some(520) => shift(words, state)?,
        Some(_) => name_point(words, state)?,
        None => {}
    }
    // docs/compensation.md: while the cutter is compensated G92.1 to G92.3 have no effect.
    if state.modes.compensation != Compensation::Off {
        return Ok(());
    }
    match code(&[921, 922, 923]) {
        Some(921) => clear(state),
        Some(922) => suspend(state),
        Some(_) => resume(state),
        None => {}
    }
    Ok(())
}

/// G52.
///
/// Rule offsets.local. It shifts the coordinate system by its axis values, after the rotation, and moves nothing.
/// Rule offsets.local-replaces. The values count from the coordinate system, not from an earlier G52.
/// Rule offsets.local-omitted-axes. Axes without a word keep theirs.
/// Rule offsets.local-parameters. #5211 to #5219 hold the offset, #5210 is 1 while it applies.
///
/// # Errors
/// Rule offsets.change-under-compensation.
fn shift(words: &Words, state: &mut State) -> Result<(), StepError> {
    in_force_changes(state)?;
    for rule in [
        rule::offsets::LOCAL,
        rule::offsets::LOCAL_REPLACES,
        rule::offsets::LOCAL_OMITTED_AXES,
        rule::offsets::LOCAL_PARAMETERS,
    ] {
        state.coverage.accepted(rule);
    }
    let mut offset = state.modes.g92_offset;
    for (axis, value) in offset_words(words, state) {
        *offset.get_mut(axis) = value;
    }
    apply(offset, state);
    remember(state);
    Ok(())
}

/// G92.
///
/// Rule offsets.position. The point where the machine is gets the coordinates of the axis words, and nothing moves.
/// Rule offsets.position-replaces. The offset that does this takes the place of an earlier one, whatever the distance
/// mode. Rules offsets.position-omitted-axes and offsets.position-other-axes. Axes without a word have none, or keep
/// theirs. Rule offsets.position-parameters. #5211 to #5219 hold the offset.
///
/// # Errors
/// Rule offsets.change-under-compensation.
fn name_point(words: &Words, state: &mut State) -> Result<(), StepError> {
    in_force_changes(state)?;
    for rule in [
        rule::offsets::POSITION,
        rule::offsets::POSITION_REPLACES,
        rule::offsets::POSITION_ALL_SYSTEMS,
        rule::offsets::POSITION_OMITTED_AXES,
        rule::offsets::POSITION_OTHER_AXES,
        rule::offsets::POSITION_PARAMETERS,
        rule::offsets::POSITION_STORED,
    ] {
        state.coverage.accepted(rule);
    }
    let before = state.modes.g92_offset;
    let in_system = each(state.position, before, |point, offset| point + offset);
    let mut offset = state.dialect().offset_without_word(before, state);
    for (axis, value) in offset_words(words, state) {
        *offset.get_mut(axis) = in_system.get(axis) - value;
    }
    apply(offset, state);
    remember(state);
    Ok(())
}

/// Rule offsets.local-cleared. G92.1 takes the offset away, and its parameters are zero.
fn clear(state: &mut State) {
    state.coverage.accepted(rule::offsets::LOCAL_CLEARED);
    state.dialect().local_offset_ends(state);
    suspend_offset(state);
    for axis in stored_axes(state) {
        store_length(LOCAL_APPLIES + 1, axis, 0.0, state);
    }
}

/// Rule offsets.local-suspended. G92.2 takes the offset away, and its parameters stay.
fn suspend(state: &mut State) {
    state.coverage.accepted(rule::offsets::LOCAL_SUSPENDED);
    suspend_offset(state);
}

/// Takes the local offset away; its parameters stay.
pub(super) fn suspend_offset(state: &mut State) {
    apply(Position::default(), state);
    state.modes.local_applies = false;
    store_flag(false, state);
}

/// Rule offsets.local-resumed. G92.3 applies what the parameters hold.
fn resume(state: &mut State) {
    state.coverage.accepted(rule::offsets::LOCAL_RESUMED);
    store_flag(true, state);
    let machine = state.modes.machine_point(state.position);
    let (parameters, choices, machine_data) = (&state.parameters, &state.choices, &state.machine);
    let unit = state.stored_unit();
    let stored = |number| stored_offset(number, parameters, choices, machine_data);
    state.modes.load_local_offset(stored, unit);
    state.position = state.modes.program_point(machine);
}

/// Another offset applies; the machine stays where it is.
fn apply(offset: Position, state: &mut State) {
    let machine = state.modes.machine_point(state.position);
    state.modes.g92_offset = offset;
    state.modes.local_applies = true;
    state.position = state.modes.program_point(machine);
}

/// Stores the offset that applies.
fn remember(state: &mut State) {
    let offset = state.modes.g92_offset;
    for axis in stored_axes(state) {
        store_length(LOCAL_APPLIES + 1, axis, offset.get(axis), state);
    }
    store_flag(true, state);
}
