//! T.

use gaugeblock_trace::{Effect, FaultKind, Tool};

use super::{whole, word};
use crate::rs274::machine::State;
use crate::rs274::read::Words;
use crate::rs274::refusal::{Halt, refuse};
use crate::rs274::task::Record;

/// Prepares a tool; zero means that no tool is selected, where tools have fixed places.
///
/// # Errors
/// The tool table does not hold the tool: the chapter on tool changes will say how that is refused.
pub fn select(words: &Words, state: &mut State, record: &mut Record) -> Result<(), Halt> {
    let Some(value) = word(words, 't') else { return Ok(()) };
    let tool = whole(value).filter(|tool| *tool >= 0);
    let tool = tool.ok_or_else(|| Halt::Unsupported(format!("T{value}: tool changes")))?;
    let empty = tool == 0 && !state.machine.random_tool_changer;
    if !empty && entry(tool, state).is_none() {
        return Err(Halt::Unsupported(format!(
            "T{tool}, which the tool table does not hold: tool changes"
        )));
    }
    state.prepared_tool = tool;
    record.effect(state, Effect::PrepareTool { tool });
    Ok(())
}

/// A tool of the tool table.
fn entry(number: i32, state: &State) -> Option<&Tool> {
    let number = u32::try_from(number).ok()?;
    state.machine.tools.iter().find(|tool| tool.number == number)
}

/// The tool that a word names: zero is the tool in the spindle, unless tools change places.
///
/// # Errors
/// The tool table does not hold it; refused by the rule that is given.
pub(crate) fn named<'a>(
    tool: i32,
    rule: &'static str,
    state: &'a State,
) -> Result<Option<&'a Tool>, Halt> {
    let zero_is_spindle = tool == 0 && !state.machine.random_tool_changer;
    let tool = if zero_is_spindle { state.tool } else { tool };
    if zero_is_spindle && tool == 0 {
        return Ok(None);
    }
    let message = || format!("the tool table holds no tool {tool}");
    entry(tool, state).map(Some).ok_or_else(|| refuse(rule, FaultKind::ToolNotFound, message()))
}
