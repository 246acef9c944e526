//! `gaugeblock suite`: maintains the suite.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use gaugeblock_compare::alignment::changed_lines;
#[cfg(feature = "faulty")]
use gaugeblock_runner::certify::Scope;
use gaugeblock_runner::suite_check;
use gaugeblock_suite::ledger::{self, Ledger};
use gaugeblock_suite::{Rule, Suite, files};
use schemars::JsonSchema;
use serde::Serialize;
use toml_edit::{DocumentMut, Item};

use super::matrix::matrix;
use super::profiles::{ProfileArguments, profiles};
use super::rules::selected;
use super::user_files;
use crate::arguments::Format;
use crate::documents::read_suite;
use crate::error::CliError;
use crate::streams::{write_json, write_out};

const EXAMPLES: &str = "Examples:
  gaugeblock suite check
      every outcome reached, every golden current, every sentence of each document classified
  gaugeblock suite check --document linuxcnc-2.8=m-code.txt
      compare the sentence ledger with this copy of the document
  gaugeblock --suite conformance/suite suite bless saved-state
      write the model's outcomes as goldens of a chapter; read them before you commit them
  gaugeblock suite matrix --report out/report.json
      per document and section: sentences, rules, verdicts of the model and of a controller
  gaugeblock suite profiles
      what a vendor can claim, with the number of rules
  gaugeblock suite faults
      which planted faults the suite catches in production (build with --features faulty)";

/// Maintain the suite: check its pages, bless goldens, list what became of each document
#[derive(Debug, Subcommand)]
#[command(after_help = EXAMPLES)]
pub(crate) enum Maintenance {
    /// Check every page, golden and sentence ledger
    Check(CheckArguments),
    /// Write the model's outcomes as goldens into the pages of --suite
    Bless(BlessArguments),
    /// Print, per document and section, its sentences, its rules and their verdicts
    Matrix(MatrixArguments),
    /// List the profiles that a vendor can claim, with their number of rules
    Profiles(ProfileArguments),
    /// Certify the production interpreter with each planted fault (build with --features faulty)
    Faults(FaultArguments),
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock suite check
  gaugeblock --suite conformance/suite suite check
  gaugeblock suite check --document linuxcnc-2.8=m-code.txt
  gaugeblock suite check --format json

Exit status: 0 no errors; 1 errors; 2 wrong call or input.")]
pub(crate) struct CheckArguments {
    /// Compare the sentence ledger of document ID with this file; may be repeated
    #[arg(long, value_name = "ID=FILE")]
    document: Vec<String>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Output of `suite check --format json`.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "SuiteCheck")]
pub(crate) struct SuiteCheckDocument {
    /// `suite-check`.
    gaugeblock: &'static str,
    /// Version of this form.
    version: u32,
    /// The exit status of the call.
    exit_status: u8,
    /// Number of rules.
    rules: usize,
    /// Number of cases.
    cases: usize,
    /// Number of documents with a sentence ledger.
    documents: usize,
    /// The errors, each in a sentence.
    errors: Vec<String>,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock --suite conformance/suite suite bless saved-state
  gaugeblock --suite conformance/suite suite bless saved-state.feed feed

Exit status: 0 the pages are written; 2 wrong call or input.")]
pub(crate) struct BlessArguments {
    /// Bless only rules whose id begins with this; may be repeated
    #[arg(value_name = "PREFIX")]
    prefix: Vec<String>,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock suite matrix
  gaugeblock suite matrix --report out/report.json --format json
  gaugeblock suite matrix --document linuxcnc-2.9

Exit status: 0 printed; 2 wrong call or input.")]
pub(crate) struct MatrixArguments {
    /// Print the sections of this document alone; may be repeated
    #[arg(long, value_name = "ID")]
    document: Vec<String>,
    /// Add the verdicts of this report as a column; may be repeated
    #[arg(long, value_name = "REPORT.json")]
    report: Vec<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock suite faults
  gaugeblock suite faults --assertions-only
  gaugeblock suite faults cycles. arcs.one-turn

Exit status: 0 each fault is caught, and the first finding names its rule or is a listed exception;
1 a fault is not caught, or another rule is named; 2 wrong call or input. With --assertions-only a
fault is caught where an assertion of a rule of its own fails.")]
pub(crate) struct FaultArguments {
    /// Plant only faults whose name begins with this; may be repeated
    #[arg(value_name = "PREFIX")]
    prefix: Vec<String>,
    /// Count a fault as caught only if an assertion of a rule that it breaks fails; print on how many cases each hangs
    #[arg(long)]
    assertions_only: bool,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Keeps the ledgers of these documents; all without any.
fn limit_to_documents(ledgers: &mut Vec<Ledger>, documents: &[String]) -> Result<(), CliError> {
    let known: Vec<String> = ledgers.iter().map(|ledger| ledger.document.clone()).collect();
    if let Some(unknown) = documents.iter().find(|id| !known.contains(id)) {
        return Err(CliError::usage(
            format!("no document has the id `{unknown}`"),
            format!("expected one of: {}", known.join(", ")),
        ));
    }
    ledgers.retain(|ledger| documents.is_empty() || documents.contains(&ledger.document));
    Ok(())
}

/// Runs a maintenance command on the suite in `folder`, or on the built-in suite.
pub(crate) fn maintain(command: &Maintenance, folder: Option<&Path>) -> Result<u8, CliError> {
    let suite = read_suite(folder)?;
    match command {
        Maintenance::Check(arguments) => check(&suite, folder, arguments),
        Maintenance::Bless(arguments) => {
            let folder = folder.ok_or_else(|| {
                CliError::usage(
                    "`suite bless` needs the folder whose pages it writes",
                    "name it: gaugeblock --suite conformance/suite suite bless",
                )
            })?;
            bless(&suite, folder, &arguments.prefix)
        }
        Maintenance::Matrix(arguments) => {
            let (mut ledgers, faults) = ledgers(&suite, folder)?;
            if let Some(fault) = faults.into_iter().next() {
                return Err(CliError::usage(fault, "`gaugeblock suite check` lists all errors"));
            }
            limit_to_documents(&mut ledgers, &arguments.document)?;
            matrix(&suite, &ledgers, &arguments.report, arguments.format)
        }
        Maintenance::Profiles(arguments) => profiles(&suite, arguments),
        Maintenance::Faults(arguments) => faults(&suite, arguments),
    }
}

#[cfg(feature = "faulty")]
fn faults(suite: &Suite, arguments: &FaultArguments) -> Result<u8, CliError> {
    let scope = if arguments.assertions_only { Scope::AssertionsOnly } else { Scope::Full };
    super::faults::faults(suite, "linuxcnc-2.9", &arguments.prefix, scope, arguments.format)
}

#[cfg(not(feature = "faulty"))]
fn faults(_suite: &Suite, _arguments: &FaultArguments) -> Result<u8, CliError> {
    Err(CliError::usage(
        "this build has no planted faults",
        "build with them: cargo build --release --features faulty",
    ))
}

fn check(suite: &Suite, folder: Option<&Path>, arguments: &CheckArguments) -> Result<u8, CliError> {
    let mut faults = suite_check::faults(suite);
    let (ledgers, wrong) = ledgers(suite, folder)?;
    faults.extend(wrong);
    for named in &arguments.document {
        faults.extend(check_document(&ledgers, named)?);
    }
    let cases: usize = suite.rules.iter().map(|rule| rule.case_names().count()).sum();
    let exit_status = u8::from(!faults.is_empty());
    if arguments.format == Format::Json {
        write_json(&SuiteCheckDocument {
            gaugeblock: "suite-check",
            version: 1,
            exit_status,
            rules: suite.rules.len(),
            cases,
            documents: ledgers.len(),
            errors: faults,
        })?;
        return Ok(exit_status);
    }
    let mut text = String::new();
    for fault in &faults {
        let _infallible = writeln!(text, "{fault}");
    }
    let _infallible = writeln!(
        text,
        "{} rules, {cases} cases, {} documents: {}",
        suite.rules.len(),
        ledgers.len(),
        match faults.len() {
            0 => "no errors".to_owned(),
            1 => "1 error".to_owned(),
            count => format!("{count} errors"),
        }
    );
    write_out(&text);
    Ok(exit_status)
}

/// The sentence ledgers, and the errors of those that cannot be read or name pages that the suite does not have.
fn ledgers(suite: &Suite, folder: Option<&Path>) -> Result<(Vec<Ledger>, Vec<String>), CliError> {
    let files = match folder {
        Some(folder) => files::of_folder(folder).map_err(|error| {
            CliError::usage(error, "--suite takes a folder like conformance/suite")
        })?,
        None => gaugeblock_embedded_suite::files().map_err(|error| {
            CliError::usage(error, "--suite takes a folder like conformance/suite")
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

/// The sentence ledgers.
///
/// # Errors
/// The first fault of one of them.
pub(crate) fn sound_ledgers(suite: &Suite, folder: Option<&Path>) -> Result<Vec<Ledger>, CliError> {
    let (ledgers, faults) = ledgers(suite, folder)?;
    match faults.into_iter().next() {
        None => Ok(ledgers),
        Some(fault) => Err(CliError::usage(fault, "`gaugeblock suite check` lists all errors")),
    }
}

fn check_document(ledgers: &[Ledger], named: &str) -> Result<Vec<String>, CliError> {
    let (id, file) = named.split_once('=').ok_or_else(|| {
        CliError::usage(
            format!("invalid `--document {named}`: expected ID=FILE"),
            "for example --document linuxcnc-2.8=m-code.txt",
        )
    })?;
    let ledger = ledgers.iter().find(|ledger| ledger.document == id).ok_or_else(|| {
        let known: Vec<_> = ledgers.iter().map(|ledger| ledger.document.as_str()).collect();
        CliError::usage(
            format!("unknown document `{id}`"),
            format!("expected one of: {}", known.join(", ")),
        )
    })?;
    let text = user_files::read_text(&PathBuf::from(file), "document (--document)")?;
    Ok(match ledger::check(&text, ledger) {
        Ok(()) => Vec::new(),
        Err(mismatches) => mismatches.iter().map(|mismatch| format!("{id}: {mismatch}")).collect(),
    })
}

fn bless(suite: &Suite, folder: &Path, prefixes: &[String]) -> Result<u8, CliError> {
    let mut changed = 0;
    let mut changes = String::new();
    let rules = selected(suite, prefixes);
    // A model that does not know the suite's options has no outcome to bless.
    for rule in &rules {
        if let Some(what) =
            rule.cases.first().and_then(|case| suite_check::undetermined(suite, rule, case))
        {
            return Err(CliError::usage(
                format!("{}: the model has no outcome to bless: {what}", rule.id),
                "build `gaugeblock` from the same commit as the pages",
            ));
        }
    }
    for rule in rules {
        let path = folder.join(&suite.paths[&rule.id]);
        let text = user_files::read_text(&path, "page")?;
        let blessed = with_goldens(suite, rule, &text).map_err(|error| {
            CliError::usage(format!("{}: {error}", path.display()), "correct the page")
        })?;
        if blessed != text {
            user_files::write_whole(&path, &blessed)?;
            changed += 1;
            let lines = changed_lines(&text, &blessed);
            let _infallible = writeln!(changes, "{}\n{lines}", path.display());
        }
    }
    write_out(&format!("{changes}{changed} pages changed: read them before you commit them\n"));
    Ok(0)
}

/// The page with current goldens: of its first case, and of each case that has one.
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
        let Some(golden) = suite_check::golden(suite, rule, case) else { continue };
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
