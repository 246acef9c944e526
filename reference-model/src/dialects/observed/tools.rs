//! Quirks of tools and the tool table.

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::tool_change::ToolChangeRules;
use crate::rs274::execute::tool_table::ToolTableRules;
use crate::rs274::execute::whole;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl ToolChangeRules for Observed {
    /// Quirk grbl.tool-number-cut. The whole part counts.
    fn selected_number(&self, value: f64, state: &State) -> Option<i32> {
        let cut = state.has_quirk(quirk::grbl::TOOL_NUMBER_CUT);
        Documented.selected_number(if cut { value.trunc() } else { value }, state)
    }

    /// Quirk linuxcnc.selection-kept. The tool of a change that changed nothing is selected still.
    fn selected_tool(&self, state: &State) -> Option<i32> {
        Documented.selected_tool(state).or(state.memory.kept_selection)
    }

    /// Quirk linuxcnc.selection-kept. A change to the tool in the spindle keeps the selection.
    fn selection_is_used(&self, old: i32, state: &mut State) {
        Documented.selection_is_used(old, state);
        let keeps =
            state.tool == old && old > 0 && state.has_quirk(quirk::linuxcnc::SELECTION_KEPT);
        state.memory.kept_selection = keeps.then_some(old);
    }

    /// Quirk linuxcnc.tool-change-move. Overrides of zero do not hold the moves to where the tool is changed.
    fn moves_to_change(&self, begin: bool, state: &mut State) {
        state.memory.moves_to_change = begin;
    }

    /// Quirk rs274.tool-number-rounded. A fractional tool number is rounded.
    fn tool_number(&self, value: f64, state: &State) -> Option<i32> {
        if state.has_quirk(quirk::rs274::TOOL_NUMBER_ROUNDED) {
            return whole(value.round_ties_even());
        }
        Documented.tool_number(value, state)
    }
}

impl ToolTableRules for Observed {
    /// Quirk rs274.tool-entry-under-compensation. G10 can change the tool table while the cutter is compensated.
    fn check_entry_under_compensation(&self, state: &State) -> Result<(), StepError> {
        if state.has_quirk(quirk::rs274::TOOL_ENTRY_UNDER_COMPENSATION) {
            return Ok(());
        }
        Documented.check_entry_under_compensation(state)
    }
}
