//! Quirks of M72 in its block.

use gaugeblock_vocabulary::{FeedMode, Position};

use super::overrides::override_flag;
use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::restore::same;
use crate::rs274::execute::saved_state::SavedStateRules;
use crate::rs274::modes::Modes;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl SavedStateRules for Observed {
    /// Quirk rs274.rest-of-restore-block. A restore that changes something, or programs something again, drops the
    /// rest of its block.
    fn restore_in_block(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        if !state.has_quirk(quirk::rs274::REST_OF_RESTORE_BLOCK) {
            return Documented.restore_in_block(saved, state);
        }
        let mut before = state.modes.clone();
        Documented.restore_in_block(saved, state)?;
        // The unit of the tool offset is not a change, nor is whether an offset of zero is on.
        before.memory.get_mut().tool_offset_unit = state.modes.memory.get().tool_offset_unit;
        before.tool_length = state.modes.tool_length;
        state.memory.drops_rest = state.modes != before || programs_again(saved, &before);
        Ok(())
    }
}

/// Quirk rs274.rest-of-restore-block. Whether a code is programmed again that may change nothing: a tool offset for
/// which no tool is known, a feed or speed that is rounded to the active one, overrides.
fn programs_again(saved: &Modes, now: &Modes) -> bool {
    let is_on = |modes: &Modes| modes.tool_offset != Position::default();
    let feed_number = |modes: &Modes| modes.memory.get().feed_number;
    let timed = saved.feed_mode == FeedMode::InverseTime;
    is_on(saved) != is_on(now)
        || !timed && !same(feed_number(saved), feed_number(now))
        || !same(saved.spindles[0].speed, now.spindles[0].speed)
        || override_flag(saved) != override_flag(now)
}
