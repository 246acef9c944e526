//! What concerns a code, as text and as JSON.

use std::fmt::Write as _;

use gaugeblock_book::{Code, CodeChoice, Explanation};
use gaugeblock_suite::ChoiceKind;
use serde_json::json;

pub(super) fn text(about: &Explanation<'_>, code: &Code) -> String {
    let mut text = format!("{code}\n");
    if !about.documented.is_empty() {
        text.push_str("\nrules from the sections of this code:\n");
    }
    for (id, sentence) in &about.documented {
        let _infallible = writeln!(text, "  {id:<40} {sentence}");
    }
    let kinds = [
        (ChoiceKind::Choice, "choices: where documents differ or leave a question open"),
        (ChoiceKind::Quirk, "quirks: where a controller differs from its documents"),
    ];
    for (kind, title) in kinds {
        let is_listed = |choice: &&CodeChoice<'_>| choice.kind == kind && choice.is_documented;
        let of_kind: Vec<_> = about.choices.iter().filter(is_listed).collect();
        if !of_kind.is_empty() {
            let _infallible = writeln!(text, "\n{title}:");
        }
        for choice in of_kind {
            let _infallible = writeln!(text, "  {:<40} {}", choice.id, choice.sentence);
        }
    }
    let is_used_by = |kind: ChoiceKind| {
        let of_kind = about.choices.iter().filter(move |choice| choice.kind == kind);
        of_kind.filter(|choice| !choice.is_documented).map(|choice| choice.id)
    };
    let choices = is_used_by(ChoiceKind::Choice).collect();
    let quirks = is_used_by(ChoiceKind::Quirk).collect();
    for (one, many, ids) in [
        ("rule", "rules", &about.used),
        ("choice", "choices", &choices),
        ("quirk", "quirks", &quirks),
    ] {
        match ids.as_slice() {
            [] => {}
            [id] => {
                let _infallible =
                    writeln!(text, "\n1 {one} about something else uses it in a program: {id}");
            }
            ids => {
                let _infallible = writeln!(
                    text,
                    "\n{} {many} about something else use it in a program: {}",
                    ids.len(),
                    ids.join(", ")
                );
            }
        }
    }
    text.push_str("\n`gaugeblock explain ID` prints one of them in full.\n");
    text
}

pub(super) fn document(about: &Explanation<'_>, code: &Code) -> serde_json::Value {
    let rules: Vec<_> = about.documented.iter().map(|(id, _)| id).collect();
    let choices = about.choices.iter().map(|choice| {
        json!({ "id": choice.id, "kind": choice.kind, "documented": choice.is_documented })
    });
    json!({
        "gaugeblock": "explain", "code": code.to_string(), "rules": rules,
        "rules_that_use_it": about.used, "choices": choices.collect::<Vec<_>>(),
    })
}
