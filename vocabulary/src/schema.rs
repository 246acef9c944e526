//! The JSON schemas of the vocabulary, generated from its types.
//!
//! They are published as `schema/scenario.json` and `schema/outcome.json`, for authors of adapters in other
//! languages; a test compares these files with the types.

use alloc::borrow::{Cow, ToOwned as _};
use alloc::format;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema, schema_for};

use crate::pin::Pin;
use crate::shared::Shared;

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

impl JsonSchema for Pin {
    fn schema_name() -> Cow<'static, str> {
        "Pin".into()
    }

    fn json_schema(_generator: &mut SchemaGenerator) -> Schema {
        let (indexed, single) = (Self::INDEXED_NAMES.join("|"), Self::SINGLE_NAMES.join("|"));
        json_schema!({
            "description": "A pin, such as `digital_out[0]` or `coolant_mist`; outputs and spindles are counted from 0.",
            "type": "string",
            "pattern": format!("^(({single})|({indexed})\\[(0|[1-9][0-9]{{0,4}})\\])$"),
        })
    }
}

impl<T: JsonSchema> JsonSchema for Shared<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn schema_id() -> Cow<'static, str> {
        T::schema_id()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}
