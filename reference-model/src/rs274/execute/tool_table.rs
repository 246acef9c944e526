//! G10 L0, L1, L10, L11: the tool table.

use gaugeblock_vocabulary::{Axis, Compensation, Effect, FaultKind, Position, Tool};

use super::offset_storage::stored_offset;
use super::target::offset_words;
use super::{whole, word};
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::modes::{converted, each, unit_size};
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Where the values of the axis words come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Values {
    /// L1: they are the offsets.
    Offsets,
    /// L10: they are the coordinates that the current point is to have.
    Coordinates,
    /// L11: the same in G59.3 without a local offset.
    FixtureCoordinates,
}

/// The system in which G10 L11 measures: G59.3.
const FIXTURE: u32 = 9;

/// Rule tool.reload. G10 L0 reads the tool table again, which holds what was written into it.
/// Rule tool.reload-needs-empty-spindle. No tool may be in the spindle.
pub(super) fn reload(state: &mut State) -> Result<(), StepError> {
    if state.known_tool != 0 {
        let message = format!("G10 L0 with tool {} in the spindle", state.known_tool);
        let rule = rule::tool::RELOAD_NEEDS_EMPTY_SPINDLE;
        return Err(refuse(rule, FaultKind::ModalConflict, message));
    }
    state.coverage.accepted(rule::tool::RELOAD);
    state.environment.machine_is_asked();
    Ok(())
}

/// When a controller changes its tool table.
pub(crate) trait ToolTableRules {
    /// Rule tool.entry-under-compensation. The tool table stays as it is while cutter compensation is on.
    fn check_entry_under_compensation(&self, state: &State) -> Result<(), StepError> {
        if state.modes.compensation == Compensation::Off {
            return Ok(());
        }
        let message = "the tool table while cutter compensation is on";
        let rule = rule::tool::ENTRY_UNDER_COMPENSATION;
        Err(refuse(rule, FaultKind::CompensationActive, message))
    }
}

/// Writes into the tool table.
///
/// Rule tool.entry. G10 L1 sets offsets, radius (R), front and back angle (I, J) and orientation (Q) of tool P.
/// Rule tool.entry-omitted-words. What has no word stays.
/// Rule tool.entry-keeps-offset. A tool offset in force stays as it is; the parameters of the tool change at once.
///
/// # Errors
/// Rule tool.entry-under-compensation and those of the words.
pub(super) fn set(
    values: Values,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    state.dialect().check_entry_under_compensation(state)?;
    let number = number(words, state)?;
    let orientation = orientation(words)?;
    something(words, state)?;
    let mut tool = state.table_tool(number).cloned().unwrap_or_default();
    tool.offset = offset(values, &tool, words, state)?;
    let unit = unit_size(state.modes.units) / unit_size(state.stored_unit());
    if let Some(radius) = word(words, 'r') {
        tool.diameter = 2.0 * radius * unit;
    }
    tool.front_angle = word(words, 'i').unwrap_or(tool.front_angle);
    tool.back_angle = word(words, 'j').unwrap_or(tool.back_angle);
    tool.orientation = orientation.unwrap_or(tool.orientation);
    for rule in [
        match values {
            Values::Offsets => rule::tool::ENTRY,
            Values::Coordinates => rule::tool::ENTRY_CALCULATED,
            Values::FixtureCoordinates => rule::tool::ENTRY_CALCULATED_FIXTURE,
        },
        rule::tool::ENTRY_OMITTED_WORDS,
        rule::tool::ENTRY_KEEPS_OFFSET,
    ] {
        state.coverage.accepted(rule);
    }
    let effect = Effect::SetToolEntry {
        tool: number,
        offset: converted(tool.offset, state.stored_unit(), state.modes.units),
        diameter: tool.diameter / unit,
        front_angle: tool.front_angle,
        back_angle: tool.back_angle,
        orientation: i32::from(tool.orientation),
    };
    if let Some(old) = state.machine.tools.iter_mut().find(|old| old.number == tool.number) {
        *old = tool;
    }
    record.effect(state, effect);
    if state.environment.is_stand_alone() {
        entry_in_spindle(number, state);
    }
    Ok(())
}

/// The stub of the stand-alone interpreter begins with the slot of the first tool of the table, though nothing is in
/// the spindle: a tool whose entry is written there, or in the slot of a later change, is taken to be in the spindle.
fn entry_in_spindle(number: i32, state: &mut State) {
    let first = state.machine.tools.first().map(|tool| i64::from(tool.number));
    let slot = if state.tool == 0 { first } else { Some(i64::from(state.tool)) };
    if slot == Some(i64::from(number)) {
        state.known_tool = number;
    }
}

/// Rule tool.entry-needs-number. P is needed.
/// Rule tool.entry-zero. It is not zero.
/// Rule tool.entry-unknown-tool. The tool table holds the tool.
fn number(words: &Words, state: &State) -> Result<i32, StepError> {
    let Some(value) = word(words, 'p') else {
        let message = "G10 needs P, the number of a tool";
        return Err(refuse(rule::tool::ENTRY_NEEDS_NUMBER, FaultKind::MissingWord, message));
    };
    let rule = rule::tool::ENTRY_UNKNOWN_TOOL;
    let message = || format!("the tool table holds no tool {value}");
    let number = whole(value).ok_or_else(|| refuse(rule, FaultKind::NotAnInteger, message()))?;
    match number {
        0 => Err(refuse(rule::tool::ENTRY_ZERO, FaultKind::WordOutOfRange, "P0 is not a tool")),
        ..0 => Err(refuse(rule, FaultKind::WordOutOfRange, message())),
        _ if state.table_tool(number).is_none() => {
            Err(refuse(rule, FaultKind::ToolNotFound, message()))
        }
        _ => Ok(number),
    }
}

/// Rule tool.entry-orientation. Q is an integer from 0 to 9.
fn orientation(words: &Words) -> Result<Option<u8>, StepError> {
    let Some(value) = word(words, 'q') else { return Ok(None) };
    let rule = rule::tool::ENTRY_ORIENTATION;
    let message = || format!("Q{value} is not an orientation; expected 0 to 9");
    let whole = whole(value).ok_or_else(|| refuse(rule, FaultKind::NotAnInteger, message()))?;
    match u8::try_from(whole) {
        Ok(orientation @ 0..=9) => Ok(Some(orientation)),
        _ => Err(refuse(rule, FaultKind::WordOutOfRange, message())),
    }
}

/// Rule tool.entry-without-words. Whether nothing but the tool may be programmed is a choice.
fn something(words: &Words, state: &mut State) -> Result<(), StepError> {
    let any = has_axis_words(words) || "rijq".chars().any(|letter| word(words, letter).is_some());
    if any {
        return Ok(());
    }
    let rule = rule::tool::ENTRY_WITHOUT_WORDS;
    if state.choices.is(choice::tool::EntryWithoutWords::Refused) {
        return Err(refuse(rule, FaultKind::MissingWord, "a tool, and nothing to set of it"));
    }
    state.coverage.accepted(rule);
    Ok(())
}

/// The offset that the tool is to have, machine unit.
///
/// Rule tool.entry-calculated. With G10 L10 the current point has the coordinates of the axis words once the offset is
/// applied, with the offsets in force.
/// Rule tool.entry-calculated-fixture. With G10 L11 it has them in G59.3 without a local offset.
fn offset(
    values: Values,
    tool: &Tool,
    words: &Words,
    state: &mut State,
) -> Result<Position, StepError> {
    let mut modes = state.modes.clone();
    let machine = modes.machine_point(state.position);
    let machine = state.dialect().measured(machine, state);
    let named = offset_words(words, state);
    let mut wanted = Position::default();
    for (axis, value) in &named {
        *wanted.get_mut(*axis) = *value;
    }
    let values = if values == Values::Offsets {
        wanted
    } else {
        if values == Values::FixtureCoordinates {
            modes.work_offset = FIXTURE;
            let (parameters, choices) = (&state.parameters, &state.choices);
            let unit = state.stored_unit();
            let stored = |number| stored_offset(number, parameters, choices, &state.machine);
            modes.load_work_offset(stored, unit);
            modes.g92_offset = Position::default();
        }
        let plane = named.iter().filter(|(axis, _)| [Axis::X, Axis::Y].contains(axis)).count();
        if modes.rotation != 0.0 && plane == 1 {
            let what = "the tool offset that gives one coordinate of a rotated plane a value";
            return Err(StepError::Unspecified(what.to_owned()));
        }
        modes.tool_offset = Position::default();
        let without_tool = modes.machine_point(wanted);
        each(machine, without_tool, |machine, point| machine - point)
    };
    let values = converted(values, state.modes.units, state.stored_unit());
    let mut offset = tool.offset;
    for (axis, _) in named {
        *offset.get_mut(axis) = values.get(axis);
    }
    Ok(offset)
}
