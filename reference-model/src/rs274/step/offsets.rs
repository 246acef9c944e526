//! G54 to G59.3, G10 L2, G52.

use gaugeblock_trace::{Axis, Compensation, FaultKind, Motion};

use super::target::offset_words;
use super::{whole, word};
use crate::rs274::machine::State;
use crate::rs274::modes::{converted, first_parameter};
use crate::rs274::order::has_axis_words;
use crate::rs274::quirks::settings as quirks;
use crate::rs274::read::Words;
use crate::rs274::refusal::{Halt, refuse};

/// Selects a coordinate system.
///
/// Rule offsets.select. G54 to G59.3 are systems 1 to 9.
///
/// # Errors
/// Rule offsets.select-under-compensation.
pub fn select(words: &Words, state: &mut State) -> Result<(), Halt> {
    let system = words.g.iter().find_map(|code| match code {
        540 | 550 | 560 | 570 | 580 | 590 => Some((code - 530) / 10),
        591..=593 => Some(code - 584),
        _ => None,
    });
    let Some(system) = system else { return Ok(()) };
    if state.modes.compensation != Compensation::Off {
        let message = "a coordinate system is selected while cutter compensation is on";
        let rule = "offsets.select-under-compensation";
        return Err(refuse(rule, FaultKind::CompensationActive, message));
    }
    state.evidence.accepted("offsets.select");
    use_system(system, state);
    Ok(())
}

/// Rule offsets.select-moves-nothing. The machine stays where it is; the same point gets the coordinates of the system.
/// Rule offsets.stored. Its origin comes from the parameters.
/// Rule offsets.select-number. #5220 holds its number.
/// Rule offsets.local-stays. A local offset continues.
pub(crate) fn use_system(system: u32, state: &mut State) {
    for rule in [
        "offsets.select-moves-nothing",
        "offsets.stored",
        "offsets.select-number",
        "offsets.local-stays",
    ] {
        state.evidence.accepted(rule);
    }
    state.modes.work_offset = system;
    state.parameters.store(5220, f64::from(system));
    reload(state);
}

/// Reads the origin of the selected system again; the machine stays where it is.
fn reload(state: &mut State) {
    let machine = state.modes.machine_point(state.position);
    let parameters = &state.parameters;
    state.modes.load_work_offset(|number| parameters.stored(number), state.machine.length_unit);
    state.position = state.modes.program_point(machine);
}

/// Changes the data of offsets.
///
/// Rule modal-groups.motion-suspended. The axis words are not the motion mode's, which holds again in the next block.
///
/// # Errors
/// Those of G10 and G52.
pub fn change(words: &Words, state: &mut State) -> Result<(), Halt> {
    if has_axis_words(words) && state.modes.motion != Motion::None {
        state.evidence.accepted("modal-groups.motion-suspended");
    }
    if words.g.contains(&100) { set_origin(words, state) } else { set_local(words, state) }
}

/// G10 L2.
///
/// Rule offsets.set. It sets the origin of system P to the axis values; P0 is the active one (offsets.set-active).
/// Rule offsets.set-replaces. They replace the old ones, whatever the distance mode.
/// Rule offsets.set-omitted-axes. Axes without a word keep theirs.
fn set_origin(words: &Words, state: &mut State) -> Result<(), Halt> {
    kind(words)?;
    let system = system(words, state)?;
    let first = first_parameter(system);
    for (axis, value) in offset_words(words, state) {
        store_length(first, axis, value, state);
    }
    if let Some(rotation) = word(words, 'r') {
        state.parameters.store(first + 9, rotation);
    }
    for rule in ["offsets.set", "offsets.set-replaces", "offsets.set-omitted-axes"] {
        state.evidence.accepted(rule);
    }
    if system == state.modes.work_offset {
        state.evidence.accepted("offsets.set-immediate");
        state.evidence.accepted("offsets.local-stays");
        reload(state);
    } else {
        state.evidence.accepted("offsets.set-inactive");
    }
    Ok(())
}

/// Rule offsets.set-needs-kind. L says what G10 sets.
fn kind(words: &Words) -> Result<(), Halt> {
    let rule = "offsets.set-needs-kind";
    let Some(kind) = word(words, 'l') else {
        return Err(refuse(rule, FaultKind::MissingWord, "G10 needs L"));
    };
    match whole(kind) {
        Some(2) => Ok(()),
        Some(kind @ (0 | 1 | 10 | 11 | 20)) => {
            Err(Halt::Unsupported(format!("G10 L{kind}: tool table and calculated origins")))
        }
        _ => Err(refuse(rule, FaultKind::WordOutOfRange, format!("there is no G10 L{kind}"))),
    }
}

/// Rule offsets.set-number. P is an integer from 0 to 9; 0 is the active system.
fn system(words: &Words, state: &mut State) -> Result<u32, Halt> {
    let Some(number) = word(words, 'p').map(|number| quirks::origin_number(number, state)) else {
        let message = "G10 L2 needs P, the coordinate system";
        return Err(refuse("offsets.set-needs-number", FaultKind::MissingWord, message));
    };
    let message = || format!("P{number} is no coordinate system from 0 to 9");
    let rule = "offsets.set-number";
    let whole = whole(number).ok_or_else(|| refuse(rule, FaultKind::NotAnInteger, message()))?;
    match u32::try_from(whole) {
        Ok(0) => {
            state.evidence.accepted("offsets.set-active");
            Ok(state.modes.work_offset)
        }
        Ok(system @ 1..=9) => Ok(system),
        _ => Err(refuse(rule, FaultKind::WordOutOfRange, message())),
    }
}

/// Stores a coordinate in the machine's length unit, as one of nine parameters from a first one.
fn store_length(first: u32, axis: Axis, value: f64, state: &mut State) {
    let mut position = gaugeblock_trace::Position::default();
    *position.get_mut(axis) = value;
    let stored = converted(position, state.modes.units, state.machine.length_unit).get(axis);
    let place = (first..).zip(Axis::ALL).find(|(_, known)| **known == axis).map(|(place, _)| place);
    state.parameters.store(place.expect("offsets: an axis is one of nine"), stored);
}

/// G52.
///
/// Rule offsets.local. It shifts the coordinate system by its axis values, after the rotation, and moves nothing.
/// Rule offsets.local-replaces. The values count from the coordinate system, not from an earlier G52.
/// Rule offsets.local-omitted-axes. Axes without a word keep theirs.
/// Rule offsets.local-parameters. #5211 to #5219 hold the offset, #5210 tells that it applies.
///
/// # Errors
/// Rule offsets.local-needs-axes.
fn set_local(words: &Words, state: &mut State) -> Result<(), Halt> {
    if !has_axis_words(words) {
        let message = "G52 needs an axis word";
        return Err(refuse("offsets.local-needs-axes", FaultKind::MissingWord, message));
    }
    for rule in [
        "offsets.local",
        "offsets.local-replaces",
        "offsets.local-omitted-axes",
        "offsets.local-parameters",
    ] {
        state.evidence.accepted(rule);
    }
    let machine = state.modes.machine_point(state.position);
    let mut offset = state.modes.g92_offset;
    for (axis, value) in offset_words(words, state) {
        *offset.get_mut(axis) = value;
    }
    state.modes.g92_offset = offset;
    state.modes.local_applies = true;
    state.position = state.modes.program_point(machine);
    for axis in Axis::ALL.iter().copied() {
        store_length(5211, axis, offset.get(axis), state);
    }
    state.parameters.store(5210, 1.0);
    Ok(())
}
