//! What a case depends on besides its program, as JSON: only what differs from the default.

use gaugeblock_suite::{MotionCase, Setup};
use serde::Serialize;
use serde_json::{Map, Value};

/// What a run depends on except its texts, where it differs from a page that says nothing.
pub fn setup_settings(setup: &Setup) -> Map<String, Value> {
    let none = Setup::default();
    let all = [
        ("start", changed(&setup.start, &none.start)),
        ("block_delete", changed(&setup.block_delete, &none.block_delete)),
        ("environment", changed(&setup.environment, &none.environment)),
        ("machine", changed(&setup.machine, &none.machine)),
        ("operator", changed(&setup.operator, &none.operator)),
        ("budget", changed(&setup.budget, &none.budget)),
    ];
    all.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?))).collect()
}

/// What a case of motion depends on except its program, where it differs from a page that says nothing.
pub fn motion_settings(case: &MotionCase) -> Map<String, Value> {
    let none: MotionSettings<'_> = MotionSettings::default();
    let own = MotionSettings {
        limits: case.limits.as_ref(),
        script: &case.script,
        pieces: &case.pieces,
        columns: (!case.columns.is_empty()).then_some(&case.columns),
        every: case.every,
        resolution: case.resolution,
        fault: case.fault.as_ref(),
    };
    match changed(&own, &none) {
        Some(Value::Object(settings)) => settings,
        _ => Map::new(),
    }
}

#[derive(Default, Serialize)]
struct MotionSettings<'a> {
    limits: Option<&'a gaugeblock_vocabulary::motion::MotionLimits>,
    script: &'a [gaugeblock_vocabulary::motion::MotionEvent],
    pieces: &'a [gaugeblock_suite::Piece],
    columns: Option<&'a std::collections::BTreeMap<String, Vec<(usize, f64)>>>,
    every: Option<f64>,
    resolution: f64,
    fault: Option<&'a gaugeblock_suite::SampleDefect>,
}

/// Settings as TOML, as the pages of the suite write them: one line for each event or field.
pub fn setting_lines(settings: &Map<String, Value>) -> Vec<String> {
    let lines = settings.iter().flat_map(|(name, value)| match value {
        Value::Object(fields) => {
            let line = |(field, value)| format!("{name}.{field} = {}", toml_text(value));
            fields.iter().map(line).collect::<Vec<_>>()
        }
        Value::Array(elements) => {
            elements.iter().map(|element| format!("{name}: {}", toml_text(element))).collect()
        }
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {
            vec![format!("{name} = {}", toml_text(value))]
        }
    });
    lines.collect()
}

fn toml_text(value: &Value) -> String {
    toml::Value::try_from(value).map_or_else(|_| value.to_string(), |value| value.to_string())
}

/// A value as JSON; of one with fields, those that differ from the default. None if nothing differs.
fn changed<T: Serialize>(value: &T, default: &T) -> Option<Value> {
    let value = serde_json::to_value(value).ok()?;
    let default = serde_json::to_value(default).ok()?;
    let differing = match (value, default) {
        (Value::Object(mut fields), Value::Object(defaults)) => {
            fields.retain(|name, value| defaults.get(name) != Some(value));
            Value::Object(fields)
        }
        (value, default) if value == default => return None,
        (value, _) => value,
    };
    let differing = without_empty(differing);
    (!is_empty(&differing)).then_some(differing)
}

/// The value without members that are null or empty.
fn without_empty(value: Value) -> Value {
    match value {
        Value::Object(fields) => {
            let fields = fields.into_iter().map(|(name, value)| (name, without_empty(value)));
            Value::Object(fields.filter(|(_, value)| !is_empty(value)).collect())
        }
        Value::Array(elements) => Value::Array(elements.into_iter().map(without_empty).collect()),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => value,
    }
}

fn is_empty(value: &Value) -> bool {
    match value {
        Value::Null => true,
        Value::Object(fields) => fields.is_empty(),
        Value::Array(elements) => elements.is_empty(),
        Value::String(text) => text.is_empty(),
        Value::Bool(_) | Value::Number(_) => false,
    }
}
