//! T.

use gaugeblock_vocabulary::{Effect, FaultKind, Tool};

use super::word;
use crate::ids::{Rule, choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Prepares a tool; it is not changed until M6 (tool.select-changes-nothing).
///
/// Rule tool.select. T names the tool. Of several the last one counts at the next change (tool.select-latest).
/// Choice tool.selected-by: whether the number is that of a tool or that of a slot of the changer.
///
/// # Errors
/// Rules tool.select-integer, tool.select-negative, tool.select-unknown, tool.select-zero-random.
pub fn select(words: &Words, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let Some(value) = word(words, 't') else { return Ok(()) };
    let number = state.dialect().selected_number(value, state).ok_or_else(|| {
        let message = format!("T{value} is not a whole number");
        refuse(rule::tool::SELECT_INTEGER, FaultKind::NotAnInteger, message)
    })?;
    if number < 0 {
        let message = format!("T{number} is negative");
        return Err(refuse(rule::tool::SELECT_NEGATIVE, FaultKind::WordOutOfRange, message));
    }
    let tool = selected(number, state)?;
    if state.selected_for_change {
        state.coverage.accepted(rule::tool::SELECT_LATEST);
    }
    for rule in [rule::tool::SELECT, rule::tool::SELECT_INTEGER, rule::tool::SELECT_CHANGES_NOTHING]
    {
        state.coverage.accepted(rule);
    }
    state.prepared_tool = tool.unwrap_or(-1);
    state.selected_tool = tool.unwrap_or(0);
    state.selected_for_change = true;
    record.effect(state, Effect::PrepareTool { tool: tool.unwrap_or(0) });
    Ok(())
}

/// Rule tool.select-zero. T0 selects no tool.
/// Rule tool.select-zero-random. Where tools change places, tool 0 is a tool like any other, there or not.
/// Rule tool.empty-slot. Whether a number that no tool has may be selected is a choice; then there is no tool
/// in the spindle after the change.
fn selected(number: i32, state: &mut State) -> Result<Option<i32>, StepError> {
    let random = state.machine.random_tool_changer;
    if number == 0 && !random {
        state.coverage.accepted(rule::tool::SELECT_ZERO);
        return Ok(None);
    }
    let by_slot = state.choices.is(choice::tool::SelectedBy::Slot);
    if by_slot && random && (number == 0 || in_slot(number, state).is_none()) {
        let why = "what T selects in slot 0, or in an empty slot, where tools change places";
        return Err(StepError::Unspecified(why.to_owned()));
    }
    let found =
        if by_slot { in_slot(number, state) } else { state.table_tool(number).map(|_| number) };
    state.coverage.accepted(rule::tool::SELECTED_BY);
    let rule = if number == 0 { rule::tool::SELECT_ZERO_RANDOM } else { rule::tool::EMPTY_SLOT };
    match found {
        Some(tool) => {
            state.coverage.accepted(rule::tool::SELECT_UNKNOWN);
            if number == 0 {
                state.coverage.accepted(rule);
            }
            Ok(Some(tool))
        }
        None if state.choices.is(choice::tool::EmptySlot::Accepted) => {
            state.coverage.accepted(rule);
            Ok(None)
        }
        None => {
            if number == 0 {
                state.coverage.refused(rule);
            } else {
                state.coverage.refused(rule::tool::EMPTY_SLOT);
            }
            let message = format!("T{number}, and the tool table holds no such tool");
            Err(refuse(rule::tool::SELECT_UNKNOWN, FaultKind::ToolNotFound, message))
        }
    }
}

/// The tool that is in a slot of the changer, or whose slot it is while it is in the spindle.
fn in_slot(slot: i32, state: &State) -> Option<i32> {
    let slot = u32::try_from(slot).ok()?;
    state.slots.get(&slot).copied().filter(|tool| *tool != 0)
}

/// The tool that a word names: zero is the tool in the spindle, unless tools change places.
///
/// Choice tool.offset-numbers. Where the number is that of a slot, an empty slot names no tool.
///
/// # Errors
/// The tool table does not hold it; refused by the rule that is given.
pub(crate) fn named(tool: i32, rule: Rule, state: &State) -> Result<Option<&Tool>, StepError> {
    let by_slot = state.choices.is(choice::tool::OffsetNumbers::Slot);
    if tool > 0 && by_slot && !state.machine.random_tool_changer {
        return Ok(in_slot(tool, state).and_then(|tool| state.table_tool(tool)));
    }
    let zero_is_spindle = tool == 0 && !state.machine.random_tool_changer;
    let tool = if zero_is_spindle { state.known_tool } else { tool };
    if zero_is_spindle && tool == 0 {
        return Ok(None);
    }
    let message = || format!("the tool table holds no tool {tool}");
    state.table_tool(tool).map(Some).ok_or_else(|| refuse(rule, FaultKind::ToolNotFound, message()))
}
