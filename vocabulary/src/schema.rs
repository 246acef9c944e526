//! The JSON schemas of the vocabulary, generated from its types.
//!
//! They are published as `schema/scenario.json` and `schema/outcome.json`, for whoever writes an adapter in another
//! language; a test holds these files to the types.

use schemars::{JsonSchema, Schema, schema_for};

/// Version of the JSON forms; 0 until the adapter protocol is frozen.
pub const VERSION: u32 = 0;

/// The schema of a [`crate::Scenario`].
pub fn scenario() -> Schema {
    identified::<crate::Scenario>("scenario")
}

/// The schema of an [`crate::Outcome`].
pub fn outcome() -> Schema {
    identified::<crate::Outcome>("outcome")
}

fn identified<T: JsonSchema>(name: &str) -> Schema {
    let mut schema = schema_for!(T);
    schema.insert("$id".to_owned(), format!("urn:gaugeblock:{name}:{VERSION}").into());
    schema
}
