//! The JSON schemas of the vocabulary, generated from its types.
//!
//! They are published as `schema/scenario.json` and `schema/outcome.json`, for authors of adapters in other
//! languages; a test compares these files with the types.

use alloc::borrow::{Cow, ToOwned as _};
use alloc::format;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema, schema_for};
use serde_json::{Map, Value, json};

use crate::json::number::NOT_FINITE;
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
    let mut schema = identified::<crate::Outcome>("outcome");
    admit_not_finite(&mut schema, &[]);
    schema
}

/// Changes the numbers of a schema to those of an outcome, which need not be finite, except in these definitions.
pub fn admit_not_finite(schema: &mut Schema, except: &[&str]) {
    const DEFINITIONS: &str = "$defs";
    let schema = schema.ensure_object();
    let mut definitions = match schema.remove(DEFINITIONS) {
        Some(Value::Object(definitions)) => definitions,
        _ => Map::new(),
    };
    schema.values_mut().for_each(admit_in);
    let admitted = definitions.iter_mut().filter(|(name, _)| !except.contains(&name.as_str()));
    admitted.for_each(|(_, definition)| admit_in(definition));
    let number = json!({
        "description": "A number. A controller may report one that is not finite: JSON writes that as a text.",
        "anyOf": [{ "type": "number" }, { "enum": NOT_FINITE }],
    });
    definitions.insert("Number".to_owned(), number);
    schema.insert(DEFINITIONS.to_owned(), Value::Object(definitions));
}

fn admit_in(value: &mut Value) {
    match value {
        Value::Object(members) => {
            if members.get("format").is_some_and(|format| format == "double") {
                let number = json!({ "$ref": "#/$defs/Number" });
                members.remove("format");
                match members.remove("type") {
                    Some(Value::Array(_)) => {
                        members.insert("anyOf".to_owned(), json!([number, { "type": "null" }]));
                    }
                    _ => members.extend([("$ref".to_owned(), number["$ref"].clone())]),
                }
            }
            members.values_mut().for_each(admit_in);
        }
        Value::Array(values) => values.iter_mut().for_each(admit_in),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
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
