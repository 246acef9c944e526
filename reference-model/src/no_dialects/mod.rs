//! This build has no dialects: every controller does what the documents say.

mod deviations;
mod ids;
mod memory;

use crate::Choices;
use crate::rs274::dialect::{Dialect, Documented};
pub(crate) use deviations::{Deviations, accepts_options, unknown};
pub(crate) use ids::{ID_CHAPTERS, ID_COUNT};
pub(crate) use memory::{ControlMemory, Memory, ModalMemory, SourceMemory};

impl Choices {
    /// The dialect of this run.
    pub(crate) fn dialect(&self) -> &'static dyn Dialect {
        &Documented
    }
}
