//! What was observed of controllers: LinuxCNC, its stand-alone interpreter `rs274` and the whole controller, Grbl, and
//! NIST's interpreter.
//!
//! Each section states what was observed, not what is right; the page of the same id in `suite/quirks` has the program
//! that makes the difference observable.

mod arcs;
mod codes;
mod compensation;
mod control;
mod cycles;
mod dwell;
mod evaluation;
mod feed;
mod inputs_outputs;
mod memory;
mod messages;
mod modal_memory;
mod modes;
mod motion;
mod offsets;
mod order;
mod orient;
mod overrides;
mod parameters;
mod passed_over;
mod path;
mod positions;
mod probe;
mod program_end;
mod restore;
mod saved_state;
mod skipping;
mod spindle;
mod splines;
mod task;
mod text;
mod threading;
mod tool_length;
mod tools;
mod turning;
mod units_planes;
mod values;
mod words;

pub(crate) use memory::{ControlMemory, Memory, SourceMemory};
pub(crate) use modal_memory::ModalMemory;

use crate::Choices;
use crate::dialects::Quirk;
use crate::rs274::dialect::Dialect;
use crate::rs274::state::State;

/// A controller with the quirks that the options of the run select.
#[derive(Debug)]
pub(super) struct Observed;

impl Dialect for Observed {}

/// Whether the options of a run select a quirk.
trait HasQuirk {
    /// Whether this quirk is selected.
    fn has_quirk(&self, quirk: Quirk) -> bool;
}

impl HasQuirk for Choices {
    fn has_quirk(&self, quirk: Quirk) -> bool {
        self.consult(quirk.into());
        self.deviations.has(quirk)
    }
}

impl HasQuirk for State {
    fn has_quirk(&self, quirk: Quirk) -> bool {
        self.choices.has_quirk(quirk)
    }
}
