//! `gaugeblock judge`.

use std::path::{Path, PathBuf};

use clap::Args;
use gaugeblock_motion::Summary;
use gaugeblock_reference::motion::laws::Verdict;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::Position;
use gaugeblock_vocabulary::motion::Samples;

use super::pictures::Drawing;
use super::{Refused, place, plan, run, write_out};

const EXAMPLES: &str = "Examples:
  gaugeblock judge part.csv --program part.ngc --machine mill.toml
  gaugeblock judge part.bin --program part.ngc --machine mill.toml --script hold.toml
  gaugeblock judge part.csv --program part.ngc --machine mill.toml --svg part.svg

Samples are a table with a line that says how long a servo cycle is, and a line that names the columns:
  # gaugeblock samples 0 period=0.001 resolution=0
  x,y,z,line
  0,0,0,1
or the compact form that `gaugeblock plan --samples part.bin` writes. What they do not show is not judged.

Exit status: 0 where at least one law of motion is judged, and each that is holds; 1 where one is broken; 2 where there is no sample; 3 where
no law can be judged. Which ones cannot, and why, is told; a law of what the program does not ask for is none of them.";

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
    let mut inputs = arguments.how.inputs(&arguments.program);
    inputs.extend([arguments.samples.clone(), arguments.machine.clone()]);
    inputs.extend(arguments.script.clone());
    place::spare(&inputs, &[("--svg", arguments.svg.as_deref())])?;
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
    Ok(exit_status(&summary))
}

/// A law that cannot be judged is no failure, since a machine need not have every limit; that nothing was judged is
/// no success.
pub(super) fn exit_status(summary: &Summary) -> u8 {
    let mut laws = summary.judgement.0.iter();
    if !summary.holds() {
        1
    } else if laws.any(|(_, verdict)| matches!(verdict, Verdict::Satisfied { .. })) {
        0
    } else {
        3
    }
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
    let samples = samples.map_err(|error| {
        Refused::wrong(format!("{name}: {error}"), "`gaugeblock judge --help` shows the form")
    })?;
    if samples.is_empty() {
        return Err(Refused::wrong(
            format!("{name}: it holds no sample: nothing comes after its head"),
            "record the motion of the program, a sample for each servo cycle; `gaugeblock judge --help` shows the form",
        ));
    }
    Ok(samples)
}

#[cfg(test)]
mod tests {
    use gaugeblock_reference::motion::laws::{Judgement, Law, Violation};

    use super::*;

    #[test]
    fn a_law_that_is_not_judged_neither_fails_nor_passes() {
        let held = Verdict::Satisfied { share: None };
        let broken = Verdict::Violated(vec![Violation {
            law: Law::Feed,
            cycle: 0,
            cycles: 1,
            axis: None,
            measured: 2.0,
            allowed: 1.0,
            words: "too fast".to_owned(),
        }]);
        let open = Verdict::NotJudged("x moves and is not recorded".to_owned());
        for (verdicts, status) in [
            (vec![held.clone(), open.clone()], 0),
            (vec![held, broken], 1),
            (vec![open.clone(), Verdict::NotApplicable], 3),
            (vec![open], 3),
        ] {
            let judgement = Judgement(Law::ALL.iter().copied().zip(verdicts).collect());
            let summary = Summary { time: 0.0, least: Ok(0.0), kinds: Vec::new(), judgement };
            assert_eq!(exit_status(&summary), status, "{summary}");
        }
    }
}
