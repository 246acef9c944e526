//! `gaugeblock motion fuzz`.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

use clap::Args;
use gaugeblock_adapter::Adapter;
use gaugeblock_adapter::clock::now;
use gaugeblock_controllers::Production;
use gaugeblock_fuzz::motion::MotionProgram;
use gaugeblock_fuzz::motion::transformation::Transformation;
use gaugeblock_report::escape_text;
use gaugeblock_runner::motion_programs::{
    MotionResult, compared, judge_program, motion_program, shrunk, time_breach_id,
};
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::motion::MotionScript;
use gaugeblock_vocabulary::{Axis, End, Outcome, Scenario, Settings};

use super::motion_fuzz_document::{MotionFuzzDocument, ReportedGap, ReportedViolation};
use super::user_files;
use crate::arguments::Format;
use crate::error::CliError;
use crate::progress::Progress;
use crate::streams::{write_json, write_out};

const EXAMPLES: &str = "Examples:
  gaugeblock motion fuzz
      plan random programs on random machines for a minute
  gaugeblock motion fuzz --seed 7 --programs 100000 --report motion
      plan many programs; write the minimised program of each kind of violation into a folder
  gaugeblock motion fuzz --programs 1000 --format json
      print one JSON document; `gaugeblock schema motion-fuzz` describes it

Each program is planned, and its samples are checked against the motion rules.
Then the program is changed in one of seven ways (in four with limits of jerk), and the times are
compared:
  axes permuted, mirrored, scaled, a line split: the time may change by two servo cycles
  higher velocity, higher acceleration, looser tolerance: it may grow by 2 ms per second
A motion that never ends is a violation too.

Exit status: 0 no violation; 1 violations; 2 wrong call;
3 a program could not be planned, or there was none.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Random seed
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Number of the first program
    #[arg(long, value_name = "N", default_value_t = 0)]
    first: u64,
    /// Number of programs [default: until --seconds have passed]
    #[arg(long, value_name = "N")]
    programs: Option<u64>,
    /// Duration, seconds [default: 60, or unlimited with --programs]
    #[arg(long, value_name = "SECONDS", value_parser = clap::value_parser!(u64).range(1..))]
    seconds: Option<u64>,
    /// Number of programs that run at once [default: number of processors]
    #[arg(long, short, value_name = "N")]
    jobs: Option<NonZero<usize>>,
    /// Attempts to minimise the program of each kind of violation; 0 keeps the generated programs
    #[arg(long, value_name = "N", default_value_t = 1000)]
    shrink: u32,
    /// Change each program in all seven ways (see below) instead of one
    #[arg(long)]
    every_change: bool,
    /// Write report.txt into this folder, with program, machine and script of each kind of violation, and the changed
    /// program where times differ
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Breaches of one kind: how many, and of the program with the lowest number what was seen.
#[derive(Clone, Debug)]
struct Finding {
    count: u64,
    number: u64,
    words: String,
}

#[derive(Debug, Default)]
struct Tally {
    programs: u64,
    cycles: usize,
    /// How often, and the first program.
    not_planned: BTreeMap<String, (u64, u64)>,
    not_judged: BTreeMap<String, (u64, u64)>,
    found: BTreeMap<String, Finding>,
}

impl Tally {
    fn add(&mut self, number: u64, result: MotionResult) {
        self.programs += 1;
        self.cycles += result.cycles;
        let count = |counts: &mut BTreeMap<String, (u64, u64)>, why| {
            let (count, first) = counts.entry(why).or_insert((0, number));
            *count += 1;
            *first = number.min(*first);
        };
        if let Some(why) = result.not_planned {
            count(&mut self.not_planned, why);
        }
        for (law, why) in result.not_judged {
            count(&mut self.not_judged, format!("{}, {why}", law.id()));
        }
        for breach in result.broken {
            let new = Finding { count: 0, number: u64::MAX, words: String::new() };
            let found = self.found.entry(breach.what).or_insert(new);
            found.count += 1;
            if number < found.number {
                (found.number, found.words) = (number, breach.words);
            }
        }
    }

    /// What was not planned or not judged, and how many there were.
    fn counts(&self) -> String {
        let mut text = String::new();
        for (what, counts) in [("planned", &self.not_planned), ("judged", &self.not_judged)] {
            for (why, (count, first)) in counts {
                let _infallible =
                    writeln!(text, "not {what}, {count} times, first program {first}: {why}");
            }
        }
        let Self { programs, cycles, found, .. } = self;
        let _infallible = writeln!(
            text,
            "{programs} programs, {cycles} servo cycles; {} kinds of violations",
            found.len()
        );
        if *programs == 0 {
            text.push_str("nothing was judged\n");
        }
        text
    }

    fn document(&self, seed: u64, violations: Vec<ReportedViolation>) -> MotionFuzzDocument {
        let gaps = |counts: &BTreeMap<String, (u64, u64)>| {
            let gap = |(why, (count, first)): (&String, &(u64, u64))| ReportedGap {
                why: why.clone(),
                count: *count,
                first: *first,
            };
            counts.iter().map(gap).collect()
        };
        MotionFuzzDocument {
            gaugeblock: "motion-fuzz",
            version: 1,
            exit_status: self.exit_status(),
            seed,
            programs: self.programs,
            cycles: self.cycles,
            violations,
            not_planned: gaps(&self.not_planned),
            not_judged: gaps(&self.not_judged),
        }
    }

    /// 1 something is broken, 3 not everything was planned, or nothing was judged.
    fn exit_status(&self) -> u8 {
        if !self.found.is_empty() {
            1
        } else if !self.not_planned.is_empty() || self.programs == 0 {
            3
        } else {
            0
        }
    }
}

pub(crate) fn fuzz_motion(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    if let Some(folder) = &arguments.report {
        user_files::create_folder(folder)?;
    }
    let edition = crate::documents::edition(suite, gaugeblock_suite::DEFAULT_EDITION)?;
    let mut scenario = Scenario { options: suite.options(edition), ..Scenario::default() };
    scenario.environment.name.clone_from(&edition.environment);
    scenario.machine.axes = Axis::ALL.to_vec();
    let controller = Production::default();
    let runs = |program: &MotionProgram| outcome(&controller, &scenario, program);
    let seed = arguments.seed;
    let changes =
        |change| if arguments.every_change { Transformation::ALL.to_vec() } else { vec![change] };
    let tally = generate(arguments, &|number| {
        let (program, change) = motion_program(seed, number);
        judge_program((seed, number), (&program, &changes(change)), &runs)
    });
    let mut violations = Vec::new();
    for (what, found) in &tally.found {
        let (drawn, change) = motion_program(seed, found.number);
        let of = (seed, found.number);
        let smallest = if arguments.shrink == 0 {
            drawn
        } else {
            shrunk(of, (&drawn, &changes(change)), what, (arguments.shrink, &runs))
        };
        let change =
            Transformation::ALL.into_iter().find(|change| *what == time_breach_id(*change));
        let (smallest, changed) = match change {
            Some(change) => compared(of, &smallest, change)
                .map_or((smallest, None), |(alone, changed)| (alone, Some(changed))),
            None => (smallest, None),
        };
        let mut calls = Vec::new();
        if let Some(folder) = &arguments.report {
            let name = what.replace('.', "-");
            calls.push(write(folder, &name, &smallest, &scenario)?);
            if let Some(changed) = changed {
                calls.push(write(folder, &format!("{name}-changed"), &changed, &scenario)?);
            }
        }
        violations.push(ReportedViolation {
            kind: what.clone(),
            count: found.count,
            first: found.number,
            message: found.words.clone(),
            program: smallest.text(),
            calls,
        });
    }
    let text = violations.iter().map(violation_text).collect::<String>() + &tally.counts();
    if let Some(folder) = &arguments.report {
        user_files::write_whole(&folder.join("report.txt"), escape_text(&text).as_bytes())?;
    }
    match arguments.format {
        Format::Text => write_out(&text),
        Format::Json => write_json(&tally.document(seed, violations))?,
    }
    Ok(tally.exit_status())
}

/// Violations of a kind, for people.
fn violation_text(violation: &ReportedViolation) -> String {
    let ReportedViolation { kind, count, first, message, program, calls } = violation;
    let mut text =
        format!("{kind}, {count} times, first by program {first}: {message}\n{program}\n");
    for call in calls {
        let _infallible = writeln!(text, "{call}");
    }
    if !calls.is_empty() {
        text.push('\n');
    }
    text
}

/// What production says a program does.
fn outcome(controller: &Production, scenario: &Scenario, program: &MotionProgram) -> Outcome {
    let mut scenario = scenario.clone();
    scenario.program.main = program.text();
    controller.run(&scenario).unwrap_or_else(|error| {
        let why = error.to_string();
        let block = gaugeblock_vocabulary::BlockLocation::new("main.ngc", 1);
        Outcome {
            language: scenario.program.language,
            start: Settings::default(),
            steps: Vec::new(),
            end: End::Unsupported { block, what: why },
            parameters: None,
            pins: Vec::new(),
            samples: Vec::new(),
        }
    })
}

/// Judges numbers in any order until there are enough or time is over.
fn generate(arguments: &Arguments, judge: &(dyn Fn(u64) -> MotionResult + Sync)) -> Tally {
    let seconds = match (arguments.seconds, arguments.programs) {
        (None, None) => Some(60),
        (seconds, _) => seconds,
    };
    let end = seconds.map(|seconds| now() + Duration::from_secs(seconds));
    let last = arguments.programs.map_or(u64::MAX, |count| arguments.first.saturating_add(count));
    let processors = std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
    let jobs = arguments.jobs.unwrap_or(processors);
    let (next, over) = (AtomicU64::new(arguments.first), AtomicBool::new(false));
    let tally = Mutex::new(Tally::default());
    let progress = Progress::endless("programs");
    std::thread::scope(|scope| {
        for _ in 0..jobs.get() {
            scope.spawn(|| {
                while !over.load(Ordering::Relaxed) {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= last || end.is_some_and(|end| now() >= end) {
                        over.store(true, Ordering::Relaxed);
                        return;
                    }
                    let result = judge(number);
                    tally
                        .lock()
                        .expect("a thread with the lock only adds numbers")
                        .add(number, result);
                    progress.add(1);
                }
            });
        }
    });
    progress.finish();
    tally.into_inner().expect("a thread with the lock only added numbers")
}

/// Writes a program as files, and says with which call it is planned again.
fn write(
    folder: &Path,
    name: &str,
    program: &MotionProgram,
    scenario: &Scenario,
) -> Result<String, CliError> {
    let unwritable = |error: gaugeblock_vocabulary::TextError| {
        CliError::failure(error.message, "leave --report out")
    };
    let file = |ending: &str| folder.join(format!("{name}.{ending}"));
    user_files::write_whole(&file("ngc"), program.text())?;
    user_files::write_whole(&file("machine.toml"), program.limits.to_text().map_err(unwritable)?)?;
    user_files::write_whole(&file("scenario.toml"), scenario.to_text().map_err(unwritable)?)?;
    let mut call = format!(
        "gaugeblock plan {name}.ngc --machine {name}.machine.toml --scenario {name}.scenario.toml"
    );
    if program.script != MotionScript::default() {
        user_files::write_whole(
            &file("script.toml"),
            program.script.to_text().map_err(unwritable)?,
        )?;
        let _infallible = write!(call, " --script {name}.script.toml");
    }
    if let Some(every) = program.every {
        let _infallible = write!(call, " --feed-interval {every}");
    }
    if program.start.iter().any(|place| place.abs() > 0.0) {
        let start: Vec<String> = program.start.iter().map(f64::to_string).collect();
        let _infallible = write!(call, " --start={}", start.join(","));
    }
    Ok(call)
}
