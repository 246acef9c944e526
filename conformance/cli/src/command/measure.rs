//! `gaugeblock measure`.

use std::fmt::Write as _;

use clap::Args;
use gaugeblock_report::escape_line;
use gaugeblock_runner::measure::{Measured, Measurement, measure as measured_by, names};
use gaugeblock_suite::Suite;
use serde_json::json;

use super::controller;
use crate::arguments::Format;
use crate::error::CliError;
use crate::progress::Progress;
use crate::streams::write_out;

const EXAMPLES: &str = "Examples:
  gaugeblock measure --controller rs274
  gaugeblock measure --controller \"exec:python3 adapter.py\" --only arc
  gaugeblock measure --controller production --format json > measured.json

The edge of each quantity is searched by bisection: the last value that the controller
accepts, and the first that it refuses. It says nothing of rules.

Exit status: 0 everything was measured; 2 wrong call; 3 something could not be measured.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The controller: reference, production, rs274, linuxcnc, exec:COMMAND, tcp:HOST:PORT
    #[arg(long, short, value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    controller: String,
    /// Edition whose options are passed to a controller that accepts options [default: the controller's own]
    #[arg(long, value_name = "EDITION")]
    edition: Option<String>,
    /// Measure only what has a name that begins with this, such as `arc`; may be repeated
    #[arg(long, value_name = "PREFIX")]
    only: Vec<String>,
    /// Print the program at each edge
    #[arg(long, short)]
    verbose: bool,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn measure(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let controller = controller::controller(&arguments.controller)?;
    let own = controller::own_edition(controller.as_ref(), suite);
    let edition = crate::documents::edition(suite, arguments.edition.as_deref().unwrap_or(own))?;
    let options = suite.options(edition);
    controller::check_options(controller.as_ref(), &options)?;
    controller::check_language(controller.as_ref(), edition)?;
    let wanted = |name: &str| {
        arguments.only.is_empty() || arguments.only.iter().any(|prefix| name.starts_with(prefix))
    };
    let names: Vec<_> = names().into_iter().filter(|name| wanted(name)).collect();
    if names.is_empty() {
        return Err(CliError::usage(
            format!("no measurement begins with {}", arguments.only.join(" or ")),
            "without --only everything is measured; the first column of its table has the names",
        ));
    }
    let progress = Progress::of(names.len(), "measurements");
    let measurements = measured_by(controller.as_ref(), &options, wanted, |_| progress.add(1));
    progress.finish();
    match arguments.format {
        Format::Json => {
            let document = json!({
                "gaugeblock": "measurements", "controller": controller.capabilities().name,
                "version": controller.capabilities().version, "edition": edition.id,
                "measurements": measurements,
            });
            write_out(&format!("{document:#}\n"));
        }
        Format::Text => write_out(&text(&measurements, arguments.verbose)),
    }
    let is_missing = |one: &Measurement| matches!(one.measured, Measured::Nothing(_));
    Ok(if measurements.iter().any(is_missing) { 3 } else { 0 })
}

/// A line for each measurement: its name, what it is, and the edge.
fn text(measurements: &[Measurement], with_programs: bool) -> String {
    let mut text = String::new();
    for measurement in measurements {
        let Measurement { id, title, program, .. } = measurement;
        let result = escape_line(&measurement.result());
        let _infallible = writeln!(text, "{id:<20} {title}\n{:<20} {result}", "");
        if with_programs {
            for line in program.lines() {
                let short: String = line.chars().take(60).collect();
                let _infallible = writeln!(text, "{:<20}   | {}", "", escape_line(&short));
            }
        }
    }
    text
}
