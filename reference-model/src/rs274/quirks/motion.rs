//! Quirks of moves, arcs, rotated systems and the tool table.

use crate::ids::quirk;
use crate::rs274::state::State;

/// Quirk rs274.tool-entry-under-compensation. The tool table can be changed while the cutter is compensated.
pub(crate) fn table_under_compensation(state: &State) -> bool {
    state.choices.quirk(quirk::rs274::TOOL_ENTRY_UNDER_COMPENSATION)
}
