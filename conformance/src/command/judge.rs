//! `gaugeblock judge`.

use std::path::{Path, PathBuf};

use clap::Args;
use gaugeblock_trace::Position;
use gaugeblock_trace::motion::Samples;

use super::pictures::Drawing;
use super::{Refused, plan, run, write_out};
use crate::motion::Summary;
use crate::suite::Suite;

const EXAMPLES: &str = "Examples:
  gaugeblock judge part.csv --program part.ngc --machine mill.toml
  gaugeblock judge part.bin --program part.ngc --machine mill.toml --script hold.toml
  gaugeblock judge part.csv --program part.ngc --machine mill.toml --svg part.svg

Samples are a table with a line that says how long a servo cycle is, and a line that names the columns:
  # gaugeblock samples 0 period=0.001 resolution=0
  x,y,z,line
  0,0,0,1
or the compact form that `gaugeblock plan --samples part.bin` writes. What they do not show is not judged.

Exit status: 0 where all laws of motion hold that can be judged, 1 where one is broken.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// Recorded samples
    #[arg(value_name = "SAMPLES")]
    samples: PathBuf,
    /// The program that was run
    #[arg(long, value_name = "FILE")]
    program: PathBuf,
    /// What the machine's axes can do, a TOML file (`gaugeblock plan --help`)
    #[arg(long, value_name = "FILE")]
    machine: PathBuf,
    /// What the operator did, by servo cycle, a TOML file
    #[arg(long, value_name = "FILE")]
    script: Option<PathBuf>,
    /// Draw path, speed and accelerations
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    how: run::How,
}

pub(super) fn judge_samples(arguments: &Arguments, suite: &Suite) -> Result<u8, Refused> {
    let limits = plan::limits(&arguments.machine)?;
    let samples = read(&arguments.samples)?;
    let script = plan::script(arguments.script.as_deref())?;
    let scenario = arguments.how.scenario(suite, &arguments.program)?;
    let path = plan::path(&scenario, &arguments.program, Position::default())?;
    let summary = Summary::of(&samples, &path, &limits, &script);
    if let Some(file) = &arguments.svg {
        let title = [
            format!("{}: {}", arguments.samples.display(), arguments.program.display()),
            summary.headline(),
        ];
        let (samples, path, limits, script) = (&samples, &path, &limits, &script);
        Drawing { title, samples, path, limits, script, told: None }.write(file)?;
    }
    write_out(&plan::told(&summary, &arguments.program));
    Ok(u8::from(!summary.holds()))
}

fn read(file: &Path) -> Result<Samples, Refused> {
    let name = file.display();
    let bytes = std::fs::read(file).map_err(|error| {
        Refused::wrong(format!("{name}: {error}"), "check the path of the samples")
    })?;
    let samples = match std::str::from_utf8(&bytes) {
        Ok(text) if text.starts_with('#') => Samples::from_csv(text),
        Ok(_) | Err(_) => Samples::from_bytes(&bytes),
    };
    samples.map_err(|error| {
        Refused::wrong(format!("{name}: {error}"), "`gaugeblock judge --help` shows the form")
    })
}
