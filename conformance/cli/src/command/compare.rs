//! `gaugeblock compare`.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use gaugeblock_adapter::Adapter;
use gaugeblock_compare::observe::Observed;
use gaugeblock_compare::{Comparison, compare as compare_runs};
use gaugeblock_reference::motion::path::{differ, programmed};
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::{End, Outcome, Position, Undetermined};
use serde_json::json;

use super::controller;
use crate::arguments::Format;
use crate::error::CliError;
use crate::program::run_setup::RunSetup;
use crate::streams::write_out;

const EXAMPLES: &str = "Examples:
  gaugeblock compare part.ngc --controller rs274
  gaugeblock compare *.ngc --controller rs274 --edition rs274-2.9-observed
  gaugeblock compare part.ngc --controller rs274 --against reference --format json

Exit status: 0 no difference; 1 a difference; 2 wrong call or input;
3 a program could not be compared.";

/// The remark where effects differ and the commanded path does not.
const SAME_PATH: &str = "\n  the path is the same, divided into different moves";

/// How far points of the same path may be apart, millimetres.
const PATH_TOLERANCE: f64 = 1e-6;

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The programs
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// The controller: reference, production, rs274, linuxcnc, exec:COMMAND, tcp:HOST:PORT or offline:DIR
    #[arg(long, short, value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    controller: String,
    /// The controller to compare it with
    #[arg(long, value_name = "CONTROLLER", default_value = "reference")]
    against: String,
    #[command(flatten)]
    how: RunSetup,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn compare(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let mut found_by = controller::controller(&arguments.controller)?;
    found_by.check_observation();
    let mut expected_by = controller::controller(&arguments.against)?;
    expected_by.check_observation();
    let both_sides = [found_by.as_ref(), expected_by.as_ref()];
    let scenarios = arguments
        .files
        .iter()
        .map(|file| Ok((file, arguments.how.scenario(suite, file, &both_sides)?)))
        .collect::<Result<Vec<_>, CliError>>()?;
    let mut status = 0;
    let mut text = String::new();
    let mut results = Vec::new();
    for (file, scenario) in scenarios {
        let name = file.display().to_string();
        let words = match both(found_by.as_ref(), expected_by.as_ref(), &scenario) {
            Ok((Comparison { divergence: None, compared, masked }, _)) => {
                results.push(
                    json!({ "file": name, "equal": true, "compared": compared, "masked": masked }),
                );
                format!("{name}: no difference ({} values compared)", compared.total())
            }
            Ok((Comparison { divergence: Some(divergence), .. }, same_path)) => {
                status = status.max(1);
                let source =
                    divergence.block.as_ref().and_then(|block| scenario.program.line(block));
                results.push(json!({
                    "file": name, "equal": false, "block": divergence.block, "source": source,
                    "field": divergence.field, "expected": divergence.expected, "found": divergence.found,
                    "same_path": same_path,
                }));
                let place = divergence
                    .block
                    .as_ref()
                    .map_or_else(String::new, |block| format!(":{}", block.line));
                let (against, controller) = (&arguments.against, &arguments.controller);
                let width = against.len().max(controller.len());
                let remark = if same_path { SAME_PATH } else { "" };
                format!(
                    "{name}{place}: {}\n      | {}\n  {against:width$}  {}\n  {controller:width$}  {}{remark}",
                    divergence.field,
                    source.unwrap_or("(the end)"),
                    divergence.expected,
                    divergence.found
                )
            }
            Err(why) => {
                status = 3;
                results.push(json!({ "file": name, "not_compared": why }));
                format!("{name}: not compared: {why}")
            }
        };
        let _infallible = writeln!(text, "{words}");
    }
    match arguments.format {
        Format::Text => write_out(&text),
        Format::Json => {
            write_out(&format!("{:#}\n", json!({ "gaugeblock": "comparison", "files": results })));
        }
    }
    Ok(status)
}

fn both(
    found_by: &dyn Adapter,
    expected_by: &dyn Adapter,
    scenario: &gaugeblock_vocabulary::Scenario,
) -> Result<(Comparison, bool), String> {
    let run = |controller: &dyn Adapter| {
        let name = controller.capabilities().name.clone();
        controller.supports(scenario).map_err(|why| format!("{name} cannot run this: {why}"))?;
        let outcome = controller.run(scenario).map_err(|error| format!("{name}: {error}"))?;
        match outcome.end.undetermined() {
            Some(Undetermined::Unsupported(what)) => {
                Err(format!("{name} does not support this: {what}"))
            }
            Some(Undetermined::Unspecified(why)) => Err(format!("{name}: not specified: {why}")),
            None => Ok(outcome),
        }
    };
    let (found, expected) = (run(found_by)?, run(expected_by)?);
    let observables = found_by.observables(scenario).and(&expected_by.observables(scenario));
    let comparison = compare_runs(&Observed::of(&expected), &Observed::of(&found), &observables);
    let effects_differ =
        comparison.divergence.as_ref().is_some_and(|divergence| divergence.field == "effect");
    Ok((comparison, effects_differ && is_same_path(&expected, &found)))
}

/// Whether two finished runs command the same path, however it is divided into moves.
///
/// The result is a remark, not a verdict: the documents say which move each block makes. A controller that reports
/// only its path declares so.
fn is_same_path(expected: &Outcome, found: &Outcome) -> bool {
    let path = |outcome: &Outcome| {
        let ended = matches!(outcome.end, End::ProgramEnd | End::PercentEnd);
        ended.then(|| programmed(outcome, Position::default()))
    };
    let (Some(expected), Some(found)) = (path(expected), path(found)) else { return false };
    differ(&expected, &found, PATH_TOLERANCE).is_none()
}
