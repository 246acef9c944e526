//! The JSON schemas of the vocabulary, generated from its types.

use schemars::{Schema, schema_for};

/// Version of the JSON forms; 0 until the adapter protocol is frozen.
pub const VERSION: u32 = 0;

/// The schema of a [`crate::Scenario`].
pub fn scenario() -> Schema {
    schema_for!(crate::Scenario)
}

/// The schema of an [`crate::Outcome`].
pub fn outcome() -> Schema {
    schema_for!(crate::Outcome)
}
