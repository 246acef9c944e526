//! A case in full: its program, its files, what else its run depends on, and what must be observed.

use std::fmt::Write as _;

use gaugeblock_book::{motion_settings, setting_lines, setup_settings};
use gaugeblock_suite::{Case, Choice, MotionCase, MotionChoice, Setup};
use gaugeblock_vocabulary::Language;
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

fn settings_text(text: &mut String, settings: &Map<String, Value>) {
    for line in setting_lines(settings) {
        let _infallible = writeln!(text, "    {line}");
    }
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
    extend(&mut document, more.into_iter().filter(|(_, value)| !is_blank(value)));
    extend(&mut document, setup_settings(&case.setup));
    document
}

pub(super) fn motion_document(case: &MotionCase) -> Value {
    let mut document =
        json!({ "name": case.name, "program": case.program, "assert": case.assertions });
    let why = [("why", json!(case.why))];
    extend(&mut document, why.into_iter().filter(|(_, value)| !is_blank(value)));
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

/// Whether a text or a list is empty.
fn is_blank(value: &Value) -> bool {
    value.as_str().is_some_and(str::is_empty) || value.as_array().is_some_and(Vec::is_empty)
}
