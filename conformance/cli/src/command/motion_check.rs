//! `gaugeblock motion check`: checks recorded servo samples of a program against the motion rules.

use std::path::{Path, PathBuf};

use clap::Args;
use gaugeblock_motion::Summary;
use gaugeblock_reference::motion::recording::Recording;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::Position;
use gaugeblock_vocabulary::motion::Samples;

use super::pictures::Drawing;
use super::{plan, scratch, user_files};
use crate::arguments::Format;
use crate::error::CliError;
use crate::program::run_setup::RunSetup;

const EXAMPLES: &str = "Examples:
  gaugeblock motion check part.csv --program part.ngc --machine mill.toml
  gaugeblock motion check part.bin --program part.ngc --machine mill.toml --script hold.toml
  gaugeblock motion check part.csv --program part.ngc --machine mill.toml --svg part.svg
  gaugeblock motion check part.csv --program part.ngc --machine mill.toml --format json

Samples are a table. Its first line gives the servo period in seconds, its second names the columns:
  # gaugeblock samples 0 period=0.001 resolution=0
  x,y,z,line
  0,0,0,1
The compact form that `gaugeblock plan --samples part.bin` writes is accepted too.
A column that is missing is not checked.

Exit status: 0 every motion rule that could be checked holds, and at least one could;
1 a motion rule is broken; 2 wrong call or input, or no sample; 3 no motion rule could be checked.
The output names the rules that could not be checked.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Recorded samples
    #[arg(value_name = "SAMPLES")]
    samples: PathBuf,
    /// The program that was run
    #[arg(long, value_name = "FILE")]
    program: PathBuf,
    /// TOML file with the limits of the machine's axes (`gaugeblock plan --help`)
    #[arg(long, value_name = "FILE")]
    machine: PathBuf,
    /// TOML file with the operator's actions by servo cycle
    #[arg(long, value_name = "FILE")]
    script: Option<PathBuf>,
    /// Draw path, speed and accelerations
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    how: RunSetup,
}

pub(crate) fn check_samples(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let scenario = arguments.how.scenario(suite, &arguments.program, &[])?;
    let mut inputs = arguments.how.inputs(&arguments.program, &scenario);
    inputs.extend([arguments.samples.clone(), arguments.machine.clone()]);
    inputs.extend(arguments.script.clone());
    user_files::check_outputs_spare_inputs(&inputs, &[("--svg", arguments.svg.as_deref())])?;
    let limits = plan::limits(&arguments.machine)?;
    let samples = read(&arguments.samples)?;
    if (samples.period() - limits.period).abs() > 1e-9 {
        return Err(CliError::usage(
            format!(
                "the samples have a period of {:?} s, the machine has one of {:?} s",
                samples.period(),
                limits.period
            ),
            "name the machine on which the samples were recorded",
        ));
    }
    let script = plan::script(arguments.script.as_deref())?;
    let path = plan::path(&scenario, &arguments.program, Position::default())?;
    let recording = Recording::of(&samples, path.start);
    drop(samples);
    let summary = Summary::of(&recording, &path, &limits, &script);
    let summary = summary.map_err(|error| scratch::failed(&error))?;
    if let Some(file) = &arguments.svg {
        let title = [
            format!("{}: {}", arguments.samples.display(), arguments.program.display()),
            summary.headline(),
        ];
        let (recording, path, limits, script) = (&recording, &path, &limits, &script);
        Drawing { title, recording, path, limits, script, feeds: None }.write(file)?;
    }
    plan::write_summary(&summary, &arguments.program, arguments.format)
}

fn read(file: &Path) -> Result<Samples, CliError> {
    let name = file.display();
    let bytes = user_files::read_bytes(file, "samples")?;
    let samples = match std::str::from_utf8(&bytes) {
        Ok(text) if text.starts_with('#') => Samples::from_csv(text),
        Ok(text) if !text.is_empty() => {
            let first: String = text.lines().next().unwrap_or_default().chars().take(40).collect();
            return Err(CliError::usage(
                format!("{name}: line 1: not a table of samples: it begins with `{first}`"),
                "the first line is like `# gaugeblock samples 0 period=0.001 resolution=0`, the second names the columns",
            ));
        }
        Ok(_) | Err(_) => Samples::from_bytes(&bytes),
    };
    let samples = samples.map_err(|error| {
        CliError::usage(
            format!("{name}: {error}"),
            "`gaugeblock motion check --help` describes the form",
        )
    })?;
    if samples.is_empty() {
        return Err(CliError::usage(
            format!("{name}: no sample after the header"),
            "record one sample per servo cycle; `gaugeblock motion check --help` describes the form",
        ));
    }
    Ok(samples)
}
