//! Quirks of tool length compensation.

use gaugeblock_vocabulary::{FaultKind, Position, Switch};

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::tool_length::ToolLengthRules;
use crate::rs274::execute::word;
use crate::rs274::modes::converted;
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl ToolLengthRules for Observed {
    /// Quirk rs274.tool-offset-unit. The previous offset is removed as the number that was programmed.
    fn programmed_tool_offset(
        &self,
        words: &Words,
        state: &mut State,
    ) -> Result<Option<Position>, StepError> {
        if state.has_quirk(quirk::rs274::TOOL_OFFSET_UNIT) {
            tool_offset_as_programmed(state);
        }
        Documented.programmed_tool_offset(words, state)
    }

    /// Quirk rs274.additional-length-axes. G43.2 needs H, and takes no axis words.
    fn additional_tool_offset(
        &self,
        words: &Words,
        state: &mut State,
    ) -> Result<Position, StepError> {
        let rule = quirk::rs274::ADDITIONAL_LENGTH_AXES;
        if word(words, 'h').is_none() && has_axis_words(words) && state.has_quirk(rule) {
            return Err(refuse(rule, FaultKind::MissingWord, "G43.2 without H"));
        }
        Documented.additional_tool_offset(words, state)
    }

    /// Quirk rs274.tool-offset-unit. Records the length unit in which the offset was programmed.
    /// Quirk nist.zero-length-off. G43 with an offset of zero is reported as G49.
    fn apply_tool_offset(&self, offset: Option<Position>, state: &mut State) {
        Documented.apply_tool_offset(offset, state);
        let is_zero = state.modes.tool_offset == Position::default();
        if is_zero && state.has_quirk(quirk::nist::ZERO_LENGTH_OFF) {
            state.modes.tool_length = Switch::Off;
        }
        let modes = &mut state.modes;
        modes.memory.get_mut().tool_offset_unit = modes.units;
    }
}

/// Quirk rs274.tool-offset-unit. A change of the length unit does not convert the number of the tool offset. A later
/// change of the offset subtracts that number from the position.
pub(super) fn tool_offset_as_programmed(state: &mut State) {
    let modes = &mut state.modes;
    let unit = &mut modes.memory.get_mut().tool_offset_unit;
    modes.tool_offset = converted(modes.tool_offset, modes.units, *unit);
    *unit = modes.units;
}
