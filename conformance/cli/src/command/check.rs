//! `gaugeblock adapter check`.

use clap::Args;
use gaugeblock_adapter::exec::Limits;
use gaugeblock_runner::check::{Check, CheckResult, checks};
use gaugeblock_suite::Suite;
use schemars::JsonSchema;
use serde::Serialize;

use super::controller;
use crate::arguments::Format;
use crate::error::CliError;
use crate::streams::{write_json, write_out};

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock adapter check \"python3 adapter.py\"
  gaugeblock adapter check ./adapter
  gaugeblock adapter check tcp:127.0.0.1:4100
  gaugeblock adapter check ./adapter --format json

Exit status: 0 no errors; 1 errors; 2 wrong call;
3 the adapter cannot be started or does not answer.")]
pub(crate) struct Arguments {
    /// Shell command that starts the adapter, or tcp:HOST:PORT
    #[arg(value_name = "COMMAND")]
    command: String,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Output of `adapter check --format json`.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "AdapterCheck")]
pub(crate) struct AdapterCheckDocument {
    /// `adapter-check`.
    gaugeblock: &'static str,
    /// Version of this form.
    version: u32,
    /// The exit status of the call.
    exit_status: u8,
    /// The controller, as `--controller` takes it.
    controller: String,
    /// The checks, in order.
    checks: Vec<ReportedCheck>,
}

/// A check and its result.
#[derive(Debug, Serialize, JsonSchema)]
struct ReportedCheck {
    /// What is checked.
    name: &'static str,
    /// The result.
    result: Mark,
    /// What was found, in sentences.
    message: String,
}

/// The result of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
enum Mark {
    /// As required.
    Ok,
    /// An error of the adapter.
    Error,
    /// It could not be checked.
    Skipped,
}

impl Mark {
    fn word(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Error => "ERROR",
            Self::Skipped => "skipped",
        }
    }
}

fn reported(check: &Check) -> ReportedCheck {
    let (result, message) = match &check.result {
        CheckResult::Passed(message) => (Mark::Ok, message),
        CheckResult::Failed(message) => (Mark::Error, message),
        CheckResult::Skipped(message) => (Mark::Skipped, message),
    };
    ReportedCheck { name: check.name, result, message: message.clone() }
}

pub(crate) fn check(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let named = &arguments.command;
    let named = match named.split_once(':') {
        Some(("exec" | "tcp", _)) => named.clone(),
        _ => format!("exec:{named}"),
    };
    let adapter = controller::external_controller(&named, Limits::default())
        .unwrap_or_else(|| controller::exec(&named, Limits::default()))
        .map_err(|error| CliError {
            hint: error.hint.map(|hint| {
                let starts = !error.message.contains("cannot be started");
                if error.status == 3 && starts { controller::START_HINT.to_owned() } else { hint }
            }),
            ..error
        })?;
    let begun = gaugeblock_adapter::clock::now();
    let found = checks(&adapter, suite, &|| begun.elapsed().as_secs_f64());
    let checks: Vec<ReportedCheck> = found.iter().map(reported).collect();
    let wrong = checks.iter().filter(|check| check.result == Mark::Error).count();
    let exit_status = u8::from(wrong > 0);
    if arguments.format == Format::Json {
        let controller = named;
        let (gaugeblock, version) = ("adapter-check", 1);
        write_json(&AdapterCheckDocument { gaugeblock, version, exit_status, controller, checks })?;
        return Ok(exit_status);
    }
    let mut text = String::new();
    for check in &checks {
        let mut lines = check.message.lines();
        let first = lines.next().unwrap_or_default();
        text.push_str(&format!("{:8}  {:19}  {first}\n", check.result.word(), check.name));
        lines.for_each(|line| text.push_str(&format!("{:31}{line}\n", "")));
    }
    text.push_str(&match wrong {
        0 => format!("\nno errors; next: gaugeblock certify --controller {named:?}\n"),
        1 => "\n1 error; `gaugeblock adapter protocol` describes the protocol\n".to_owned(),
        _ => format!("\n{wrong} errors; `gaugeblock adapter protocol` describes the protocol\n"),
    });
    write_out(&text);
    Ok(exit_status)
}
