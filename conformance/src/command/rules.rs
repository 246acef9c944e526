//! `gaugeblock rules`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use gaugeblock_suite::ledger::{self, Ledger};
use gaugeblock_suite::{ChoiceKind, Rule, Suite, files};
use serde_json::json;
use toml_edit::{DocumentMut, Item};

use super::matrix::matrix;
use super::{Format, Refused, place, read_suite, write_out};
use crate::catalogue;

const EXAMPLES: &str = "Examples:
  gaugeblock rules                              every rule with its sentence
  gaugeblock rules saved-state --format json    a chapter, with sources, cases and reached outcomes
  gaugeblock rules --choices                    the register of choices and quirks
  gaugeblock rules --check                      whether the suite is what it must be
  gaugeblock rules --check --document linuxcnc-2.8=m-code.txt
      whether the sentence ledger is that of this document
  gaugeblock rules --matrix --judged out/report.json
      document by document, section by section: its sentences, rules, and what the model and a controller do
  gaugeblock rules --faults
      certify production with each planted fault: what catches it (a build with --features faulty)
  gaugeblock --suite conformance/suite rules --bless
      write what the model does as the cases' goldens, to be read before they are committed";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// Only rules whose id begins so
    #[arg(value_name = "PREFIX")]
    prefix: Vec<String>,
    /// List choices and quirks instead
    #[arg(long)]
    choices: bool,
    /// Check the suite: every outcome reached, every golden current, every sentence classified
    #[arg(long)]
    check: bool,
    /// A document to check its ledger against
    #[arg(long, value_name = "ID=FILE", requires = "check")]
    document: Vec<String>,
    /// Document by document and section by section: sentences, rules, and verdicts with what they rest on
    #[arg(long, conflicts_with_all = ["check", "choices"])]
    matrix: bool,
    /// The report of a controller that becomes a column of the matrix; may be repeated
    #[arg(long, value_name = "REPORT.json", requires = "matrix")]
    judged: Vec<PathBuf>,
    /// Write goldens into the pages of --suite
    #[arg(long, conflicts_with_all = ["check", "choices", "matrix"])]
    bless: bool,
    /// Which planted faults of the production interpreter the suite catches (in a build with `--features faulty`)
    #[arg(long, conflicts_with_all = ["check", "choices", "matrix", "bless"])]
    faults: bool,
    /// What to print
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(super) fn rules(arguments: &Arguments, folder: Option<&Path>) -> Result<u8, Refused> {
    let suite = read_suite(folder)?;
    if arguments.bless {
        let folder = folder.ok_or_else(|| {
            Refused::wrong(
                "--bless writes into pages",
                "name their folder: --suite conformance/suite",
            )
        })?;
        return bless(&suite, folder, arguments);
    }
    if arguments.check {
        return check(&suite, folder, &arguments.document);
    }
    if arguments.matrix {
        let (ledgers, faults) = ledgers(&suite, folder)?;
        if let Some(fault) = faults.into_iter().next() {
            return Err(Refused::wrong(fault, "`gaugeblock rules --check` lists all"));
        }
        return matrix(&suite, &ledgers, &arguments.judged, arguments.format);
    }
    if arguments.faults {
        return faults(&suite, arguments.format);
    }
    if arguments.choices {
        choices(&suite, arguments.format);
        return Ok(0);
    }
    let rules = selected(&suite, arguments);
    if rules.is_empty() {
        return Err(Refused::wrong("no rule begins so", "`gaugeblock rules` lists all"));
    }
    match arguments.format {
        Format::Text => list(&suite, &rules),
        Format::Json => write_out(&format!("{:#}\n", document(&suite, &rules))),
    }
    Ok(0)
}

#[cfg(feature = "faulty")]
fn faults(suite: &Suite, format: Format) -> Result<u8, Refused> {
    super::faults::faults(suite, "linuxcnc-2.9", format)
}

#[cfg(not(feature = "faulty"))]
fn faults(_suite: &Suite, _format: Format) -> Result<u8, Refused> {
    Err(Refused::wrong(
        "planted faults are not in this build",
        "build one that has them: cargo build --release --features faulty",
    ))
}

fn selected<'a>(suite: &'a Suite, arguments: &Arguments) -> Vec<&'a Rule> {
    let prefixes = &arguments.prefix;
    let wanted = |rule: &&Rule| {
        prefixes.is_empty() || prefixes.iter().any(|p| rule.id.starts_with(p.as_str()))
    };
    suite.rules.iter().filter(wanted).collect()
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
                "rule": rule.id, "sentence": rule.sentence, "profile": rule.profile, "sources": rule.sources,
                "outcomes": rule.outcomes, "reached": catalogue::reached(suite, rule), "options": rule.options,
                "void": rule.void, "cases": cases,
            })
        })
        .collect();
    json!({ "gaugeblock": "rules", "schema": gaugeblock_vocabulary::schema::VERSION, "rules": rules })
}

fn choices(suite: &Suite, format: Format) {
    if format == Format::Json {
        let choices: Vec<_> = suite
            .choices
            .iter()
            .map(|choice| {
                let options: Vec<_> =
                    choice.options.iter().map(|o| json!({ "option": o.name, "means": o.means })).collect();
                json!({
                    "id": choice.id, "kind": choice.kind, "sentence": choice.sentence, "sources": choice.sources,
                    "options": options,
                })
            })
            .collect();
        write_out(&format!("{:#}\n", json!({ "gaugeblock": "choices", "choices": choices })));
        return;
    }
    let mut text = String::new();
    for choice in &suite.choices {
        let _infallible = writeln!(text, "{}  {}", choice.id, choice.sentence);
        for option in &choice.options {
            let _infallible = writeln!(text, "    {:<24} {}", option.name, option.means);
        }
    }
    write_out(&text);
}

fn check(suite: &Suite, folder: Option<&Path>, documents: &[String]) -> Result<u8, Refused> {
    let mut faults = catalogue::faults(suite);
    let (ledgers, wrong) = ledgers(suite, folder)?;
    faults.extend(wrong);
    for named in documents {
        faults.extend(check_document(&ledgers, named)?);
    }
    let mut text = String::new();
    for fault in &faults {
        let _infallible = writeln!(text, "{fault}");
    }
    let cases: usize = suite.rules.iter().map(|rule| rule.case_names().count()).sum();
    let _infallible = writeln!(
        text,
        "{} rules, {cases} cases, {} documents: {}",
        suite.rules.len(),
        ledgers.len(),
        match faults.len() {
            0 => "as they must be".to_owned(),
            count => format!("{count} faults"),
        }
    );
    write_out(&text);
    Ok(u8::from(!faults.is_empty()))
}

/// The sentence ledgers, and what is wrong with those that are none, or that name pages that the suite does not have.
fn ledgers(suite: &Suite, folder: Option<&Path>) -> Result<(Vec<Ledger>, Vec<String>), Refused> {
    let files = match folder {
        Some(folder) => files::of_folder(folder).map_err(|error| {
            Refused::wrong(error, "--suite takes a folder like conformance/suite")
        })?,
        None => gaugeblock_embedded_suite::files().map_err(|error| {
            Refused::wrong(error, "--suite takes a folder like conformance/suite")
        })?,
    };
    let (mut ledgers, mut faults) = (Vec::new(), Vec::new());
    for (path, text) in files.iter().filter(|(path, _)| path.starts_with("documents/")) {
        match Ledger::parse(text) {
            Ok(ledger) => {
                let absent = ledger::absent(text, suite).into_iter();
                faults.extend(absent.map(|(line, fault)| format!("{path}:{line}: {fault}")));
                ledgers.push(ledger);
            }
            Err(error) => faults.push(format!("{path}: {error}")),
        }
    }
    Ok((ledgers, faults))
}

fn check_document(ledgers: &[Ledger], named: &str) -> Result<Vec<String>, Refused> {
    let (id, file) = named.split_once('=').ok_or_else(|| {
        Refused::wrong(format!("`{named}` is not ID=FILE"), "as in linuxcnc-2.8=m-code.txt")
    })?;
    let ledger = ledgers.iter().find(|ledger| ledger.document == id).ok_or_else(|| {
        let known: Vec<_> = ledgers.iter().map(|ledger| ledger.document.as_str()).collect();
        Refused::wrong(
            format!("there is no ledger of `{id}`"),
            format!("one of: {}", known.join(", ")),
        )
    })?;
    let text = place::text(&PathBuf::from(file), "document (--document)")?;
    Ok(match ledger::check(&text, ledger) {
        Ok(()) => Vec::new(),
        Err(mismatches) => mismatches.iter().map(|mismatch| format!("{id}: {mismatch}")).collect(),
    })
}

fn bless(suite: &Suite, folder: &Path, arguments: &Arguments) -> Result<u8, Refused> {
    let mut changed = 0;
    let rules = selected(suite, arguments);
    // A model that does not know the suite's options says nothing that could be blessed.
    for rule in &rules {
        if let Some(what) =
            rule.cases.first().and_then(|case| catalogue::undetermined(suite, rule, case))
        {
            return Err(Refused::wrong(
                format!("{}: the model has nothing to bless: {what}", rule.id),
                "build the command from the sources to which the pages belong",
            ));
        }
    }
    for rule in rules {
        let path = folder.join(&suite.paths[&rule.id]);
        let text = place::text(&path, "page")?;
        let blessed = with_goldens(suite, rule, &text).map_err(|error| {
            Refused::wrong(format!("{}: {error}", path.display()), "mend the page")
        })?;
        if blessed != text {
            place::write_whole(&path, &blessed)?;
            changed += 1;
        }
    }
    write_out(&format!("{changed} pages changed: read them before they are committed\n"));
    Ok(0)
}

/// The page with the golden of its first case, and of each that has one, as the model has it now.
fn with_goldens(suite: &Suite, rule: &Rule, page: &str) -> Result<String, String> {
    let mut document: DocumentMut =
        page.parse().map_err(|error: toml_edit::TomlError| error.to_string())?;
    if rule.cases.is_empty() {
        return Ok(page.to_owned());
    }
    let cases = document
        .get_mut("case")
        .and_then(Item::as_array_of_tables_mut)
        .ok_or("its cases are not written as [[case]]")?;
    for (place, (table, case)) in cases.iter_mut().zip(&rule.cases).enumerate() {
        if place > 0 && case.golden.is_none() {
            continue;
        }
        let Some(golden) = catalogue::golden(suite, rule, case) else { continue };
        if case.golden.as_ref() == Some(&golden) {
            continue;
        }
        let literal = !golden.contains("'''")
            && !golden.chars().any(|c| c.is_control() && c != '\n' && c != '\t');
        let value = if literal {
            format!("'''\n{golden}'''")
                .parse::<toml_edit::Value>()
                .map_err(|error| error.to_string())?
        } else {
            toml_edit::Value::from(golden)
        };
        table.insert("golden", toml_edit::value(value));
    }
    Ok(document.to_string())
}
