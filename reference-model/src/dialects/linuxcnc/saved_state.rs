//! Quirks of M72 in its block.

use gaugeblock_vocabulary::{FeedMode, Position};

use super::{LinuxCnc, Shows};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::restore::same;
use crate::rs274::execute::saved_state::SavedStateRules;
use crate::rs274::modes::Modes;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl SavedStateRules for LinuxCnc {
    /// Quirk rs274.rest-of-restore-block. A restore that changes something, or programs something again, drops the
    /// rest of its block.
    fn restore_in_block(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        if !state.shows(quirk::rs274::REST_OF_RESTORE_BLOCK) {
            return Documented.restore_in_block(saved, state);
        }
        let mut before = state.modes.clone();
        Documented.restore_in_block(saved, state)?;
        // Of a tool offset its unit is nothing that changes, nor whether one of zero is on.
        before.memory.get_mut().tool_offset_unit = state.modes.memory.get().tool_offset_unit;
        before.tool_length = state.modes.tool_length;
        state.memory.drops_rest = state.modes != before || programs(saved, &before);
        Ok(())
    }
}

/// Quirk rs274.rest-of-restore-block. Whether something is programmed again that can leave all as it was: a tool
/// offset where none is known, a feed or speed that is rounded to the one in force, overrides.
fn programs(saved: &Modes, now: &Modes) -> bool {
    let is_on = |modes: &Modes| modes.tool_offset != Position::default();
    let feed_number = |modes: &Modes| modes.memory.get().feed_number;
    let timed = saved.feed_mode == FeedMode::InverseTime;
    is_on(saved) != is_on(now)
        || !timed && !same(feed_number(saved), feed_number(now))
        || !same(saved.spindles[0].speed, now.spindles[0].speed)
        || saved.feed_override != now.feed_override
}
