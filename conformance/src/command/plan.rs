//! `gaugeblock plan`.

use std::path::{Path, PathBuf};

use clap::Args;
use gaugeblock_trace::motion::{Column, MotionLimits, MotionScript, ProgrammedPath, Samples};
use gaugeblock_trace::{End, Outcome, Position, Scenario};

use super::{Refused, place, run, write_error, write_out};
use crate::adapters::Adapter;
use crate::adapters::production::Production;
use crate::adapters::reference::Reference;
use crate::motion::{Circumstances, Picture, Summary, drawn, plan_under};
use crate::suite::Suite;

const EXAMPLES: &str = "Examples:
  gaugeblock plan part.ngc --machine mill.toml
  gaugeblock plan part.ngc --machine mill.toml --svg part.svg
  gaugeblock plan part.ngc --machine mill.toml --samples part.csv
  gaugeblock plan part.ngc --machine mill.toml --every 20
  gaugeblock plan part.ngc --machine mill.toml --script hold.toml

A machine file tells what its axes can do, in millimetres, degrees and seconds:
  period = 0.001
  [axes]
  x = { velocity = 250, acceleration = 2000 }
  y = { velocity = 250, acceleration = 2000 }
  z = { velocity = 100, acceleration = 1000 }

A script tells what the operator and the machine's inputs do, in order, each from a servo cycle on:
  events = [
    { cycle = 300, action = { hold = true } },
    { cycle = 500, action = { hold = false } },
    { cycle = 700, action = { feed_override = 0.5 } },
    { cycle = 900, action = \"abort\" },
  ]
Others: rapid_override, adaptive_feed, feed_stop, and spindle_speed = { spindle = 0, turns = 10 }.

Exit status: 0 where all laws of motion hold that can be judged, 1 where one is broken.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The program
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// What the machine's axes can do, a TOML file
    #[arg(long, value_name = "FILE")]
    machine: PathBuf,
    #[command(flatten)]
    how: run::How,
    /// Feed the planner one segment in so many servo cycles instead of as fast as it takes them
    #[arg(long, value_name = "CYCLES")]
    every: Option<u32>,
    /// What the operator does, by servo cycle, a TOML file
    #[arg(long, value_name = "FILE")]
    script: Option<PathBuf>,
    /// Where the machine stands before: X,Y,Z,A,B,C,U,V,W, millimetres and degrees; the program begins from its origin otherwise
    #[arg(long, value_name = "NUMBERS", value_delimiter = ',', allow_hyphen_values = true)]
    start: Vec<f64>,
    /// Write a sample for each servo cycle: a table, or the compact form where the name ends in .bin
    #[arg(long, value_name = "FILE")]
    samples: Option<PathBuf>,
    /// Draw path, speed and accelerations
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

pub(super) fn plan_program(arguments: &Arguments, suite: &Suite) -> Result<u8, Refused> {
    let limits = limits(&arguments.machine)?;
    let scenario = arguments.how.scenario(suite, &arguments.file)?;
    let outcome = ended(&Production::default(), &scenario, &arguments.file)?;
    let mut start = [0.0; 9];
    for (place, given) in start.iter_mut().zip(&arguments.start) {
        *place = *given;
    }
    let circumstances = Circumstances {
        start: Position::from(start),
        every: arguments.every,
        script: script(arguments.script.as_deref())?,
    };
    let planned = plan_under(&outcome, &limits, &circumstances).map_err(|stopped| {
        let place = stopped.block.map_or(String::new(), |block| format!("{block}: "));
        Refused::unfinished(
            format!("{}: {place}{}", arguments.file.display(), stopped.why),
            "up to there the program could be planned alone",
        )
    })?;
    let path = path(&scenario, &arguments.file, circumstances.start)?;
    let summary = Summary::of(&planned.samples, &path, &limits, &circumstances.script);
    if let Some(file) = &arguments.samples {
        write_samples(file, &planned.samples)?;
    }
    if let Some(file) = &arguments.svg {
        let accelerations = accelerations(&planned.samples, &limits);
        let positions = planned.samples.positions(Position::default());
        let commanded: Vec<_> = positions.iter().map(|at| [at.x, at.y, at.z]).collect();
        let title = [
            format!("{} on {}", arguments.file.display(), arguments.machine.display()),
            summary.headline(),
        ];
        let picture = Picture {
            title: &title,
            programmed: &drawn(&path),
            commanded: &commanded,
            deviation: &[],
            period: limits.period,
            speed: &planned.speed,
            asked: &planned.asked,
            acceleration: &accelerations,
        };
        let svg = picture
            .svg()
            .map_err(|error| Refused::unfinished(error.to_string(), "leave --svg out"))?;
        place::write_whole(file, &svg)?;
    }
    write_out(&summary.to_string());
    Ok(u8::from(!summary.holds()))
}

/// What a machine's axes can do.
pub(super) fn limits(file: &Path) -> Result<MotionLimits, Refused> {
    let text = place::program(file)?;
    MotionLimits::from_text(&text).map_err(|error| {
        let line = error.line.map_or(String::new(), |line| format!("line {line}: "));
        Refused::wrong(
            format!("{}: {line}{}", file.display(), error.message.trim_end()),
            "`gaugeblock plan --help` shows a machine file",
        )
    })
}

/// What the operator does; nothing without a file.
pub(super) fn script(file: Option<&Path>) -> Result<MotionScript, Refused> {
    let Some(file) = file else { return Ok(MotionScript::default()) };
    MotionScript::from_text(&place::program(file)?).map_err(|error| {
        let message = format!("{}: {}", file.display(), error.message.trim_end());
        Refused::wrong(message, "`gaugeblock plan --help` shows a script")
    })
}

/// The outcome of a program that comes to its end.
fn ended(controller: &dyn Adapter, scenario: &Scenario, file: &Path) -> Result<Outcome, Refused> {
    let refused = |why: String| Refused::unfinished(why, "`gaugeblock run` shows what it does");
    controller.supports(scenario).map_err(refused)?;
    let outcome = controller.run(scenario).map_err(|error| refused(error.to_string()))?;
    match &outcome.end {
        End::ProgramEnd | End::PercentEnd => Ok(outcome),
        end @ (End::Endless
        | End::Paused
        | End::Aborted
        | End::Fault(_)
        | End::BudgetExhausted { .. }
        | End::Unsupported { .. }
        | End::Unspecified { .. }) => {
            if let Some(pointer) = run::point_at(&outcome, scenario, file) {
                write_error(&pointer);
            }
            Err(Refused::wrong(
                format!("{} does not come to its end: {}", file.display(), end.name()),
                "only a program that ends has a path",
            ))
        }
    }
}

/// The path that a program asks for, as the model reads it.
pub(super) fn path(
    scenario: &Scenario,
    file: &Path,
    start: Position,
) -> Result<ProgrammedPath, Refused> {
    let outcome = ended(&Reference::default(), scenario, file)?;
    Ok(gaugeblock_reference::motion::path::programmed(&outcome, start))
}

fn write_samples(file: &Path, samples: &Samples) -> Result<(), Refused> {
    if file.extension().is_some_and(|extension| extension == "bin") {
        place::write_whole(file, samples.to_bytes())
    } else {
        place::write_whole(file, samples.to_csv())
    }
}

/// The acceleration of each axis that moves, as a share of what it can do.
fn accelerations(samples: &Samples, limits: &MotionLimits) -> Vec<(char, Vec<f64>)> {
    let square = samples.period() * samples.period();
    let mut all = Vec::new();
    for (axis, limit) in &limits.axes {
        let (Some(positions), Some(limit)) =
            (samples.column(Column::Position(*axis)), limit.acceleration)
        else {
            continue;
        };
        let shares: Vec<f64> = positions
            .windows(3)
            .map(|three| (three[2] - 2.0 * three[1] + three[0]) / square / limit)
            .collect();
        if shares.iter().any(|share| share.abs() > 0.0) {
            let letter = axis.to_string().to_uppercase().chars().next().unwrap_or('?');
            all.push((letter, shares));
        }
    }
    all
}
