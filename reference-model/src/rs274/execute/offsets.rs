//! G54 to G59.3, G10 L2 and L20. The local offset, the tool table and stored positions have chapters of their own.

use gaugeblock_vocabulary::{Axis, Compensation, FaultKind, Motion, Position};

use super::offset_storage::{in_force_changes, store_length, stored_offset};
use super::programmed_motion::check_words_after_cancel;
use super::target::offset_words;
use super::tool_table::{self, Values};
use super::{local_offset, positions, whole, word};
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::modes::{each, first_parameter};
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// The parameter that holds the number of the selected coordinate system.
const SELECTED_SYSTEM: u32 = 5220;

/// The rules of coordinate systems that a controller may follow differently.
pub(crate) trait OffsetRules {
    /// Rule offsets.select-under-compensation. Whether a system can be selected under cutter compensation.
    fn selects_under_compensation(&self, _state: &State) -> bool {
        false
    }

    /// Rule offsets.select. A code selects its system, be it in force already.
    fn select_system(&self, system: u32, state: &mut State) {
        use_system(system, state);
    }

    /// Rule offsets.calculate-needs-axes. G10 L20 needs an axis word.
    fn check_calculated_axes(&self, words: &Words, _state: &State) -> Result<(), StepError> {
        if !has_axis_words(words) {
            let rule = rule::offsets::CALCULATE_NEEDS_AXES;
            return Err(refuse(rule, FaultKind::MissingWord, "G10 L20 needs an axis word"));
        }
        Ok(())
    }

    /// Rule offsets.set-number. P of G10 L2 and L20 is the number of a system.
    fn programmed_system(&self, words: &Words, _state: &State) -> Option<f64> {
        word(words, 'p')
    }

    /// Rule offsets.set-needs-kind. L of G10 is an integer.
    fn offset_kind(&self, value: f64, _state: &State) -> Option<i32> {
        whole(value)
    }

    /// Rule offsets.set-immediate. A system in force that G10 L2 has set, and can have turned, is read again.
    fn reload_turned_system(&self, state: &mut State) {
        reload(state);
    }
}

/// Selects a coordinate system.
///
/// Rule offsets.select. G54 to G59.3 are systems 1 to 9.
///
/// # Errors
/// Rule offsets.select-under-compensation.
pub fn select(words: &Words, state: &mut State) -> Result<(), StepError> {
    let system = words.g_tenths.iter().find_map(|code| match code {
        540 | 550 | 560 | 570 | 580 | 590 => Some((code - 530) / 10),
        591..=593 => Some(code - 584),
        _ => None,
    });
    let Some(system) = system else { return Ok(()) };
    let is_compensated = state.modes.compensation != Compensation::Off;
    if is_compensated && !state.dialect().selects_under_compensation(state) {
        let message = "a coordinate system is selected while cutter compensation is on";
        let rule = rule::offsets::SELECT_UNDER_COMPENSATION;
        return Err(refuse(rule, FaultKind::CompensationActive, message));
    }
    state.coverage.accepted(rule::offsets::SELECT);
    state.dialect().select_system(system, state);
    Ok(())
}

/// Rule offsets.select-moves-nothing. The machine stays where it is; the same point gets the coordinates of the system.
/// Rule offsets.stored. Its origin comes from the parameters.
/// Rule offsets.select-number. #5220 holds its number.
/// Rule offsets.local-stays. A local offset continues.
pub(crate) fn use_system(system: u32, state: &mut State) {
    for rule in [
        rule::offsets::SELECT_MOVES_NOTHING,
        rule::offsets::STORED,
        rule::offsets::SELECT_NUMBER,
        rule::offsets::LOCAL_STAYS,
    ] {
        state.coverage.accepted(rule);
    }
    state.modes.work_offset = system;
    state.parameters.store(SELECTED_SYSTEM, f64::from(system));
    reload(state);
}

/// Reads the origin of the selected system again; the machine stays where it is.
pub(crate) fn reload(state: &mut State) {
    let machine = state.modes.machine_point(state.position);
    let (parameters, choices, machine_data) = (&state.parameters, &state.choices, &state.machine);
    let unit = state.stored_unit();
    let stored = |number| stored_offset(number, parameters, choices, machine_data);
    state.modes.load_work_offset(stored, unit);
    state.position = state.modes.program_point(machine);
}

/// Changes the data of offsets.
///
/// Rule modal-groups.motion-suspended. The axis words are not the motion mode's, which holds again in the next block.
///
/// # Errors
/// Those of G10, G28, G30, G52 and G92. Rule motion.offset-words-after-cancel, a choice.
pub fn change(words: &Words, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    check_words_after_cancel(words, state)?;
    if has_axis_words(words) && state.modes.motion != Motion::None {
        state.coverage.accepted(rule::modal_groups::MOTION_SUSPENDED);
    }
    if words.g_tenths.iter().any(|code| [280, 281, 300, 301].contains(code)) {
        positions::perform(words, state, record)?;
    } else if words.g_tenths.contains(&100) {
        set(words, state, record)?;
    }
    local_offset::change(words, state)
}

/// G10.
fn set(words: &Words, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    match kind(words, state)? {
        0 => tool_table::reload(state),
        1 => tool_table::set(Values::Offsets, words, state, record),
        10 => tool_table::set(Values::Coordinates, words, state, record),
        11 => tool_table::set(Values::FixtureCoordinates, words, state, record),
        20 => set_origin(true, words, state),
        _ => set_origin(false, words, state),
    }
}

/// Rule offsets.set-without-axes. Whether G10 L2 without an axis word is refused is a choice.
fn check_set_axes(words: &Words, state: &mut State) -> Result<(), StepError> {
    if has_axis_words(words) {
        return Ok(());
    }
    let rule = rule::offsets::SET_WITHOUT_AXES;
    if state.choices.is(choice::offsets::SetWithoutAxes::Refused) {
        return Err(refuse(rule, FaultKind::MissingWord, "G10 L2 needs an axis word"));
    }
    state.coverage.accepted(rule);
    Ok(())
}

/// G10 L2 and L20.
///
/// Rule offsets.set. It sets the origin of system P to the axis values; P0 is the active one (offsets.set-active).
/// Rule offsets.set-replaces. They replace the old ones, whatever the distance mode.
/// Rule offsets.set-omitted-axes. Axes without a word keep theirs.
/// Rule offsets.rotation. R of G10 L2 is the angle by which the system is turned about Z; without R it stays.
fn set_origin(calculated: bool, words: &Words, state: &mut State) -> Result<(), StepError> {
    if calculated {
        state.dialect().check_calculated_axes(words, state)?;
    } else {
        check_set_axes(words, state)?;
    }
    let system = system(words, state)?;
    if system == state.modes.work_offset {
        in_force_changes(state)?;
    }
    let first = first_parameter(system);
    let named = offset_words(words, state);
    if calculated {
        store_calculated(system, &named, state);
    } else {
        for (axis, value) in named {
            store_length(first, axis, value, state);
        }
    }
    if let Some(rotation) = word(words, 'r') {
        state.coverage.accepted(rule::offsets::ROTATION);
        state.parameters.store(first + 9, rotation);
    }
    for rule in [rule::offsets::SET, rule::offsets::SET_REPLACES, rule::offsets::SET_OMITTED_AXES] {
        state.coverage.accepted(rule);
    }
    if system == state.modes.work_offset {
        state.coverage.accepted(rule::offsets::SET_IMMEDIATE);
        state.coverage.accepted(rule::offsets::LOCAL_STAYS);
        if calculated {
            reload(state);
        } else {
            state.dialect().reload_turned_system(state);
        }
    } else {
        state.coverage.accepted(rule::offsets::SET_INACTIVE);
    }
    Ok(())
}

/// Rule offsets.calculate. G10 L20 sets the origin of a system so that the current point gets the axis values in it,
/// with the local offset and the tool offset in force. Rule offsets.calculate-needs-axes. It needs an axis word.
fn store_calculated(system: u32, named: &[(Axis, f64)], state: &mut State) {
    state.coverage.accepted(rule::offsets::CALCULATE);
    let mut modes = state.modes.clone();
    let machine = modes.machine_point(state.position);
    modes.work_offset = system;
    let (parameters, choices, machine_data) = (&state.parameters, &state.choices, &state.machine);
    let unit = state.stored_unit();
    let stored = |number| stored_offset(number, parameters, choices, machine_data);
    modes.load_work_offset(stored, unit);
    let mut wanted = modes.program_point(machine);
    for (axis, value) in named {
        *wanted.get_mut(*axis) = *value;
    }
    modes.g5x_offset = Position::default();
    let from_origin = modes.machine_point(wanted);
    let origin = each(machine, from_origin, |machine, point| machine - point);
    let rotated = modes.rotation != 0.0;
    let is_named = |axis: Axis| named.iter().any(|(named, _)| *named == axis);
    let in_plane = is_named(Axis::X) || is_named(Axis::Y);
    for axis in Axis::ALL.iter().copied() {
        let turns_too = rotated && in_plane && [Axis::X, Axis::Y].contains(&axis);
        if is_named(axis) || turns_too {
            store_length(first_parameter(system), axis, origin.get(axis), state);
        }
    }
}

/// Rule offsets.set-needs-kind. L says what G10 sets.
fn kind(words: &Words, state: &State) -> Result<i32, StepError> {
    let rule = rule::offsets::SET_NEEDS_KIND;
    let Some(kind) = word(words, 'l') else {
        return Err(refuse(rule, FaultKind::MissingWord, "G10 needs L"));
    };
    match state.dialect().offset_kind(kind, state) {
        Some(kind @ (0 | 1 | 2 | 10 | 11 | 20)) => Ok(kind),
        _ => Err(refuse(rule, FaultKind::WordOutOfRange, format!("there is no G10 L{kind}"))),
    }
}

/// Rule offsets.set-number. P is an integer from 0 to 9; 0 is the active system.
/// Rule offsets.systems. Whether there are systems 7 to 9 is a choice.
/// Rule offsets.set-active-number. Whether 0 is refused is a choice.
fn system(words: &Words, state: &mut State) -> Result<u32, StepError> {
    let Some(number) = state.dialect().programmed_system(words, state) else {
        let message = "G10 L2 and L20 need P, the coordinate system";
        return Err(refuse(rule::offsets::SET_NEEDS_NUMBER, FaultKind::MissingWord, message));
    };
    let last = match state.choices.get() {
        choice::offsets::Systems::Nine => 9,
        choice::offsets::Systems::Six => 6,
    };
    let message = || format!("P{number} is not a coordinate system; expected 0 to {last}");
    let rule = rule::offsets::SET_NUMBER;
    let whole = whole(number).ok_or_else(|| refuse(rule, FaultKind::NotAnInteger, message()))?;
    match u32::try_from(whole) {
        Ok(system) if system <= last => {
            state.coverage.accepted(rule::offsets::SYSTEMS);
            if system > 0 {
                return Ok(system);
            }
            let rule = rule::offsets::SET_ACTIVE_NUMBER;
            if state.choices.is(choice::offsets::SetActiveNumber::Refused) {
                return Err(refuse(
                    rule,
                    FaultKind::WordOutOfRange,
                    "P0: expected a coordinate system from 1 to 9",
                ));
            }
            state.coverage.accepted(rule);
            state.coverage.accepted(rule::offsets::SET_ACTIVE);
            Ok(state.modes.work_offset)
        }
        Ok(7..=9) => Err(refuse(rule::offsets::SYSTEMS, FaultKind::WordOutOfRange, message())),
        Ok(_) | Err(_) => {
            state.coverage.refused(rule::offsets::SYSTEMS);
            Err(refuse(rule, FaultKind::WordOutOfRange, message()))
        }
    }
}
