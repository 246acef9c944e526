//! What real controllers do otherwise than their documents say: a layer that replaces operations of the main path.
//!
//! Nothing of the main path names a quirk, and it holds no state that only a quirk needs. A chapter whose rules a
//! controller is known to follow otherwise has a trait of these rules, such as
//! [`ArcRules`](crate::rs274::execute::arc::ArcRules); the default body of each method is what the documents say, and
//! [`Documented`] takes every default. A chapter calls such a rule through the dialect of its run:
//! `state.dialect().radius_tolerances(state)`.
//!
//! How a quirk replaces an operation:
//!
//! 1. The operation is a sentence of the documents. Where a quirk changes a step within a function of the main path,
//!    that step becomes a method of the chapter's trait, with its rule as its documentation.
//! 2. The method is overridden here: without the quirk it returns `Documented.radius_tolerances(state)`, with it what
//!    was observed. A quirk that refuses more than the documents refuses first, and then calls the documented rule.
//! 3. What only the quirk remembers is a field of the layer's `Memory`, or of its `ModalMemory` where M70 saves it with
//!    the modes. The main path carries both and cannot see into them.
//!
//! A documented rule calls further rules through the dialect of the run, never through `self`, so that a quirk which
//! calls a documented rule still has the other quirks in it. Without the feature `dialects` this layer is not there,
//! and the model still says what every document says.

mod deviations;
mod observed;
#[macro_use]
mod page;
pub mod quirk;

use crate::Choices;
use crate::rs274::dialect::{Dialect, Documented};
pub(crate) use deviations::{Deviations, accepts_options, unknown};
pub(crate) use observed::{ControlMemory, Memory, ModalMemory, SourceMemory};
pub use page::Quirk;
pub(crate) use quirk::{CHAPTERS as ID_CHAPTERS, COUNT as ID_COUNT};

impl Choices {
    /// The dialect of this run.
    pub(crate) fn dialect(&self) -> &'static dyn Dialect {
        // Without a quirk it follows the documents, and records what it consults.
        let has_dialect = self.deviations.any() || self.consulted.is_some();
        if has_dialect { &observed::Observed } else { &Documented }
    }
}
