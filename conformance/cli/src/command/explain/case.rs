//! A case in full: its program, its files, what else its run depends on, and what must be observed.

use std::fmt::Write as _;

use gaugeblock_suite::{Case, Choice, MotionCase, MotionChoice, Setup};
use gaugeblock_vocabulary::Language;
use serde::Serialize;
use serde_json::{Map, Value, json};

/// What the assertions of a case do not say themselves; printed once below all cases.
pub(super) const ASSERTIONS: &str = "
  in assertions: `after 4` is the state after the block of line 4, `after 4@2` after its second execution;
  `()` is a position or offset with all axes at zero\n";

/// The program, with its lines numbered as blocks are, and the files that it calls.
fn program_text(text: &mut String, language: Language, main: &str, setup: &Setup) {
    lines(text, language, main);
    for (name, file) in &setup.files {
        let _infallible = writeln!(text, "    file {name}");
        lines(text, language, file);
    }
    settings_text(text, &setup_settings(setup));
}

fn lines(text: &mut String, language: Language, program: &str) {
    for (at, line) in language.lines(program).enumerate() {
        let _infallible = writeln!(text, "    {:>4} | {line}", at + 1);
    }
}

fn assertions_text(text: &mut String, assertions: &[String]) {
    for assertion in assertions {
        let _infallible = writeln!(text, "    assert {assertion}");
    }
}

/// Settings as TOML, as the pages of the suite write them: one line for each event or field.
fn settings_text(text: &mut String, settings: &Map<String, Value>) {
    for (name, value) in settings {
        match value {
            Value::Object(fields) => {
                for (field, value) in fields {
                    let _infallible = writeln!(text, "    {name}.{field} = {}", toml(value));
                }
            }
            Value::Array(elements) => {
                for element in elements {
                    let _infallible = writeln!(text, "    {name}: {}", toml(element));
                }
            }
            Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {
                let _infallible = writeln!(text, "    {name} = {}", toml(value));
            }
        }
    }
}

fn toml(value: &Value) -> String {
    toml::Value::try_from(value).map_or_else(|_| value.to_string(), |value| value.to_string())
}

fn title(text: &mut String, kind: &str, name: &str, why: &str, editions: &[String]) {
    let _infallible = writeln!(text, "\n  {kind} \"{name}\"");
    if !why.is_empty() {
        let _infallible = writeln!(text, "    {why}");
    }
    if !editions.is_empty() {
        let _infallible = writeln!(text, "    only in the editions {}", editions.join(", "));
    }
}

pub(super) fn case_text(text: &mut String, language: Language, case: &Case) {
    title(text, "case", &case.name, &case.why, &case.editions);
    program_text(text, language, &case.program, &case.setup);
    assertions_text(text, &case.assertions);
}

pub(super) fn motion_text(text: &mut String, case: &MotionCase) {
    title(text, "motion case", &case.name, &case.why, &[]);
    lines(text, Language::Rs274, &case.program);
    settings_text(text, &motion_settings(case));
    assertions_text(text, &case.assertions);
}

/// The program of a choice, and what is observed of it under each option.
pub(super) fn choice_case_text(text: &mut String, choice: &Choice) {
    text.push_str("\n  a program whose outcome depends on the option\n");
    if !choice.under.is_empty() {
        let under = choice.under.iter().map(|(id, option)| format!("{id} = {option}"));
        let under: Vec<_> = under.collect();
        let _infallible = writeln!(text, "    only under {}", under.join(", "));
    }
    program_text(text, choice.language, &choice.program, &choice.setup);
    for option in &choice.options {
        let _infallible = writeln!(text, "    under {}", option.name);
        assertions_text(text, &option.assertions);
    }
}

/// The samples of a choice of motion, and what the motion rules decide about them under each option.
pub(super) fn motion_choice_case_text(text: &mut String, choice: &MotionChoice) {
    motion_text(text, &choice.motion);
    for option in &choice.options {
        let _infallible = writeln!(text, "    under {}", option.name);
        assertions_text(text, &option.assertions);
    }
}

pub(super) fn case_document(case: &Case) -> Value {
    let mut document = json!({
        "name": case.name, "program": case.program, "assert": case.assertions,
        "files": case.setup.files,
    });
    let more = [("why", json!(case.why)), ("editions", json!(case.editions))];
    extend(&mut document, more.into_iter().filter(|(_, value)| !is_empty(value)));
    extend(&mut document, setup_settings(&case.setup));
    document
}

pub(super) fn motion_document(case: &MotionCase) -> Value {
    let mut document =
        json!({ "name": case.name, "program": case.program, "assert": case.assertions });
    let why = [("why", json!(case.why))];
    extend(&mut document, why.into_iter().filter(|(_, value)| !is_empty(value)));
    extend(&mut document, motion_settings(case));
    document
}

pub(super) fn choice_case_document(choice: &Choice) -> Value {
    let mut document = json!({
        "program": choice.program, "files": choice.setup.files, "under": choice.under,
    });
    extend(&mut document, setup_settings(&choice.setup));
    document
}

fn extend(document: &mut Value, more: impl IntoIterator<Item = (impl Into<String>, Value)>) {
    if let Value::Object(members) = document {
        members.extend(more.into_iter().map(|(name, value)| (name.into(), value)));
    }
}

/// What a run depends on except its texts, where it differs from a page that says nothing.
fn setup_settings(setup: &Setup) -> Map<String, Value> {
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

/// What a case of motion depends on except its program.
fn motion_settings(case: &MotionCase) -> Map<String, Value> {
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
