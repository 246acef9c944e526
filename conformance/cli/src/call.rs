//! A call of the command: what it may say, and what it does.

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{CommandFactory as _, Parser, Subcommand};
use gaugeblock_report::escape_text;
use gaugeblock_suite::Suite;

use crate::command::{
    adapter, book, certificate, certify, compare, explain, fingerprint, fuzz, manual, measure,
    motion_check, motion_fuzz, offline, plan, report, rs274, rules, run, schema, serve, shrink,
    suite,
};
use crate::documents::read_suite;
use crate::error::CliError;
use crate::signals;
use crate::streams::{self, write_error, write_error_in_colours};

/// The exit statuses, for the help.
const EXIT: &str = "Exit status:
  0  every judged case passes or is a known divergence
  1  a divergence, a stale expectation, or a known divergence that changed
  2  wrong call or wrong input
  3  could not finish: controller missing or of an unknown version, crash, timeout,
     nondeterministic or inconclusive result, or nothing could be judged";

/// Checks CNC controllers against the documents of their language, rule by rule.
#[derive(Debug, Parser)]
#[command(name = "gaugeblock", version, after_help = EXIT, arg_required_else_help = true, max_term_width = 110)]
struct Call {
    /// Read the suite from this folder instead of the built-in one
    #[arg(long, global = true, value_name = "DIR")]
    suite: Option<PathBuf>,
    #[command(flatten)]
    colour: colorchoice_clap::Color,
    #[command(subcommand)]
    command: Command,
}

/// Check motion against the motion rules
#[derive(Debug, Subcommand)]
enum Motion {
    /// Check recorded servo samples of any controller against the motion rules
    Check(motion_check::Arguments),
    /// Plan generated programs; minimise each program that breaks a motion rule
    Fuzz(motion_fuzz::Arguments),
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run the suite on a controller and print a verdict per rule
    Certify(certify::Arguments),
    /// Check a certificate: its signature, its completeness, and a share of its verdicts
    VerifyCertificate(certificate::Arguments),
    /// Run a program and print its effects, settings and states
    Run(run::Arguments),
    /// Print a program's canonical calls in the format of LinuxCNC's rs274
    Rs274(rs274::Arguments),
    /// List the differences between two controllers on programs
    Compare(compare::Arguments),
    /// Compare two controllers on generated programs; minimise each divergence
    Fuzz(fuzz::Arguments),
    /// Minimise a program on which two controllers differ
    Shrink(shrink::Arguments),
    /// Plan a program's motion: servo samples, time, motion rules, picture
    Plan(plan::Arguments),
    /// Check recorded servo samples, or fuzz the planner, against the motion rules
    #[command(subcommand)]
    Motion(Motion),
    /// Detect the option of each choice, and the quirks, of a controller
    Fingerprint(fingerprint::Arguments),
    /// Measure a controller's limits: tolerances, depths, lengths, resolution, rounding of corners
    Measure(measure::Arguments),
    /// Merge the reports of shards
    #[command(subcommand)]
    Report(report::Reports),
    /// List the rules with their sentences
    Rules(rules::Arguments),
    /// List the choices and quirks with their options
    Choices(rules::ChoiceArguments),
    /// Explain a rule, a choice, a quirk, or a code such as M73
    Explain(explain::Arguments),
    /// Write the rules as a site: by rule, code, document, choice and edition, with the guide
    Book(book::Arguments),
    /// Maintain the suite: check it, bless goldens, list what became of each document
    #[command(subcommand)]
    Suite(suite::Maintenance),
    /// Test a control that cannot host a process: export programs and answer sheets
    #[command(subcommand)]
    Offline(offline::Offline),
    /// Write an adapter for a controller: template, self-check, protocol
    #[command(subcommand)]
    Adapter(adapter::Adapter),
    /// Serve a controller of this project over the adapter protocol
    Serve(serve::Arguments),
    /// Print the JSON schema of a scenario, an outcome, a report or a certificate
    Schema(schema::Arguments),
    /// Print the script with which a shell completes calls
    Completions(manual::Completions),
    /// Write the manual pages of all commands
    Man(manual::Manual),
}

/// Checks that these arguments are a valid call; tests check the calls in scripts and pages with it.
///
/// # Errors
/// The message that the command line would print.
pub fn understands(words: &[String]) -> Result<(), String> {
    let words = std::iter::once("gaugeblock").chain(words.iter().map(String::as_str));
    match Call::try_parse_from(words) {
        Err(error) if error.use_stderr() => Err(error.to_string()),
        Ok(_) | Err(_) => Ok(()),
    }
}

/// Runs the command line and returns the exit status.
pub fn main() -> ExitCode {
    let done = match Call::try_parse_from(plain_help(std::env::args_os().collect())) {
        Ok(call) => {
            call.colour.write_global();
            let watched = signals::watch().map_err(|error| {
                CliError::failure(format!("signals: {error}"), "may another thread be started?")
            });
            watched.and_then(|()| execute(&call))
        }
        Err(error) if error.use_stderr() => {
            let _closed_pipe = error.print();
            Ok(2)
        }
        Err(help) => {
            streams::write_help(&help);
            Ok(0)
        }
    };
    match done.and_then(|status| streams::check_written().map(|()| status)) {
        Ok(status) => ExitCode::from(status),
        Err(refused) => {
            let bold = anstyle::AnsiColor::Red.on_default().bold();
            write_error_in_colours(&format!(
                "{bold}error{bold:#}: {}",
                escape_text(&refused.message)
            ));
            if let Some(hint) = refused.hint {
                write_error(&format!("hint: {hint}"));
            }
            ExitCode::from(refused.status)
        }
    }
}

/// The words of a call, in which `help --help` is `--help`: clap's own `help` takes no option.
fn plain_help(mut words: Vec<OsString>) -> Vec<OsString> {
    let is_help = |word: Option<&OsString>, names: &[&str]| {
        word.is_some_and(|word| names.iter().any(|name| word == name))
    };
    if words.len() == 3
        && is_help(words.get(1), &["help"])
        && is_help(words.get(2), &["-h", "--help"])
    {
        words.remove(1);
    }
    words
}

/// Runs the command and returns the exit status.
fn execute(call: &Call) -> Result<u8, CliError> {
    match &call.command {
        Command::Certify(arguments) => {
            suite(call).and_then(|suite| certify::certify(arguments, &suite))
        }
        Command::VerifyCertificate(arguments) => {
            suite(call).and_then(|suite| certificate::verify(arguments, &suite))
        }
        Command::Run(arguments) => suite(call).and_then(|suite| run::run(arguments, &suite)),
        Command::Rs274(arguments) => rs274::rs274(arguments),
        Command::Compare(arguments) => {
            suite(call).and_then(|suite| compare::compare(arguments, &suite))
        }
        Command::Fuzz(arguments) => suite(call).and_then(|suite| fuzz::fuzz(arguments, &suite)),
        Command::Shrink(arguments) => {
            suite(call).and_then(|suite| shrink::shrink(arguments, &suite))
        }
        Command::Plan(arguments) => {
            suite(call).and_then(|suite| plan::plan_program(arguments, &suite))
        }
        Command::Motion(Motion::Check(arguments)) => {
            suite(call).and_then(|suite| motion_check::check_samples(arguments, &suite))
        }
        Command::Motion(Motion::Fuzz(arguments)) => {
            suite(call).and_then(|suite| motion_fuzz::fuzz_motion(arguments, &suite))
        }
        Command::Fingerprint(arguments) => {
            suite(call).and_then(|suite| fingerprint::fingerprint(arguments, &suite))
        }
        Command::Measure(arguments) => {
            suite(call).and_then(|suite| measure::measure(arguments, &suite))
        }
        Command::Report(command) => suite(call).and_then(|suite| report::report(command, &suite)),
        Command::Rules(arguments) => suite(call).and_then(|suite| rules::rules(arguments, &suite)),
        Command::Choices(arguments) => {
            suite(call).and_then(|suite| rules::choices(arguments, &suite))
        }
        Command::Explain(arguments) => {
            suite(call).and_then(|suite| explain::explain(arguments, &suite))
        }
        Command::Book(arguments) => {
            suite(call).and_then(|suite| book::book(arguments, &suite, call.suite.as_deref()))
        }
        Command::Suite(command) => suite::maintain(command, call.suite.as_deref()),
        Command::Offline(command) => {
            suite(call).and_then(|suite| offline::offline(command, &suite))
        }
        Command::Adapter(arguments) => adapter::adapter(arguments, || suite(call)),
        Command::Serve(arguments) => serve::serve(arguments),
        Command::Schema(arguments) => schema::schema(arguments),
        Command::Completions(arguments) => Ok(manual::completions(arguments, Call::command())),
        Command::Man(arguments) => manual::manual(arguments, Call::command()),
    }
}

fn suite(call: &Call) -> Result<Suite, CliError> {
    read_suite(call.suite.as_deref())
}

#[cfg(test)]
mod tests {
    use clap::{Command, CommandFactory as _};

    use super::{Call, plain_help};

    /// The width at which clap wraps help that is not printed on a terminal.
    const WIDTH: usize = 100;

    #[test]
    fn footer_of_every_help_fits_the_width_at_which_clap_wraps() {
        fn check(command: &Command) {
            let footer = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            for line in footer.lines() {
                assert!(line.chars().count() <= WIDTH, "{}: {line}", command.get_name());
            }
            command.get_subcommands().for_each(check);
        }
        check(&Call::command());
    }

    #[test]
    fn help_of_every_command_has_its_exit_statuses() {
        fn check(command: &Command) {
            let is_leaf = command.get_subcommands().next().is_none();
            let footer = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            let has_status = footer.contains("\nExit status:");
            assert!(has_status || !is_leaf, "{}: {footer}", command.get_name());
            command.get_subcommands().for_each(check);
        }
        check(&Call::command());
    }

    #[test]
    fn help_of_help_is_the_help() {
        let words = |text: &str| text.split(' ').map(Into::into).collect::<Vec<_>>();
        assert_eq!(plain_help(words("gaugeblock help --help")), words("gaugeblock --help"));
        assert_eq!(plain_help(words("gaugeblock help -h")), words("gaugeblock -h"));
        assert_eq!(plain_help(words("gaugeblock help run")), words("gaugeblock help run"));
    }
}
