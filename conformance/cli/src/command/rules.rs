//! `gaugeblock rules`, `gaugeblock choices`: the catalogue of the suite.

use std::fmt::Write as _;

use clap::Args;
use gaugeblock_runner::suite_check;
use gaugeblock_suite::{Choice, ChoiceKind, Rule, Suite};
use serde_json::json;

use crate::arguments::Format;
use crate::error::CliError;
use crate::streams::write_out;

const EXAMPLES: &str = "Examples:
  gaugeblock rules                              every rule with its sentence
  gaugeblock rules saved-state                  the rules of a chapter
  gaugeblock rules saved-state --format json    the same with sources, cases and reached outcomes
  gaugeblock rules --profile rs274-core         the rules of a profile of `suite profiles`
  gaugeblock explain saved-state.feed           one rule with its sources and programs

Exit status: 0 printed; 2 wrong call or input.";

const CHOICES_EXAMPLES: &str = "Examples:
  gaugeblock choices                 every choice and quirk with its options
  gaugeblock choices saved-state     those of a chapter
  gaugeblock choices rs274.          the quirks of LinuxCNC's stand-alone interpreter

Exit status: 0 printed; 2 wrong call or input.";

/// Which ids are listed, and how.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// List only rules whose id begins with this, such as `saved-state`; may be repeated
    #[arg(value_name = "PREFIX")]
    prefix: Vec<String>,
    /// List only rules of this profile; may be repeated
    #[arg(long, value_name = "PROFILE")]
    profile: Vec<String>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Which ids are listed, and how.
#[derive(Debug, Args)]
#[command(after_help = CHOICES_EXAMPLES)]
pub(crate) struct ChoiceArguments {
    /// List only choices and quirks whose id begins with this; may be repeated
    #[arg(value_name = "PREFIX")]
    prefix: Vec<String>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Lists rules.
pub(crate) fn rules(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    super::certify::known_profiles(&arguments.profile, suite)?;
    let mut rules = selected(suite, &arguments.prefix);
    if rules.is_empty() {
        return Err(unknown_prefix("rule", &arguments.prefix, "rules"));
    }
    if let profiles @ [_, ..] = arguments.profile.as_slice() {
        rules.retain(|rule| profiles.iter().any(|profile| profile == suite.profile_of(rule)));
    }
    match arguments.format {
        Format::Text => list(suite, &rules),
        Format::Json => write_out(&format!("{:#}\n", document(suite, &rules))),
    }
    Ok(0)
}

/// Lists choices and quirks.
pub(crate) fn choices(arguments: &ChoiceArguments, suite: &Suite) -> Result<u8, CliError> {
    let choices: Vec<&Choice> =
        suite.choices.iter().filter(|choice| begins(&choice.id, &arguments.prefix)).collect();
    if choices.is_empty() {
        return Err(unknown_prefix("choice or quirk", &arguments.prefix, "choices"));
    }
    match arguments.format {
        Format::Text => list_choices(&choices),
        Format::Json => write_out(&format!("{:#}\n", choices_document(&choices))),
    }
    Ok(0)
}

/// The rules whose id begins with one of these; all of them where none is given.
pub(crate) fn selected<'a>(suite: &'a Suite, prefixes: &[String]) -> Vec<&'a Rule> {
    suite.rules.iter().filter(|rule| begins(&rule.id, prefixes)).collect()
}

fn begins(id: &str, prefixes: &[String]) -> bool {
    prefixes.is_empty() || prefixes.iter().any(|prefix| id.starts_with(prefix.as_str()))
}

fn unknown_prefix(what: &str, prefixes: &[String], command: &str) -> CliError {
    CliError::usage(
        format!("no {what} has an id that begins with `{}`", prefixes.join("` or `")),
        format!("`gaugeblock {command}` lists all ids"),
    )
}

fn list(suite: &Suite, rules: &[&Rule]) {
    let mut text = String::new();
    for rule in rules {
        let cases = rule.case_names().count();
        let _infallible = writeln!(text, "{:<40} {cases:>3} cases  {}", rule.id, rule.sentence);
    }
    let cases: usize = rules.iter().map(|rule| rule.case_names().count()).sum();
    let (choices, quirks): (Vec<_>, Vec<_>) =
        suite.choices.iter().partition(|choice| choice.kind == ChoiceKind::Choice);
    let _infallible = writeln!(
        text,
        "\n{} rules, {cases} cases; {} choices, {} quirks, {} editions",
        rules.len(),
        choices.len(),
        quirks.len(),
        suite.editions.len()
    );
    write_out(&text);
}

fn document(suite: &Suite, rules: &[&Rule]) -> serde_json::Value {
    let rules: Vec<_> = rules
        .iter()
        .map(|rule| {
            let cases: Vec<_> = rule.case_names().collect();
            json!({
                "rule": rule.id, "sentence": rule.sentence, "profile": suite.profile_of(rule),
                "sources": rule.sources, "outcomes": rule.outcomes,
                "reached": suite_check::reached(suite, rule), "options": rule.options,
                "void": rule.void, "cases": cases,
            })
        })
        .collect();
    json!({
        "gaugeblock": "rules", "schema": gaugeblock_vocabulary::schema::VERSION, "rules": rules,
    })
}

fn choices_document(choices: &[&Choice]) -> serde_json::Value {
    let choices: Vec<_> = choices
        .iter()
        .map(|choice| {
            let options: Vec<_> = choice
                .options
                .iter()
                .map(|option| json!({ "option": option.name, "means": option.means }))
                .collect();
            json!({
                "id": choice.id, "kind": choice.kind, "sentence": choice.sentence,
                "sources": choice.sources, "options": options,
            })
        })
        .collect();
    json!({ "gaugeblock": "choices", "choices": choices })
}

fn list_choices(choices: &[&Choice]) {
    let mut text = String::new();
    for choice in choices {
        let _infallible = writeln!(text, "{}  {}", choice.id, choice.sentence);
        for option in &choice.options {
            let _infallible = writeln!(text, "    {:<24} {}", option.name, option.means);
        }
    }
    write_out(&text);
}
