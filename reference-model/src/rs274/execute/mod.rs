//! What each phase of a block does.

pub(crate) mod arc;
pub mod compensation;
pub mod coolant;
pub mod cycles;
pub mod dwell;
pub mod feed;
pub mod inputs;
pub(crate) mod local_offset;
pub mod message;
pub mod motion;
pub(crate) mod move_start;
mod offset_storage;
pub mod offsets;
pub mod orient;
pub mod outputs;
pub mod overrides;
pub mod path;
pub(crate) mod plane_axes;
pub(crate) mod positions;
pub mod probe;
pub mod program_end;
pub(crate) mod programmed_motion;
pub(crate) mod restore;
pub mod saved_state;
pub mod spindle;
pub mod splines;
pub mod stop;
mod straight;
pub(crate) mod target;
pub(crate) mod threading;
mod time;
pub mod tool;
pub mod tool_change;
pub mod tool_length;
pub(crate) mod tool_table;
pub(crate) mod turning;
pub mod units_planes;
pub mod user_codes;
mod word;

pub(crate) use target::letter;
pub(crate) use time::{clear_orientation, pass};
pub(crate) use word::{whole, word};

use gaugeblock_vocabulary::{Compensation, FaultKind};

use super::refusal::{StepError, refuse};
use super::state::State;
use crate::ids::{Choice, Rule};

/// A code that a choice allows or refuses while cutter compensation is on: by this rule, under this option.
pub(crate) fn not_under_compensation<C: Choice>(
    rule: Rule,
    refused: C,
    state: &mut State,
) -> Result<(), StepError> {
    if state.modes.compensation == Compensation::Off {
        return Ok(());
    }
    if state.choices.is(refused) {
        let message = "this code while cutter compensation is on";
        return Err(refuse(rule, FaultKind::CompensationActive, message));
    }
    state.coverage.accepted(rule);
    Ok(())
}

/// The message about an input or output that the machine does not have; those that it has are counted from 0.
fn no_such(what: &str, value: f64, of_machine: u16) -> String {
    match of_machine.checked_sub(1) {
        Some(last) => format!("{what} {value} does not exist: the machine has {what}s 0 to {last}"),
        None => format!("{what} {value} does not exist: the machine has none"),
    }
}
