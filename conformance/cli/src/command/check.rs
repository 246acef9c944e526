//! `gaugeblock adapter check`.

use clap::Args;
use gaugeblock_adapter::exec::Limits;
use gaugeblock_runner::check::{CheckResult, checks};
use gaugeblock_suite::Suite;

use super::controller;
use crate::error::CliError;
use crate::streams::write_out;

/// What to do about an adapter that does not start or answer.
const HINT: &str =
    "run the command by hand, and type a request; `gaugeblock adapter protocol` describes them";

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock adapter check \"python3 adapter.py\"
  gaugeblock adapter check ./adapter
  gaugeblock adapter check tcp:127.0.0.1:4100

Exit status: 0 no errors; 1 errors; 2 wrong call;
3 the adapter cannot be started or does not answer.")]
pub(crate) struct Arguments {
    /// Shell command that starts the adapter, or tcp:HOST:PORT
    #[arg(value_name = "COMMAND")]
    command: String,
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
                if error.status == 3 && starts { HINT.to_owned() } else { hint }
            }),
            ..error
        })?;
    let begun = gaugeblock_adapter::clock::now();
    let found = checks(&adapter, suite, &|| begun.elapsed().as_secs_f64());
    let mut wrong = 0;
    let mut text = String::new();
    for check in &found {
        let (mark, says) = match &check.result {
            CheckResult::Passed(says) => ("ok", says),
            CheckResult::Failed(says) => {
                wrong += 1;
                ("ERROR", says)
            }
            CheckResult::Skipped(says) => ("skipped", says),
        };
        let mut lines = says.lines();
        let first = lines.next().unwrap_or_default();
        text.push_str(&format!("{mark:8}  {:19}  {first}\n", check.name));
        lines.for_each(|line| text.push_str(&format!("{:31}{line}\n", "")));
    }
    text.push_str(&match wrong {
        0 => format!("\nno errors; next: gaugeblock certify --controller {named:?}\n"),
        1 => "\n1 error; `gaugeblock adapter protocol` describes the protocol\n".to_owned(),
        _ => format!("\n{wrong} errors; `gaugeblock adapter protocol` describes the protocol\n"),
    });
    write_out(&text);
    Ok(u8::from(wrong > 0))
}
