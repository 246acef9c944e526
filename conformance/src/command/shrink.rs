//! `gaugeblock shrink`.

use std::path::PathBuf;

use clap::Args;
use gaugeblock_fuzz::generate::GeneratorConfig;
use gaugeblock_fuzz::generate::splice::Seeds;
use gaugeblock_suite::Suite;
use serde_json::json;

use super::fuzz_report::body;
use super::run::How;
use super::{Format, Refused, controller, place, write_out};
use crate::fuzz::groups::{Finding, shrunk};
use crate::fuzz::statistics::Statistics;
use crate::fuzz::{FuzzResult, Plan};

const EXAMPLES: &str = "Examples:
  gaugeblock shrink part.ngc --iut rs274
      the smallest program on which LinuxCNC's interpreter still departs from the reference in the same way
  gaugeblock shrink part.ngc --iut production --output small.ngc
  gaugeblock shrink program.ngc --scenario scenario.toml --iut production
      a divergence that `gaugeblock fuzz --report` wrote down

Exit status: 0 shrunk, 1 the two do not differ on this program, 2 the call is wrong, 3 it could not be judged.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The program
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The controller under test
    #[arg(long, value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    iut: String,
    /// The controller that it is compared with
    #[arg(long, value_name = "CONTROLLER", default_value = "reference")]
    against: String,
    #[command(flatten)]
    how: How,
    /// How many programs are tried at most
    #[arg(long, value_name = "N", default_value_t = 20_000)]
    attempts: u32,
    /// Write the smallest program into this file
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// What to print
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(super) fn shrink(arguments: &Arguments, suite: &Suite) -> Result<u8, Refused> {
    let inputs = arguments.how.inputs(&arguments.file);
    place::spare(&inputs, &[("--output", arguments.output.as_deref())])?;
    let scenario = arguments.how.scenario(suite, &arguments.file)?;
    let iut = controller::controller(&arguments.iut)?;
    let against = controller::controller(&arguments.against)?;
    let plan = Plan {
        iut: iut.as_ref(),
        against: against.as_ref(),
        config: GeneratorConfig::default(),
        seed: 0,
        spliced: 0,
        seeds: Seeds::default(),
        options: scenario.options.clone(),
        random: Vec::new(),
        environment: scenario.environment.name.clone(),
    };
    let mut statistics = Statistics::default();
    let name = arguments.file.display();
    let difference = match plan.judge(&scenario, &mut statistics) {
        FuzzResult::Differs(difference) => *difference,
        FuzzResult::Same => {
            write_out(&format!(
                "{name}: {} and {} do not differ\n",
                arguments.iut, arguments.against
            ));
            return Ok(1);
        }
        FuzzResult::Fragile => {
            write_out(&format!(
                "{name}: they differ, but the last bit of a transcendental function or of a position decides\n"
            ));
            return Ok(1);
        }
        FuzzResult::Unsupported | FuzzResult::Unspecified | FuzzResult::NotJudged(_) => {
            let counts = [&statistics.unsupported, &statistics.unspecified, &statistics.not_judged];
            let why: Vec<&str> =
                counts.iter().flat_map(|counts| counts.keys()).map(String::as_str).collect();
            return Err(Refused::unfinished(
                format!("{name}: not compared: {}", why.join("; ")),
                "`gaugeblock run` shows what each controller does with it",
            ));
        }
    };
    let finding = shrunk(&plan, &Finding::of(0, scenario, difference), arguments.attempts);
    if let Some(output) = &arguments.output {
        place::write_whole(output, &finding.scenario.program.main)?;
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
