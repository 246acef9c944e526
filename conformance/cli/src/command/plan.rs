//! `gaugeblock plan`.

use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use gaugeblock_adapter::{Adapter, NoSamples};
use gaugeblock_controllers::simulate::{
    PlannedCycle, RunConditions, Stopped, plan_cycles, sample_header,
};
use gaugeblock_controllers::{Production, Reference};
use gaugeblock_linuxcnc::LinuxCnc;
use gaugeblock_motion::{Summary, Thinned};
use gaugeblock_reference::motion::laws::Verdict;
use gaugeblock_reference::motion::recording::{Recording, RecordingError};
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::motion::{
    MotionLimits, MotionScript, ProgrammedPath, SamplesCheck, push_csv_row,
};
use gaugeblock_vocabulary::scenario::Program;
use gaugeblock_vocabulary::{End, Outcome, Position, Scenario};

use super::controller::linuxcnc;
use super::pictures::Drawing;
use super::{run, scratch, user_files};
use crate::arguments::Format;
use crate::error::CliError;
use crate::program::own_name;
use crate::program::run_setup::RunSetup;
use crate::progress::Progress;
use crate::streams::{write_error_in_colours, write_json, write_out};

const EXAMPLES: &str = "Examples:
  gaugeblock plan part.ngc --machine mill.toml
  gaugeblock plan part.ngc --machine mill.toml --svg part.svg
  gaugeblock plan part.ngc --machine mill.toml --samples part.csv
  gaugeblock plan part.ngc --machine mill.toml --feed-interval 20
  gaugeblock plan part.ngc --machine mill.toml --script hold.toml
  gaugeblock plan part.ngc --machine mill.toml --format json
  gaugeblock plan part.ngc --machine mill.toml --controller linuxcnc --samples recorded.csv

A machine file has the limits of the axes in millimetres, degrees and seconds:
  period = 0.001
  [axes]
  x = { velocity = 250, acceleration = 2000 }
  y = { velocity = 250, acceleration = 2000 }
  z = { velocity = 100, acceleration = 1000 }

A script lists operator actions and machine inputs in order, each with its servo cycle:
  events = [
    { cycle = 300, action = { hold = true } },
    { cycle = 500, action = { hold = false } },
    { cycle = 700, action = { feed_override = 0.5 } },
    { cycle = 900, action = \"abort\" },
  ]
Other actions: rapid_override, adaptive_feed, feed_stop,
and spindle_speed = { spindle = 0, turns = 10 }.

Exit status: 0 every motion rule that could be checked holds, and at least one could;
1 a motion rule is broken; 2 wrong call or input, or more than ten million servo cycles;
3 the program cannot be planned, or no motion rule could be checked.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The program
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// TOML file with the limits of the machine's axes
    #[arg(long, value_name = "FILE")]
    machine: PathBuf,
    #[command(flatten)]
    how: RunSetup,
    /// Motion controller: `production`, or `linuxcnc`, which is recorded while it runs the program on a simulated
    /// machine
    #[arg(long, short, value_name = "CONTROLLER", default_value = "production")]
    controller: String,
    /// Feed the planner one segment per CYCLES servo cycles [default: as fast as it takes them]
    #[arg(long, value_name = "CYCLES", value_parser = clap::value_parser!(u32).range(1..))]
    feed_interval: Option<u32>,
    /// TOML file with the operator's actions by servo cycle
    #[arg(long, value_name = "FILE")]
    script: Option<PathBuf>,
    /// Start position: X,Y,Z,A,B,C,U,V,W in millimetres and degrees [default: the origin]
    #[arg(long, value_name = "NUMBERS", value_delimiter = ',', allow_hyphen_values = true, value_parser = coordinate)]
    start: Vec<f64>,
    /// Write one sample per servo cycle: a table, or the compact form if the name ends in .bin
    #[arg(long, value_name = "FILE")]
    samples: Option<PathBuf>,
    /// Draw path, speed and accelerations
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn plan_program(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let outputs =
        [("--samples", arguments.samples.as_deref()), ("--svg", arguments.svg.as_deref())];
    let limits = limits(&arguments.machine)?;
    let linuxcnc = match arguments.controller.as_str() {
        "production" => None,
        "linuxcnc" => Some(linuxcnc()?),
        other => {
            return Err(CliError::usage(
                format!("invalid `--controller {other}`: it reports no servo samples"),
                "expected production or linuxcnc; `gaugeblock motion check` accepts samples of any controller",
            ));
        }
    };
    let own: Vec<&dyn Adapter> = linuxcnc.iter().map(|recorded| recorded as &dyn Adapter).collect();
    let scenario = arguments.how.scenario(suite, &arguments.file, &own)?;
    user_files::check_outputs_spare_inputs(&inputs(arguments, &scenario), &outputs)?;
    let circumstances = RunConditions {
        start: start(&arguments.start)?,
        every: arguments.feed_interval,
        script: script(arguments.script.as_deref())?,
    };
    let path = path(&scenario, &arguments.file, circumstances.start)?;
    let progress = Progress::endless("seconds of motion");
    let moved = match &linuxcnc {
        None => plan_samples(&scenario, &limits, &circumstances, arguments, &progress)?,
        Some(linuxcnc) => record_samples(linuxcnc, &scenario, &limits, arguments)?,
    };
    let recording = &moved.recording;
    progress.set(seconds(recording.len(), recording.period()), "checking the motion rules");
    let summary = Summary::of(recording, &path, &limits, &circumstances.script);
    let summary = summary.map_err(|error| scratch::failed(&error))?;
    progress.finish();
    if let Some(file) = &arguments.samples {
        write_samples(file, recording)?;
    }
    if let Some(file) = &arguments.svg {
        let machine = arguments.machine.display();
        let by = match arguments.controller.as_str() {
            "production" => String::new(),
            other => format!(", {other}"),
        };
        let title = [format!("{} on {machine}{by}", arguments.file.display()), summary.headline()];
        let (feeds, script) = (moved.feeds, &circumstances.script);
        Drawing { title, recording, path: &path, limits: &limits, script, feeds }.write(file)?;
    }
    write_summary(&summary, &arguments.file, arguments.format)
}

/// Prints a summary. Returns the exit status.
pub(crate) fn write_summary(
    summary: &Summary,
    file: &Path,
    format: Format,
) -> Result<u8, CliError> {
    let status = exit_status(summary);
    match format {
        Format::Text => write_out(&in_own_name(&summary.to_string(), file)),
        Format::Json => write_json(&summary.document(status, &|text| in_own_name(text, file)))?,
    }
    Ok(status)
}

/// The files that a call reads.
fn inputs(arguments: &Arguments, scenario: &Scenario) -> Vec<PathBuf> {
    let Arguments { file, machine, script, how, .. } = arguments;
    how.inputs(file, scenario).into_iter().chain([machine.clone()]).chain(script.clone()).collect()
}

/// A number of --start.
fn coordinate(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| "not a finite number".to_owned())
}

/// The position of the machine before the program; axes that are not given are at zero.
fn start(given: &[f64]) -> Result<Position, CliError> {
    let mut start = [0.0; 9];
    match start.get_mut(..given.len()) {
        Some(places) => places.copy_from_slice(given),
        None => {
            return Err(CliError::usage(
                format!("invalid `--start`: {} numbers for nine axes", given.len()),
                "expected X,Y,Z,A,B,C,U,V,W; missing numbers at the end are zero",
            ));
        }
    }
    Ok(Position::from(start))
}

/// A text with the name of the program file where the vocabulary calls it the main program.
fn in_own_name(text: &str, file: &Path) -> String {
    let main = format!("{}:", Program::MAIN);
    text.replace(&main, &format!("{}:", user_files::program_name(file)))
}

/// Samples, with the planner's speed along the path and the requested feed, if known.
struct PlannedMotion {
    recording: Recording,
    feeds: Option<(Thinned, Thinned)>,
}

/// Whole seconds of so many samples.
fn seconds(samples: usize, period: f64) -> u64 {
    let seconds = Duration::try_from_secs_f64(period).unwrap_or_default();
    seconds.saturating_mul(u32::try_from(samples).unwrap_or(u32::MAX)).as_secs()
}

/// How many samples are planned between two reports of progress.
const SAMPLES_PER_REPORT: usize = 50_000;

fn plan_samples(
    scenario: &Scenario,
    limits: &MotionLimits,
    circumstances: &RunConditions,
    arguments: &Arguments,
    progress: &Progress,
) -> Result<PlannedMotion, CliError> {
    let file = &arguments.file;
    let outcome = check_program_end(&Production::default(), scenario, file)?;
    let stopped = |stopped: Stopped| {
        let place = match &stopped.block {
            Some(block) => format!("{}:{}", own_name::location_name(block, file), block.line),
            None => file.display().to_string(),
        };
        if stopped.too_long {
            let hint = "plan it in parts, or with a longer `period` in the machine file";
            return CliError::usage(format!("{place}: {}", stopped.why), hint);
        }
        let hint = match stopped.unlimited {
            Some(axis) => {
                format!("add `{axis} = {{ velocity = …, acceleration = … }}` to its [axes]")
            }
            None => "the part before this block can be planned".to_owned(),
        };
        CliError::failure(format!("{place}: {}", stopped.why), hint)
    };
    let header = sample_header(&outcome, limits).map_err(stopped)?;
    let mut recording = scratch::recording(&header, circumstances.start);
    let mut feeds = arguments.svg.is_some().then(<(Thinned, Thinned)>::default);
    let mut lost = None;
    let report = &mut |cycle: PlannedCycle<'_>| {
        if let Some((speed, requested)) = &mut feeds {
            speed.push(cycle.speed);
            requested.push(cycle.requested);
        }
        if recording.len().is_multiple_of(SAMPLES_PER_REPORT) {
            progress.set(seconds(recording.len(), limits.period), "planning");
        }
        recording.push(cycle.row).map_err(|error| {
            let why = error.to_string();
            if let RecordingError::Store(_) = error {
                lost = Some(scratch::failed(&error));
            }
            why
        })
    };
    let planned = plan_cycles(&outcome, limits, circumstances, report);
    match (planned, lost) {
        (Ok(()), _) => Ok(PlannedMotion { recording, feeds }),
        (Err(_), Some(lost)) => Err(lost),
        (Err(why), None) => Err(stopped(why)),
    }
}

/// What LinuxCNC commands in each servo cycle, at its own pace and from its own origin.
fn record_samples(
    linuxcnc: &LinuxCnc,
    scenario: &Scenario,
    limits: &MotionLimits,
    arguments: &Arguments,
) -> Result<PlannedMotion, CliError> {
    if arguments.feed_interval.is_some()
        || arguments.script.is_some()
        || !arguments.start.is_empty()
    {
        return Err(CliError::usage(
            "--feed-interval, --script and --start do not apply to linuxcnc",
            "remove them: linuxcnc is recorded at its own pace and from its origin",
        ));
    }
    let refused = |error: NoSamples| match error {
        NoSamples::Unsupported(why) => {
            CliError::usage(why, "`gaugeblock plan --help` describes the supported programs")
        }
        NoSamples::Failed(why) => {
            CliError::failure(why.to_string(), "`gaugeblock run` prints what the program does")
        }
    };
    let samples = linuxcnc.record(scenario, limits).map_err(refused)?;
    let recording = Recording::of(&samples, Position::default());
    Ok(PlannedMotion { recording, feeds: None })
}

/// What a machine's axes can do.
pub(crate) fn limits(file: &Path) -> Result<MotionLimits, CliError> {
    let hint = "`gaugeblock plan --help` has an example of a machine file";
    user_files::read_form(file, "machine file (--machine)", hint, MotionLimits::from_text)
}

/// What the operator does; nothing without a file.
pub(crate) fn script(file: Option<&Path>) -> Result<MotionScript, CliError> {
    let Some(file) = file else { return Ok(MotionScript::default()) };
    let hint = "`gaugeblock plan --help` has an example of a script";
    user_files::read_form(file, "script (--script)", hint, MotionScript::from_text)
}

/// The outcome of a program, which has to reach its end.
fn check_program_end(
    controller: &dyn Adapter,
    scenario: &Scenario,
    file: &Path,
) -> Result<Outcome, CliError> {
    let refused = |why: String| CliError::failure(why, "`gaugeblock run` prints what it does");
    controller.supports(scenario).map_err(refused)?;
    let outcome = controller.run(scenario).map_err(|error| refused(error.to_string()))?;
    match &outcome.end {
        End::ProgramEnd | End::PercentEnd => Ok(outcome),
        End::StreamEnd
        | End::Endless
        | End::Paused
        | End::Aborted
        | End::Fault(_)
        | End::BudgetExhausted { .. }
        | End::Unsupported { .. }
        | End::Unspecified { .. } => {
            if let Some(pointer) = run::point_at(&outcome, scenario, file) {
                write_error_in_colours(&pointer);
            }
            let why = outcome.end.name();
            Err(CliError::usage(
                format!("{} does not reach its end: {why}", file.display()),
                "only a program that reaches its end can be planned",
            ))
        }
    }
}

/// The programmed path, as the model reads it.
pub(crate) fn path(
    scenario: &Scenario,
    file: &Path,
    start: Position,
) -> Result<ProgrammedPath, CliError> {
    let outcome = check_program_end(&Reference::default(), scenario, file)?;
    Ok(gaugeblock_reference::motion::path::programmed(&outcome, start))
}

fn write_samples(file: &Path, recording: &Recording) -> Result<(), CliError> {
    if file.extension().is_some_and(|extension| extension == "bin") {
        user_files::write_long(file, |output| {
            let header = recording.header().header_bytes(recording.len());
            let mut check = SamplesCheck::default();
            check.add(&header);
            output.write_all(&header)?;
            for_each_row(recording, |row| {
                let bytes: Vec<u8> = row.iter().flat_map(|value| value.to_le_bytes()).collect();
                check.add(&bytes);
                output.write_all(&bytes)
            })?;
            output.write_all(&check.to_bytes())
        })
    } else {
        user_files::write_long(file, |output| {
            output.write_all(recording.header().csv_header().as_bytes())?;
            let mut line = String::new();
            for_each_row(recording, |row| {
                line.clear();
                push_csv_row(row, &mut line);
                output.write_all(line.as_bytes())
            })
        })
    }
}

fn for_each_row(
    recording: &Recording,
    mut each: impl FnMut(&[f64]) -> io::Result<()>,
) -> io::Result<()> {
    let mut row = Vec::new();
    for sample in 0..recording.len() {
        recording.read_row(sample, &mut row).map_err(io::Error::other)?;
        each(&row)?;
    }
    Ok(())
}

/// A motion rule that cannot be checked does not fail, since a machine need not have every limit; a run in which none
/// could be checked does not pass. Where nothing moves, none is checked. An impossible motion does not pass either.
pub(crate) fn exit_status(summary: &Summary) -> u8 {
    let mut laws = summary.judgement.0.iter();
    if !summary.holds() {
        1
    } else if summary.moves()
        && !summary.is_impossible()
        && laws.any(|(_, verdict)| matches!(verdict, Verdict::Satisfied { .. }))
    {
        0
    } else {
        3
    }
}

#[cfg(test)]
mod tests {
    use gaugeblock_reference::motion::laws::{Judgement, Law, Violation};

    use super::*;

    #[test]
    fn a_rule_that_is_not_checked_neither_fails_nor_passes() {
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
            let summary = Summary {
                time: 1.0,
                least: Ok(0.0),
                uncertainty: 0.004,
                kinds: Vec::new(),
                aborted: false,
                judgement,
            };
            assert_eq!(exit_status(&summary), status, "{summary}");
            let too_fast = Summary { least: Ok(2.0), ..summary };
            let expected = if status == 1 { 1 } else { 3 };
            assert_eq!(exit_status(&too_fast), expected, "{too_fast}");
        }
    }
}
