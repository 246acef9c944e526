//! Quirks of overrides.

use gaugeblock_vocabulary::{FaultKind, Switch};

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::overrides::OverrideRules;
use crate::rs274::modes::Modes;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl OverrideRules for Observed {
    /// Quirk rs274.override-dollar. M48 and M49 do not use $; another code of the block can.
    fn spindle_word(&self, words: &Words, state: &State) -> Option<f64> {
        let overrides_both = words.m.iter().any(|code| [48, 49].contains(code));
        if overrides_both && state.has_quirk(quirk::rs274::OVERRIDE_DOLLAR) {
            return None;
        }
        Documented.spindle_word(words, state)
    }

    /// Quirk rs274.speed-override-dollar. M51 refuses $0, and each $ between -1 and 1.
    fn overridden_spindle(&self, value: f64, state: &mut State) -> Result<usize, StepError> {
        let rule = quirk::rs274::SPEED_OVERRIDE_DOLLAR;
        if value.trunc() == 0.0 && state.has_quirk(rule) {
            return Err(refuse(rule, FaultKind::SpindleOutOfRange, "M51 with $0"));
        }
        Documented.overridden_spindle(value, state)
    }

    /// Quirk linuxcnc.rapid-override-disabled. What disables the feed override disables the rapid override, too.
    /// Quirk linuxcnc.tool-change-move. The rapid override does not count for the moves of a tool change.
    fn rapid_override_counts(&self, state: &State) -> bool {
        let disabled = state.modes.feed_override == Switch::Off
            && state.has_quirk(quirk::linuxcnc::RAPID_OVERRIDE_DISABLED);
        let changes_tool =
            state.memory.moves_to_change && state.has_quirk(quirk::linuxcnc::TOOL_CHANGE_MOVE);
        !disabled && !changes_tool && Documented.rapid_override_counts(state)
    }

    /// Quirk rs274.thread-feed-override. The control of the machine and the flag of the interpreter are the same again.
    fn feed_override_is_set(&self, state: &mut State) {
        if state.modes.memory.get().override_flag.is_some() {
            state.modes.memory.get_mut().override_flag = None;
        }
    }

    /// Quirk rs274.override-any-p. Each P other than zero enables the override.
    fn switch(&self, value: f64, state: &State) -> Result<Switch, StepError> {
        if state.has_quirk(quirk::rs274::OVERRIDE_ANY_P) {
            return Ok(if value == 0.0 { Switch::Off } else { Switch::On });
        }
        Documented.switch(value, state)
    }
}

/// Quirk rs274.thread-feed-override. Whether the interpreter takes the feed override to be enabled.
pub(super) fn override_flag(modes: &Modes) -> Switch {
    modes.memory.get().override_flag.unwrap_or(modes.feed_override)
}
