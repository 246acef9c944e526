//! `gaugeblock explain`: one rule, choice or quirk in full, or a list of those that concern a code such as M73.

mod case;
mod code;

use std::fmt::Write as _;

use clap::Args;
use gaugeblock_book::{Code, Explanation};
use gaugeblock_suite::{Choice, ChoiceKind, MotionChoice, Rule, Source, Suite, sections};
use gaugeblock_vocabulary::{End, Program, Scenario};
use serde_json::{Value, json};

use crate::arguments::Format;
use crate::error::CliError;
use crate::streams::write_out;

const EXAMPLES: &str = "Examples:
  gaugeblock explain saved-state.feed                a rule: sentence, sources, programs, assertions
  gaugeblock explain saved-state.motion-mode         a rule, and the choice of the same id
  gaugeblock explain rs274.feed-zero-at-end          a quirk of a controller
  gaugeblock explain M73                             the rules, choices and quirks of a code

Exit status: 0 found; 2 unknown id or code, or one that is not
specified yet.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Id of a rule, a choice or a quirk, or a code such as M73 or G5.2
    #[arg(value_name = "ID|CODE")]
    subject: String,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn explain(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let Arguments { subject, format } = arguments;
    let rule = suite.rules.iter().find(|rule| rule.id == *subject);
    let choice = suite.choices.iter().find(|choice| choice.id == *subject);
    let motion = suite.motion_choices.iter().find(|choice| choice.id == *subject);
    let (text, document) = match Code::read(subject) {
        Some(code) => explain_code(&code, suite)?,
        None if rule.is_none() && choice.is_none() && motion.is_none() => {
            return Err(unknown(subject, suite));
        }
        None => {
            let (mut text, mut document) = (String::new(), json!({ "gaugeblock": "explain" }));
            if let Some(rule) = rule {
                text.push_str(&rule_text(rule, suite));
                document["rule"] = rule_document(rule, suite);
            }
            let shares_id = rule.is_some();
            if let Some(choice) = choice {
                text.push_str(&choice_text(choice, shares_id));
                document["choice"] = choice_document(choice);
            }
            if let Some(choice) = motion {
                text.push_str(&motion_choice_text(choice, shares_id));
                document["choice"] = motion_choice_document(choice);
            }
            (text, document)
        }
    };
    match format {
        Format::Text => write_out(&text),
        Format::Json => write_out(&format!("{document:#}\n")),
    }
    Ok(0)
}

/// What concerns a code, as text and as JSON.
fn explain_code(code: &Code, suite: &Suite) -> Result<(String, Value), CliError> {
    let about = Explanation::of(code, suite);
    if let (true, Some(what)) = (about.is_undocumented(), unsupported(code)) {
        return Err(CliError::usage(
            format!("{code} is not specified yet ({what}); a program with it ends as unsupported"),
            "`gaugeblock rules` lists what is specified",
        ));
    }
    if about.is_empty() {
        return Err(CliError::usage(
            format!("no document of any edition describes {code}, and no rule concerns it"),
            "`gaugeblock rules` lists all rules",
        ));
    }
    if about.is_undocumented() {
        return Err(CliError::usage(
            format!("no document of any edition describes {code}"),
            format!(
                "programs of the suite use it where they are about something else: {}",
                about.users()
            ),
        ));
    }
    let mut text = code::text(&about, code);
    if let Some(what) = unsupported(code) {
        let _infallible =
            writeln!(text, "\nnot specified yet: {what}; such a program ends as unsupported");
    }
    Ok((text, code::document(&about, code)))
}

/// What the specification leaves to later of a code that it knows.
fn unsupported(code: &Code) -> Option<String> {
    // Some codes are accepted, and what follows them is not; some require a word.
    let programs = ["CODE\nm2\n", "CODE\ng1 f1 x1\nm2\n", "CODE d1\ng1 f1 x1\nm2\n"];
    programs.iter().find_map(|program| {
        let main = program.replace("CODE", &code.to_string());
        let program = Program { main, ..Program::default() };
        let end = gaugeblock_reference::run(&Scenario { program, ..Scenario::default() }).0.end;
        let End::Unsupported { what, .. } = end else { return None };
        Some(what.split_once(": ").map_or(what.as_str(), |(_, what)| what).to_owned())
    })
}

/// An error that lists the ids that are nearest to an unknown one.
fn unknown(subject: &str, suite: &Suite) -> CliError {
    if suite.rules.iter().any(|rule| rule.chapter() == subject) {
        return CliError::usage(
            format!("`{subject}` is a chapter, not the id of one rule"),
            format!("`gaugeblock rules {subject}` lists its rules"),
        );
    }
    let rules = suite.rules.iter().map(|rule| rule.id.as_str());
    let choices = suite.choices.iter().map(|choice| choice.id.as_str());
    let of_motion = suite.motion_choices.iter().map(|choice| choice.id.as_str());
    let ids = rules.chain(choices).chain(of_motion);
    let mut near: Vec<(usize, &str)> = ids
        .filter_map(|id| {
            let distance = strsim::damerau_levenshtein(id, subject);
            (distance <= 4 || id.starts_with(subject)).then_some((distance, id))
        })
        .collect();
    near.sort_unstable();
    let near: Vec<&str> = near.into_iter().take(5).map(|(_, id)| id).collect();
    let hint = if near.is_empty() {
        "`gaugeblock rules` and `gaugeblock choices` list all ids".to_owned()
    } else {
        format!("did you mean `{}`?", near.join("`, `"))
    };
    CliError::usage(format!("unknown rule, choice, quirk or code `{subject}`"), hint)
}

fn rule_text(rule: &Rule, suite: &Suite) -> String {
    let mut text = format!("{}\n  {}\n", rule.id, rule.sentence);
    text.push_str(&sources_text(&rule.sources));
    let _infallible = writeln!(text, "  profile {}", suite.profile_of(rule));
    let (own, others): (Vec<_>, Vec<_>) = rule.options.iter().partition(|id| **id == rule.id);
    if !others.is_empty() {
        let others: Vec<_> = others.into_iter().map(String::as_str).collect();
        let _infallible = writeln!(text, "  depends on {}", others.join(", "));
    }
    if !own.is_empty() {
        text.push_str("  depends on the choice of the same id, which is printed below\n");
    }
    for (edition, why) in &rule.void {
        let _infallible = writeln!(text, "  not in the edition {edition}: {why}");
    }
    for case in &rule.cases {
        case::case_text(&mut text, rule.language, case);
    }
    for case in &rule.motion {
        case::motion_text(&mut text, case);
    }
    if !rule.cases.is_empty() {
        text.push_str(case::ASSERTIONS);
    }
    text.push_str(&calls_text(rule, suite));
    text
}

/// How to run the cases of a rule. `--only` takes the beginning of ids, so that it may select further rules.
fn calls_text(rule: &Rule, suite: &Suite) -> String {
    let id = &rule.id;
    let further = suite.rules.iter().filter(|other| other.id != *id && other.id.starts_with(id));
    let mut text =
        format!("\n  run its cases: gaugeblock certify --only {id} --controller CONTROLLER\n");
    match further.count() {
        0 => {}
        1 => text.push_str("    (this also runs another rule whose id begins with it)\n"),
        count => {
            let _infallible =
                writeln!(text, "    (this also runs {count} other rules whose ids begin with it)");
        }
    }
    if let Some(name) = rule.case_names().next() {
        let _infallible = writeln!(
            text,
            "  run one case: gaugeblock certify --only {id} --case \"{name}\" --controller CONTROLLER"
        );
    }
    text.push('\n');
    text
}

fn rule_document(rule: &Rule, suite: &Suite) -> Value {
    json!({
        "id": rule.id, "sentence": rule.sentence, "sources": rule.sources,
        "profile": suite.profile_of(rule), "outcomes": rule.outcomes, "options": rule.options, "void": rule.void,
        "cases": rule.cases.iter().map(case::case_document).collect::<Vec<_>>(),
        "motion": rule.motion.iter().map(case::motion_document).collect::<Vec<_>>(),
    })
}

/// The first line of a choice or quirk. Many rules and choices have one id: the rule says what holds, the choice lists
/// how documents can be read.
fn choice_title(id: &str, kind: &str, shares_id: bool) -> String {
    let same = if shares_id { "; the rule of the same id depends on it" } else { "" };
    format!("{id} ({kind}{same})\n")
}

fn choice_text(choice: &Choice, shares_id: bool) -> String {
    let kind = match choice.kind {
        ChoiceKind::Choice => "choice",
        ChoiceKind::Quirk => "quirk",
    };
    let mut text = choice_title(&choice.id, kind, shares_id);
    let _infallible = writeln!(text, "  {}", choice.sentence);
    text.push_str(&sources_text(&choice.sources));
    for option in &choice.options {
        let _infallible = writeln!(text, "  {:<24} {}", option.name, option.means);
    }
    case::choice_case_text(&mut text, choice);
    text.push_str(case::ASSERTIONS);
    let _infallible = writeln!(
        text,
        "\n  set it: gaugeblock run FILE --option {}={}\n",
        choice.id,
        choice.options.last().map_or("OPTION", |option| option.name.as_str())
    );
    text
}

fn choice_document(choice: &Choice) -> Value {
    let options = choice.options.iter().map(|option| {
        json!({ "option": option.name, "means": option.means, "assert": option.assertions })
    });
    json!({
        "id": choice.id, "kind": choice.kind, "sentence": choice.sentence,
        "sources": choice.sources, "options": options.collect::<Vec<_>>(),
        "case": case::choice_case_document(choice),
    })
}

fn motion_choice_text(choice: &MotionChoice, shares_id: bool) -> String {
    let mut text = choice_title(&choice.id, "choice of motion", shares_id);
    let _infallible = writeln!(text, "  {}", choice.sentence);
    text.push_str(&sources_text(&choice.sources));
    for option in &choice.options {
        let _infallible = writeln!(text, "  {:<24} {}", option.name, option.means);
    }
    case::motion_choice_case_text(&mut text, choice);
    text.push('\n');
    text
}

fn motion_choice_document(choice: &MotionChoice) -> Value {
    let options = choice.options.iter().map(|option| {
        json!({ "option": option.name, "means": option.means, "assert": option.assertions })
    });
    json!({
        "id": choice.id, "kind": "choice", "sentence": choice.sentence,
        "sources": choice.sources, "options": options.collect::<Vec<_>>(),
        "motion": case::motion_document(&choice.motion),
    })
}

fn sources_text(sources: &[Source]) -> String {
    sections(sources).into_iter().map(|section| format!("  {section}\n")).collect()
}
