//! M6 and M61.

use gaugeblock_vocabulary::{Axis, ControllerMode, Effect, FaultKind, Position, SpindleTurn};

use super::positions;
use super::{pass, whole, word};
use crate::ids::{choice, rule};
use crate::rs274::environment::stub;
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Puts the selected tool into the spindle.
///
/// Rule tool.change. The tool in the spindle is then the one that T selected last, on the same line or before; none
/// is selected any more. Rule tool.change-stops-spindle. The spindle is stopped afterwards. Rule tool.change-keeps.
/// Nothing else changes: coolant flows on, and the length offset stays (tool.change-keeps-length).
///
/// # Errors
/// Rules tool.change-without-selection and tool.change-under-compensation.
pub fn change(state: &mut State, record: &mut Record) -> Result<(), StepError> {
    super::not_under_compensation(
        rule::tool::CHANGE_UNDER_COMPENSATION,
        choice::tool::ChangeUnderCompensation::Refused,
        state,
    )?;
    let tool = tool_to_load(state)?;
    before_moving(state);
    state.dialect().moves_to_change(true, state);
    moves(state, record);
    state.dialect().moves_to_change(false, state);
    if state.environment.tools_are_changed_by_hand() {
        state.coverage.accepted(rule::tool::CHANGE_BY_HAND);
        record.effect(state, Effect::PromptTool { tool });
    }
    pass(state.environment.tool_change_time(), state);
    let old = swap(tool, state);
    state.dialect().selection_is_used(old, state);
    state.coverage.accepted(rule::tool::CHANGE);
    state.coverage.accepted(rule::tool::CHANGE_KEEPS);
    state.coverage.accepted(rule::tool::CHANGE_KEEPS_LENGTH);
    state.environment.machine_is_asked();
    record.effect(state, Effect::ChangeTool { tool });
    Ok(())
}

/// Rule tool.change-without-selection. Whether a change needs a T since the change before is a choice.
fn tool_to_load(state: &mut State) -> Result<i32, StepError> {
    let selected = state.dialect().selected_tool(state);
    if selected.is_none() && !state.environment.is_stand_alone() {
        let rule = rule::tool::CHANGE_WITHOUT_SELECTION;
        if state.choices.is(choice::tool::ChangeWithoutSelection::Refused) {
            return Err(refuse(rule, FaultKind::MissingWord, "M6, and no tool is selected"));
        }
        state.coverage.accepted(rule);
    }
    // The stub of the stand-alone interpreter changes to the tool of the last T again.
    let others = if state.environment.is_stand_alone() { state.selected_tool } else { state.tool };
    Ok(selected.unwrap_or(others).max(0))
}

/// The spindles stop, unless the machine changes tools while they turn; only then does it move to where tools are
/// changed. On a machine with several spindles it is a choice which of them stop.
pub fn before_moving(state: &mut State) {
    if state.machine.tool_change.with_spindle_on {
        state.coverage.accepted(rule::tool::CHANGE_SPINDLE_ON);
        return;
    }
    let every = state.choices.is(choice::tool::ChangeSpindles::All);
    let stopped = if every { state.all_spindles() } else { vec![0] };
    for place in stopped {
        state.dialect().set_turn(SpindleTurn::Stopped, place, state);
    }
    state.coverage.accepted(rule::tool::CHANGE_STOPS_SPINDLE);
}

/// Rule tool.change-quill-up. If the machine is set so, Z goes to machine zero first.
/// Rule tool.change-at-g30. If the machine is set so, it goes to the position of G30 first.
fn moves(state: &mut State, record: &mut Record) {
    if state.machine.tool_change.quill_up {
        let here = state.modes.machine_point(state.position);
        let z = state.dialect().reached(Axis::Z, 0.0, state);
        positions::traverse(Position { z, ..here }, state, record);
        state.coverage.accepted(rule::tool::CHANGE_QUILL_UP);
    }
    if state.machine.tool_change.at_g30 {
        positions::traverse(positions::destination(positions::G30_POSITION, state), state, record);
        state.coverage.accepted(rule::tool::CHANGE_AT_G30);
    }
}

/// Rule tool.change-back. The tool that was in the spindle goes back into the changer, from where it can be taken
/// again. Rule tool.change-same. A change to the tool in the spindle is allowed. Rule tool.change-zero. After T0 the
/// spindle is empty. Choice tool.old-tool-place: where tools change places, whether the old tool goes to the slot of
/// the new one. Returns the old tool.
fn swap(tool: i32, state: &mut State) -> i32 {
    let old = std::mem::replace(&mut state.tool, tool);
    if tool > 0 || !state.environment.is_stand_alone() {
        state.known_tool = tool;
    }
    state.coverage.accepted(if tool == old {
        rule::tool::CHANGE_SAME
    } else {
        rule::tool::CHANGE_BACK
    });
    if tool == 0 && !state.machine.random_tool_changer {
        state.coverage.accepted(rule::tool::CHANGE_ZERO);
    }
    let exchanged = state.machine.random_tool_changer
        && state.choices.is(choice::tool::OldToolPlace::SlotOfTheNew);
    let slot = state.slots.iter().find(|(_, stored)| **stored == tool).map(|(slot, _)| *slot);
    if let Some(slot) = slot.filter(|_| exchanged && tool != old) {
        // M61 may have put it into the spindle without taking it out of its slot; it lies in one place.
        state.slots.values_mut().filter(|stored| **stored == old).for_each(|stored| *stored = 0);
        state.slots.insert(slot, old);
    }
    old
}

/// Which tools are selected, and which numbers are those of tools.
pub(crate) trait ToolChangeRules {
    /// Rule tool.select-integer. The number that T selects.
    fn selected_number(&self, value: f64, _state: &State) -> Option<i32> {
        whole(value)
    }

    /// Rule tool.change-without-selection. The tool that T has selected since the last change.
    fn selected_tool(&self, state: &State) -> Option<i32> {
        state.selected_for_change.then_some(state.prepared_tool)
    }

    /// Rule tool.change. After a change from the `_old` tool no tool is selected any more.
    fn selection_is_used(&self, _old: i32, state: &mut State) {
        state.selected_for_change = false;
        state.prepared_tool = -1;
    }

    /// Rule tool.change-at-g30. The moves to where the tool is changed begin or are over: they are rapid moves.
    fn moves_to_change(&self, _begin: bool, _state: &mut State) {}

    /// Rule tool.set-number-integer. The Q of M61 is a whole number.
    fn tool_number(&self, value: f64, _state: &State) -> Option<i32> {
        whole(value)
    }
}

/// Says which tool is in the spindle.
///
/// Rule tool.set-number. M61 makes tool Q the current one, without a tool change; 0 is no tool (tool.set-number-zero).
/// Rule tool.set-number-keeps-length. The length offset stays.
///
/// # Errors
/// Rules tool.set-number-range, tool.set-number-integer, tool.set-number-unknown, tool.set-number-in-program.
pub fn set_number(words: &Words, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let in_program = rule::tool::SET_NUMBER_IN_PROGRAM;
    let by_program = state.modes.controller_mode == ControllerMode::Auto;
    if by_program && state.choices.is(choice::tool::SetNumberInProgram::Refused) {
        let message = "M61 in a program";
        return Err(refuse(in_program, FaultKind::ControllerMode, message));
    }
    let tool = number(words, state)?;
    let unknown = tool > 0 && state.table_tool(tool).is_none();
    let rule = rule::tool::SET_NUMBER_UNKNOWN;
    if unknown && state.choices.is(choice::tool::SetNumberUnknown::Refused) {
        let message = format!("the tool table holds no tool {tool}");
        return Err(refuse(rule, FaultKind::ToolNotFound, message));
    }
    let zero = if tool == 0 { rule::tool::SET_NUMBER_ZERO } else { rule::tool::SET_NUMBER };
    for accepted in [rule, in_program, zero, rule::tool::SET_NUMBER_KEEPS_LENGTH] {
        state.coverage.accepted(accepted);
    }
    state.tool = tool;
    if state.environment.is_stand_alone() {
        stub::names_tool(tool, state);
    } else {
        state.known_tool = tool;
    }
    state.environment.machine_is_asked();
    record.effect(state, Effect::SetToolNumber { tool });
    Ok(())
}

/// Rule tool.set-number-range. Q is needed, and zero or greater. Rule tool.set-number-integer. It is a whole number.
fn number(words: &Words, state: &mut State) -> Result<i32, StepError> {
    let rule = rule::tool::SET_NUMBER_RANGE;
    let Some(value) = word(words, 'q') else {
        return Err(refuse(rule, FaultKind::WordOutOfRange, "M61 needs Q, the number of the tool"));
    };
    let number = state.dialect().tool_number(value, state);
    if value < 0.0 && number != Some(0) {
        return Err(refuse(rule, FaultKind::WordOutOfRange, format!("M61 with Q{value}")));
    }
    state.coverage.accepted(rule);
    let rule = rule::tool::SET_NUMBER_INTEGER;
    let message = || format!("Q{value} is not a tool number");
    let number = number.ok_or_else(|| refuse(rule, FaultKind::NotAnInteger, message()))?;
    state.coverage.accepted(rule);
    Ok(number)
}
