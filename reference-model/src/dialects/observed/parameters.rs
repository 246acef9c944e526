//! Quirks of parameters.

use gaugeblock_vocabulary::{Compensation, FeedMode, Switch};

use super::overrides::override_flag;
use super::{HasQuirk, Observed};
use crate::Choices;
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::parameters::ParameterRules;
use crate::rs274::state::State;

impl ParameterRules for Observed {
    /// Quirk rs274.feed-name-number: `_feed` is F as it was programmed, whatever the length unit was.
    /// Quirk rs274.feed-name-inverse-time: under inverse time it is the feed rate of the last move.
    fn feed_parameter(&self, state: &State) -> f64 {
        let by_number = state.has_quirk(if state.modes.feed_mode == FeedMode::InverseTime {
            quirk::rs274::FEED_NAME_INVERSE_TIME
        } else {
            quirk::rs274::FEED_NAME_NUMBER
        });
        if by_number {
            return state.modes.memory.get().feed_number;
        }
        Documented.feed_parameter(state)
    }

    /// Quirk rs274.last-parameter. The greatest number of a parameter is 5601.
    fn last_parameter(&self, choices: &Choices) -> u32 {
        if choices.has_quirk(quirk::rs274::LAST_PARAMETER) {
            return 5601;
        }
        Documented.last_parameter(choices)
    }

    /// Quirk rs274.thread-feed-override. It is the flag of the interpreter, whatever a thread has done to the machine.
    fn feed_override_parameter(&self, state: &State) -> Switch {
        override_flag(&state.modes)
    }

    /// Quirk rs274.hal-assignment. A parameter whose name has the form of a HAL item or an INI entry can be assigned if
    /// the item or entry does not exist.
    fn may_assign_outside(&self, _name: &str, state: &State) -> bool {
        state.has_quirk(quirk::rs274::HAL_ASSIGNMENT)
    }

    /// Quirk rs274.dynamic-compensation-code. `_ccomp` is the same for G41.1 and G42.1 as for G41 and G42.
    fn compensation_parameter(&self, state: &State) -> f64 {
        if !state.has_quirk(quirk::rs274::DYNAMIC_COMPENSATION_CODE) {
            return Documented.compensation_parameter(state);
        }
        match state.modes.compensation {
            Compensation::Off => 400.0,
            Compensation::Left | Compensation::DynamicLeft => 410.0,
            Compensation::Right | Compensation::DynamicRight => 420.0,
        }
    }

    /// Quirk rs274.zero-tool-offset-off. `_tool_offset` is 1 while an offset is not zero.
    fn tool_offset_parameter(&self, state: &State) -> f64 {
        if !state.has_quirk(quirk::rs274::ZERO_TOOL_OFFSET_OFF) {
            return Documented.tool_offset_parameter(state);
        }
        let has_offset = state.modes.tool_offset.to_array().iter().any(|offset| offset.abs() > 0.0);
        if has_offset { 1.0 } else { 0.0 }
    }

    /// Quirk rs274.selected-tool-zero. `_selected_tool` is 0 before the first T.
    fn selected_tool_parameter(&self, state: &State) -> f64 {
        if state.has_quirk(quirk::rs274::SELECTED_TOOL_ZERO) {
            return f64::from(state.selected_tool.max(0));
        }
        Documented.selected_tool_parameter(state)
    }
}
