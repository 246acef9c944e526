//! The command line `gaugeblock`.

mod adapter;
mod against;
mod certify;
mod check;
mod compare;
mod controller;
#[cfg(feature = "faulty")]
mod faults;
mod fingerprint;
mod fuzz;
mod fuzz_cases;
mod fuzz_motion;
mod fuzz_report;
mod judge;
mod matrix;
mod pictures;
mod place;
mod plan;
mod report;
mod rs274;
mod rules;
mod run;
mod schema;
mod serve;
mod shrink;
mod streams;
mod suite;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};
use gaugeblock_suite::{Edition, Suite, files};
use streams::{write_error, write_error_in_colours, write_out, write_out_in_colours};

use crate::report::inert;

/// Why a command does not go on, in one message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// 2: the call or its input is wrong. 3: it could not finish.
    pub status: u8,
    /// What is wrong, with its place.
    pub message: String,
    /// What to do.
    pub hint: Option<String>,
}

impl Refused {
    /// The call or its input is wrong.
    pub fn wrong(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { status: 2, message: message.into(), hint: Some(hint.into()) }
    }

    /// It could not finish.
    pub fn unfinished(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { status: 3, message: message.into(), hint: Some(hint.into()) }
    }
}

/// The exit statuses, as the help tells them.
const EXIT: &str = "Exit status:
  0  every case passes, is a known divergence, or is unsupported by what the controller declared before
  1  a divergence, a stale expectation, or a known divergence that changed
  2  the call or its input is wrong
  3  could not finish: controller missing or of an unknown version, crash, time-out, two runs that differ, inconclusive";

/// Holds a CNC controller to the documents of its language, rule by rule.
#[derive(Debug, Parser)]
#[command(name = "gaugeblock", version, after_help = EXIT, arg_required_else_help = true, max_term_width = 110)]
struct Call {
    /// A folder of suite pages instead of the suite that is built in
    #[arg(long, global = true, value_name = "DIR")]
    suite: Option<PathBuf>,
    #[command(subcommand)]
    command: Command,
}

/// What to print.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For a person
    Text,
    /// One JSON document
    Json,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run the suite against a controller: a verdict per rule
    Certify(certify::Arguments),
    /// Show what a program does on a controller: effects, settings, states
    Run(run::Arguments),
    /// Print a program's canonical calls as LinuxCNC's rs274 prints them
    Rs274(rs274::Arguments),
    /// Show where two controllers first differ on programs
    Compare(compare::Arguments),
    /// Run generated programs on two controllers: what differs, with the smallest program of each
    Fuzz(fuzz::Arguments),
    /// Plan generated programs: what breaks a law of motion, with the smallest program of each
    FuzzMotion(fuzz_motion::Arguments),
    /// Make a program on which two controllers differ as small as it can be
    Shrink(shrink::Arguments),
    /// Turn a program into servo samples: time, laws, picture
    Plan(plan::Arguments),
    /// Hold recorded servo samples of any controller to the laws of motion
    Judge(judge::Arguments),
    /// Tell which option of each choice, and which quirk, a controller shows
    Fingerprint(fingerprint::Arguments),
    /// Work with reports that were written before: merge those of shards
    #[command(subcommand)]
    Report(report::Reports),
    /// List the rules: sentences, sources, cases; check or bless the suite
    Rules(rules::Arguments),
    /// Take the suite to a control that cannot host a process, on paper: export it, fill it in
    #[command(subcommand)]
    Suite(suite::Offline),
    /// Connect a controller: a template, a check, the words and schemas of the protocol
    #[command(subcommand)]
    Adapter(adapter::Adapter),
    /// Speak the adapter protocol for a controller, on standard input and output
    Serve(serve::Arguments),
    /// Print the JSON schema of a scenario, an outcome or a report
    Schema(schema::Arguments),
}

/// Whether these words, without the name of the command, are a call of it: scripts are held to that.
///
/// # Errors
/// They are none, and why.
pub fn understands(words: &[String]) -> Result<(), String> {
    let words = std::iter::once("gaugeblock").chain(words.iter().map(String::as_str));
    match Call::try_parse_from(words) {
        Err(error) if error.use_stderr() => Err(error.to_string()),
        Ok(_) | Err(_) => Ok(()),
    }
}

/// Runs the command line and tells the exit status.
pub fn main() -> ExitCode {
    let done = match Call::try_parse() {
        Ok(call) => execute(&call),
        Err(error) if error.use_stderr() => {
            let _closed_pipe = error.print();
            Ok(2)
        }
        Err(help) => {
            streams::write_help(&help);
            Ok(0)
        }
    };
    match done.and_then(|status| streams::written().map(|()| status)) {
        Ok(status) => ExitCode::from(status),
        Err(refused) => {
            let bold = anstyle::AnsiColor::Red.on_default().bold();
            write_error_in_colours(&format!("{bold}error{bold:#}: {}", inert(&refused.message)));
            if let Some(hint) = refused.hint {
                write_error(&format!("hint: {hint}"));
            }
            ExitCode::from(refused.status)
        }
    }
}

/// Does what is called for; the exit status.
fn execute(call: &Call) -> Result<u8, Refused> {
    match &call.command {
        Command::Certify(arguments) => {
            suite(call).and_then(|suite| certify::certify(arguments, &suite))
        }
        Command::Run(arguments) => suite(call).and_then(|suite| run::run(arguments, &suite)),
        Command::Rs274(arguments) => rs274::rs274(arguments),
        Command::Compare(arguments) => {
            suite(call).and_then(|suite| compare::compare(arguments, &suite))
        }
        Command::Fuzz(arguments) => suite(call).and_then(|suite| fuzz::fuzz(arguments, &suite)),
        Command::FuzzMotion(arguments) => {
            suite(call).and_then(|suite| fuzz_motion::fuzz_motion(arguments, &suite))
        }
        Command::Shrink(arguments) => {
            suite(call).and_then(|suite| shrink::shrink(arguments, &suite))
        }
        Command::Plan(arguments) => {
            suite(call).and_then(|suite| plan::plan_program(arguments, &suite))
        }
        Command::Judge(arguments) => {
            suite(call).and_then(|suite| judge::judge_samples(arguments, &suite))
        }
        Command::Fingerprint(arguments) => {
            suite(call).and_then(|suite| fingerprint::fingerprint(arguments, &suite))
        }
        Command::Report(command) => suite(call).and_then(|suite| report::report(command, &suite)),
        Command::Rules(arguments) => rules::rules(arguments, call.suite.as_deref()),
        Command::Suite(command) => suite(call).and_then(|suite| suite::offline(command, &suite)),
        Command::Adapter(arguments) => adapter::adapter(arguments, || suite(call)),
        Command::Serve(arguments) => serve::serve(arguments),
        Command::Schema(arguments) => schema::schema(arguments),
    }
}

fn suite(call: &Call) -> Result<Suite, Refused> {
    read_suite(call.suite.as_deref())
}

fn read_suite(folder: Option<&std::path::Path>) -> Result<Suite, Refused> {
    let files = match folder {
        Some(folder) => files::of_folder(folder).map_err(|error| {
            Refused::wrong(error, "--suite takes a folder like conformance/suite; leave it out for the suite built in")
        })?,
        None => gaugeblock_embedded_suite::files().map_err(|error| {
            Refused::wrong(error, "--suite takes a folder like conformance/suite")
        })?,
    };
    Suite::read(&files).map_err(|errors| {
        let count = errors.len();
        let shown: Vec<_> = errors.into_iter().take(20).collect();
        let more = if count > shown.len() {
            format!("\n… {} more", count - shown.len())
        } else {
            String::new()
        };
        Refused::wrong(
            format!("the suite is not in its form, {count} times:\n{}{more}", shown.join("\n")),
            "the form of a page is described in the suite's README.md",
        )
    })
}

/// The edition of an id.
fn edition<'a>(suite: &'a Suite, id: &str) -> Result<&'a Edition, Refused> {
    suite.edition(id).ok_or_else(|| {
        let known: Vec<_> = suite.editions.iter().map(|edition| edition.id.as_str()).collect();
        Refused::wrong(
            format!("there is no edition `{id}`"),
            format!("one of: {}", known.join(", ")),
        )
    })
}

/// Options of an edition with `id=option` changes on top.
fn options_with(
    suite: &Suite,
    edition: &Edition,
    changes: &[String],
) -> Result<gaugeblock_vocabulary::Options, Refused> {
    let mut options = suite.options(edition);
    for change in changes {
        let (id, option) = change.split_once('=').ok_or_else(|| {
            Refused::wrong(
                format!("`{change}` is not CHOICE=OPTION"),
                "as in --option saved-state.motion-mode=restored",
            )
        })?;
        let choice = suite.choices.iter().find(|choice| choice.id == id).ok_or_else(|| {
            Refused::wrong(
                format!("there is no choice or quirk `{id}`"),
                "`gaugeblock rules --choices` lists them",
            )
        })?;
        if !choice.options.iter().any(|known| known.name == option) {
            let known: Vec<_> = choice.options.iter().map(|known| known.name.as_str()).collect();
            return Err(Refused::wrong(
                format!("`{id}` has no option `{option}`"),
                format!("one of: {}", known.join(", ")),
            ));
        }
        options.0.insert(id.to_owned(), option.to_owned());
    }
    Ok(options)
}

/// How many runs at once: the processors, unless it is said.
fn jobs(asked: Option<std::num::NonZero<usize>>) -> std::num::NonZero<usize> {
    let processors = std::thread::available_parallelism();
    // One more than there are processors: while a controller starts or ends, a processor would have nothing to do.
    let one_more = processors.ok().map(|processors| processors.saturating_add(1));
    asked.or(one_more).unwrap_or(std::num::NonZero::<usize>::MIN)
}
