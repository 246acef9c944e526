//! `gaugeblock shrink`.

use std::path::PathBuf;

use clap::Args;
use gaugeblock_runner::fuzz::groups::{Finding, shrunk};
use gaugeblock_runner::fuzz::statistics::Statistics;
use gaugeblock_runner::fuzz::{FuzzResult, Plan};
use gaugeblock_suite::Suite;
use serde_json::json;

use super::fuzz_report::body;
use super::{controller, user_files};
use crate::arguments::Format;
use crate::error::CliError;
use crate::program::own_name;
use crate::program::run_setup::RunSetup;
use crate::streams::write_out;

const EXAMPLES: &str = "Examples:
  gaugeblock shrink part.ngc --controller rs274
      find the smallest program on which rs274 and the model still differ in the same way
  gaugeblock shrink part.ngc --controller production --output small.ngc
  gaugeblock shrink program.ngc --scenario scenario.toml --controller production
      minimise a divergence that `gaugeblock fuzz --report` recorded

Exit status: 0 minimised; 1 the controllers do not differ on this program; 2 wrong call or input;
3 not comparable.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The program
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The controller: reference, production, rs274, linuxcnc, exec:COMMAND, tcp:HOST:PORT or offline:DIR
    #[arg(long, short, value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    controller: String,
    /// The controller to compare it with
    #[arg(long, value_name = "CONTROLLER", default_value = "reference")]
    against: String,
    #[command(flatten)]
    how: RunSetup,
    /// Largest number of programs to try
    #[arg(long, value_name = "N", default_value_t = 20_000)]
    attempts: u32,
    /// Write the minimised program to this file
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn shrink(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let iut = controller::controller(&arguments.controller)?;
    let against = controller::controller(&arguments.against)?;
    let both_sides = [iut.as_ref(), against.as_ref()];
    let scenario = arguments.how.scenario(suite, &arguments.file, &both_sides)?;
    let inputs = arguments.how.inputs(&arguments.file, &scenario);
    user_files::check_outputs_spare_inputs(&inputs, &[("--output", arguments.output.as_deref())])?;
    let plan = Plan::new(iut.as_ref(), against.as_ref(), scenario.options.clone());
    let mut statistics = Statistics::default();
    let name = user_files::program_name(&arguments.file);
    for side in both_sides {
        side.supports(&scenario).map_err(|why| {
            let side = &side.capabilities().name;
            let why = own_name::in_text(&why, &arguments.file);
            CliError::failure(
                format!("{name}: not compared: {side} cannot run this program: {why}"),
                "choose another controller with --controller or --against",
            )
        })?;
    }
    let difference = match plan.judge(&scenario, &mut statistics) {
        FuzzResult::Differs(difference) => *difference,
        FuzzResult::Same => {
            write_out(&format!(
                "{name}: {} and {} do not differ\n",
                arguments.controller, arguments.against
            ));
            return Ok(1);
        }
        FuzzResult::Fragile => {
            write_out(&format!(
                "{name}: they differ only in the last bit of a transcendental function or of a position\n"
            ));
            return Ok(1);
        }
        FuzzResult::Unsupported | FuzzResult::Unspecified | FuzzResult::NotJudged(_) => {
            let counts = [&statistics.unsupported, &statistics.unspecified, &statistics.not_judged];
            let why: Vec<&str> =
                counts.iter().flat_map(|counts| counts.keys()).map(String::as_str).collect();
            return Err(CliError::failure(
                format!("{name}: not compared: {}", why.join("; ")),
                "`gaugeblock run` prints what each controller does with it",
            ));
        }
    };
    let finding =
        shrunk(&plan, &Finding::of(0, scenario, difference), arguments.attempts, &|| false);
    if let Some(output) = &arguments.output {
        user_files::write_whole(output, &finding.scenario.program.main)?;
    }
    match arguments.format {
        Format::Text => write_out(&format!("{}\n{}", finding.signature, body(&finding))),
        Format::Json => write_out(&format!(
            "{:#}\n",
            json!({
                "gaugeblock": "shrunk", "signature": finding.signature, "rules": finding.rules, "divergence": finding.divergence,
                "finished": finding.shrunk, "scenario": finding.scenario,
            })
        )),
    }
    Ok(0)
}
