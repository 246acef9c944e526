//! The published schemas: they are what the types generate, and every value in JSON form fits them.

use std::env;
use std::fs;
use std::path::Path;

use gaugeblock_vocabulary::{Effect, schema};
use jsonschema::Validator;
use proptest::prelude::*;
use schemars::Schema;
use serde_json::{Value, json};

use crate::generate;

/// Compares a schema with its committed form, or writes that form where the environment says `GAUGEBLOCK_BLESS=1`.
#[track_caller]
fn is_current(name: &str, schema: &Schema) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("schema").join(name);
    let now = serde_json::to_string_pretty(schema).expect("a schema is JSON") + "\n";
    if env::var_os("GAUGEBLOCK_BLESS").is_some_and(|value| value == "1") {
        fs::write(&path, &now).expect("schema/ can be written");
    }
    let committed = fs::read_to_string(&path).unwrap_or_default();
    let first_difference = committed.lines().zip(now.lines()).position(|(old, new)| old != new);
    let line = first_difference.unwrap_or(committed.lines().count().min(now.lines().count())) + 1;
    assert!(
        committed == now,
        "schema/{name} differs from what the types generate, from line {line} on; if the change is meant, run \
         `GAUGEBLOCK_BLESS=1 cargo test -p gaugeblock-vocabulary schema` and read the difference",
    );
}

#[test]
fn scenario_schema_is_current() {
    is_current("scenario.json", &schema::scenario());
}

#[test]
fn outcome_schema_is_current() {
    is_current("outcome.json", &schema::outcome());
}

fn validator(schema: &Schema) -> Validator {
    jsonschema::validator_for(schema.as_value()).expect("a schema is generated right")
}

fn fits(validator: &Validator, value: &Value) -> Result<(), TestCaseError> {
    let wrong =
        |error: jsonschema::ValidationError<'_>| format!("{error} at {}", error.instance_path());
    validator.validate(value).map_err(|error| TestCaseError::fail(wrong(error)))
}

#[test]
fn any_scenario_fits() {
    let validator = validator(&schema::scenario());
    let check = |scenario| fits(&validator, &serde_json::to_value(&scenario).unwrap());
    proptest::test_runner::TestRunner::deterministic().run(&generate::scenario(), check).unwrap();
}

#[test]
fn any_outcome_fits() {
    let validator = validator(&schema::outcome());
    let check = |outcome| fits(&validator, &serde_json::to_value(&outcome).unwrap());
    proptest::test_runner::TestRunner::deterministic().run(&generate::outcome(), check).unwrap();
}

fn outcome_with(step: Value, end: Value) -> Value {
    json!({ "language": "rs274", "start": {}, "steps": [step], "end": end })
}

fn step_with(event: Value, state: Value) -> Value {
    json!({ "block": { "file": "main.ngc", "line": 1 }, "events": [event], "state": state })
}

/// A schema that lets everything through would fit every value too.
#[test]
fn what_the_types_refuse_does_not_fit() {
    let validator = validator(&schema::outcome());
    let (event, state) = (json!({ "set": {} }), json!({ "language": "rs274" }));
    let end = json!({ "end": "program_end" });
    assert!(
        validator.is_valid(&outcome_with(step_with(event.clone(), state.clone()), end.clone()))
    );
    let wrong = [
        (json!({ "set": { "colour": "red" } }), state.clone(), end.clone()),
        (json!({ "set": { "units": "furlong" } }), state.clone(), end.clone()),
        (json!({ "set": { "feed_rate": "fast" } }), state.clone(), end.clone()),
        (json!({ "do": { "effect": "fly" } }), state.clone(), end.clone()),
        (json!({ "do": { "effect": "straight_feed" } }), state.clone(), end.clone()),
        (json!({ "do": { "effect": "dwell", "seconds": 1, "x": 1 } }), state.clone(), end.clone()),
        (json!({ "do": { "effect": "prepare_tool", "tool": 1.5 } }), state.clone(), end.clone()),
        (event.clone(), json!({}), end.clone()),
        (event.clone(), json!({ "language": "rs274", "local": {} }), end.clone()),
        (event.clone(), json!({ "language": "rs274", "motion": "flying" }), end.clone()),
        (event.clone(), state.clone(), json!({ "end": "well" })),
        (
            event.clone(),
            state.clone(),
            json!({ "end": "fault", "kind": "bad_luck", "message": "" }),
        ),
        (event.clone(), state.clone(), json!({ "end": "fault", "message": "", "x": 1 })),
        (event, state, json!({ "end": "unsupported" })),
    ];
    for (event, state, end) in wrong {
        let outcome = outcome_with(step_with(event, state), end);
        assert!(!validator.is_valid(&outcome), "the schema lets this through: {outcome}");
        serde_json::from_value::<gaugeblock_vocabulary::Outcome>(outcome.clone())
            .expect_err(&format!("the types let this through: {outcome}"));
    }
}

/// Someone who writes an adapter in another language reads the schema alone.
#[test]
fn every_effect_is_described() {
    let schema = schema::outcome();
    let effects = schema.as_value()["$defs"]["Effect"]["oneOf"].as_array().unwrap().clone();
    assert_eq!(effects.len(), Effect::NAMES.len());
    for effect in effects {
        let described =
            |value: &Value| value["description"].as_str().is_some_and(|text| !text.is_empty());
        let name = &effect["properties"]["effect"]["const"];
        assert!(described(&effect), "{name} has no description");
        for (field, about) in effect["properties"].as_object().unwrap() {
            assert!(field == "effect" || described(about), "{field} of {name} has no description");
        }
    }
}
