//! `gaugeblock certify`.

use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::{Args, ValueEnum};
use gaugeblock_adapter::Adapter;
use gaugeblock_adapter::exec::Limits;
use gaugeblock_compare::Capabilities;
use gaugeblock_suite::{Suite, options_of};

use super::against::Against;
use super::{Format, Refused, controller, place, write_out, write_out_in_colours};
use crate::certify::{CaseResult, Course, Plan, Run, Twice, cases, certify_in};
use crate::expectations::Expectations;
use crate::fingerprint::traits;
use crate::journal::{self, Journal};
use crate::report::cost::{self, Cost};
use crate::report::stored::JournalCase;
use crate::report::{Header, Report, html, json, junit, markdown, profiles, terminal};
use crate::shard::Shard;

const EXAMPLES: &str = "Examples:
  gaugeblock certify
      hold the interpreter of this project to the manual of its edition: about a second
  gaugeblock certify rs274
      hold LinuxCNC's interpreter to its own manual: each deviating rule, with its program
  gaugeblock certify rs274 --expectations conformance/expectations/rs274-2.9.toml
      only what is new or has changed
  gaugeblock certify rs274 --edition rs274-2.9-observed --report out
      hold it to what is known of it; write out/report.html, report.json, junit.xml, report.txt, summary.md
  gaugeblock certify rs274 --baseline main/report.json --waivers waivers.toml --report now
      in a pull request: only what is new or has changed, but for what somebody answers for until a day
  gaugeblock certify linuxcnc --shard 3/8 --report shard-3
      one of eight machines; after a kill: the same call with --resume
  gaugeblock certify rs274 --profile modal-save --profile subroutines
      fail unless it passes every rule of these profiles
  gaugeblock certify linuxcnc --only outputs --only inputs
      hold LinuxCNC's whole controller, with a simulated machine, to two chapters of its manual
  gaugeblock certify \"exec:python3 adapter.py\" --profile modal-save
      hold a controller behind an adapter (`gaugeblock adapter --help`)
  gaugeblock certify rs274 --as offline:campaign
      hold it to no more than those sheets of paper tell, so that the verdicts of both can be compared
  gaugeblock certify reference --edition m70-draft --only saved-state
      hold the specification to one chapter of an edition

Exit status: 0 where at least one case is judged, and each that is comes to what the documents say, or to what is known or waived; 1 where one
does not, or a claimed profile is not passed; 2 for a wrong call; 3 where a case could not be judged, or all that was asked is unsupported: of a
controller of which nothing was judged nothing is certified.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The controller under test
    #[arg(value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    controller: String,
    /// Hold it to no more than this other controller declares: to compare the two case by case
    #[arg(long = "as", value_name = "CONTROLLER")]
    like: Option<String>,
    /// The edition of the documents that it is held to [default: its own]
    #[arg(long, value_name = "EDITION")]
    edition: Option<String>,
    /// Only rules whose id begins so, such as `saved-state` or `feed.zero`; may be repeated
    #[arg(long, value_name = "PREFIX")]
    only: Vec<String>,
    /// A profile that is claimed: an unsupported or unjudged rule of it fails, too; may be repeated
    #[arg(long, value_name = "PROFILE")]
    profile: Vec<String>,
    #[command(flatten)]
    against: Against,
    /// Write what it does otherwise as a file of expectations, to be read before it is used
    #[arg(long, value_name = "FILE")]
    write_expectations: Option<PathBuf>,
    /// Write report.html, report.json, junit.xml, report.txt, summary.md (for a pull request) and cost.json into this
    /// folder, and a journal while it runs
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// Go on with the journal in the folder of --report
    #[arg(long, requires = "report")]
    resume: bool,
    /// A part: I of N, from 1; together the parts run every case once, and `gaugeblock report merge` makes one report
    /// of theirs
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    shard: Shard,
    /// What to print
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// How many cases of a hundred are run twice, to see that they come to the same
    #[arg(long, value_name = "PERCENT", default_value_t = 1, value_parser = clap::value_parser!(u8).range(0..=100))]
    twice: u8,
    /// Look for the smallest program of each divergence that no quirk explains, trying so many [default: 300]
    #[arg(long, value_name = "ATTEMPTS", num_args = 0..=1, default_value_t = 0, default_missing_value = "300")]
    shrink: u32,
    /// What the report says of each choice and quirk that the controller shows [default: where time is virtual and
    /// there is a report]
    #[arg(long, value_name = "WHEN", value_enum)]
    fingerprint: Option<When>,
    /// Run each program also unobserved, to see that observing changes nothing [default: a sample]
    #[arg(long)]
    check_observation: bool,
    /// Seconds that a controller behind an adapter has for an answer
    #[arg(long, value_name = "SECONDS", default_value_t = 10)]
    time_limit: u64,
    /// How many cases run at once [default: one more than there are processors]
    #[arg(long, short, value_name = "N")]
    jobs: Option<NonZero<usize>>,
    /// Show known divergences too, and count what was not shown
    #[arg(long, short)]
    verbose: bool,
}

/// Whether something is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum When {
    /// It is
    Always,
    /// It is not
    Never,
}

pub(super) fn certify(arguments: &Arguments, suite: &Suite) -> Result<u8, Refused> {
    if let Some(edition) = &arguments.edition {
        super::edition(suite, edition)?;
    }
    known_profiles(&arguments.profile, suite)?;
    let known = arguments.against.read()?;
    if let Some(folder) = &arguments.report {
        place::folder(folder)?;
    }
    let time = Duration::from_secs(arguments.time_limit);
    let limits = Limits { time, start: time, ..Limits::default() };
    let mut controller =
        controller::controller_within(&arguments.controller, limits, suite.defaults())?;
    if let Some(like) = &arguments.like {
        controller = controller::narrowed(controller, like)?;
    }
    let own = controller::own_edition(controller.as_ref());
    let edition = super::edition(suite, arguments.edition.as_deref().unwrap_or(own))?;
    controller::observed(controller.as_ref(), suite)?;
    controller::belongs(controller.as_ref(), suite, edition)?;
    controller::declared_options(controller.as_ref(), suite)?;
    controller::honours(controller.as_ref(), &suite.options(edition))?;
    controller::speaks(controller.as_ref(), edition)?;
    if arguments.check_observation {
        controller.check_observation();
    }
    let jobs = super::jobs(arguments.jobs.or(controller.best_jobs()));
    let plan = Plan { suite, edition, only: &arguments.only, jobs };
    let shard = arguments.shard;
    let laws = controller.has_laws_of_motion();
    let is_unknown =
        |only: &&String| !suite.rules.iter().any(|rule| rule.id.starts_with(only.as_str()));
    if let Some(only) = arguments.only.iter().find(is_unknown) {
        return Err(Refused::wrong(
            format!("no rule begins with `{only}`"),
            "`gaugeblock rules` lists the rules' ids",
        ));
    }
    if cases(plan, laws, Shard::WHOLE).is_empty() {
        return Err(Refused::wrong(
            "no case is selected",
            "`gaugeblock rules` lists the rules' ids",
        ));
    }
    let twice = arguments.twice;
    let header = Header { twice, ..Header::of(plan, controller.as_ref(), shard) };
    let newer = known.fits(&header, suite)?;
    let mut run = run_with_journal(arguments, plan, controller.as_ref(), &header)?;
    if is_fingerprinted(arguments, controller.as_ref()) {
        let options = options_of(suite, edition, &controller.options());
        let environment = edition.environment.as_deref();
        run.fingerprint = Some(traits(suite, &options, environment, controller.as_ref()));
    }
    let whole = arguments.only.is_empty() && shard == Shard::WHOLE;
    let (troubles, mended) = known.hold(&mut run, whole);
    let mut notes = controller.notes();
    notes.extend(newer);
    notes.extend(mended);
    // What a profile comes to is known of the whole alone.
    let claimed = if shard == Shard::WHOLE { arguments.profile.as_slice() } else { &[] };
    let profiles = profiles::profiles(suite, &run, claimed);
    if let Some(file) = &arguments.write_expectations {
        write_expectations(file, &run, controller.capabilities())?;
    }
    let report = Report { run: &run, header, notes, profiles, troubles };
    if let Some(folder) = &arguments.report {
        write_report(folder, &report)?;
        // What it was for is in the report.
        let _gone = std::fs::remove_file(folder.join(journal::FILE));
    }
    print(&report, arguments.format, arguments.verbose);
    Ok(report.exit_status())
}

/// A controller in real time may need minutes for it, another one a second at most.
fn is_fingerprinted(arguments: &Arguments, controller: &dyn Adapter) -> bool {
    match arguments.fingerprint {
        Some(when) => when == When::Always,
        None => arguments.report.is_some() && controller.capabilities().pin_period <= 0.0,
    }
}

/// Refuses a profile that there is not.
pub(super) fn known_profiles(profiles: &[String], suite: &Suite) -> Result<(), Refused> {
    match profiles.iter().find(|id| suite.profile(id).is_none()) {
        None => Ok(()),
        Some(unknown) => {
            let known: Vec<_> = suite.profiles.iter().map(|profile| profile.id.as_str()).collect();
            Err(Refused::wrong(
                format!("there is no profile `{unknown}`"),
                format!("one of: {}", known.join(", ")),
            ))
        }
    }
}

pub(super) fn print(report: &Report<'_>, format: Format, verbose: bool) {
    match format {
        Format::Text => write_out_in_colours(&terminal::terminal(report, verbose)),
        Format::Json => write_out(&format!("{:#}\n", json::json(report))),
    }
}

/// Runs what is left of a plan. Where there is a folder for reports each case is written down there when it is done.
fn run_with_journal<'a>(
    arguments: &Arguments,
    plan: Plan<'a>,
    controller: &dyn Adapter,
    header: &Header,
) -> Result<Run<'a>, Refused> {
    let shard = header.shard;
    let (mut journal, done) = match &arguments.report {
        Some(folder) => {
            let (journal, done) = begun(folder, header, arguments.resume, plan.suite)?;
            (Some(journal), done)
        }
        None => (None, Vec::new()),
    };
    let bar = progress(cases(plan, header.laws, shard).len());
    bar.inc(u64::try_from(done.len()).unwrap_or_default());
    let mut trouble = None;
    let mut each = |result: &CaseResult<'_>| {
        bar.inc(1);
        if let Some(Err(why)) =
            journal.as_mut().map(|journal| journal.done(&JournalCase::of(result)))
        {
            trouble.get_or_insert(why);
        }
    };
    let twice = Twice(header.twice);
    let course = Course { shard, done, twice, shrink: arguments.shrink, each: &mut each };
    let run = certify_in(plan, controller, course);
    bar.finish_and_clear();
    match trouble {
        Some(why) => Err(Refused::unfinished(format!("the journal: {why}"), "is the disk full?")),
        None => Ok(run),
    }
}

/// The journal of a run in a folder, and what was run before.
fn begun<'a>(
    folder: &Path,
    header: &Header,
    resume: bool,
    suite: &'a Suite,
) -> Result<(Journal, Vec<CaseResult<'a>>), Refused> {
    let mut done = Vec::new();
    let journal = Journal::open(folder, header, resume, &mut |case: JournalCase| done.push(case));
    let journal = journal.map_err(|why| {
        Refused::wrong(
            why,
            "--resume goes on with a run that was broken off; or name another folder",
        )
    })?;
    let done = done.iter().map(|case| case.result(suite)).collect::<Result<Vec<_>, _>>();
    let done = done.map_err(|why| Refused::wrong(why, "the journal is of another suite"))?;
    Ok((journal, done))
}

/// A bar on a terminal, nothing in a pipe.
pub(super) fn progress(cases: usize) -> indicatif::ProgressBar {
    let cases = u64::try_from(cases).unwrap_or(u64::MAX);
    let style = indicatif::ProgressStyle::with_template("{bar:32} {pos}/{len} cases, {elapsed}");
    let bar = indicatif::ProgressBar::new(cases);
    match style {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

fn write_expectations(file: &Path, run: &Run<'_>, shows: &Capabilities) -> Result<(), Refused> {
    let text = Expectations::of(run, &shows.name, &shows.version)
        .to_text()
        .map_err(|error| Refused::unfinished(error, "this is a fault of gaugeblock"))?;
    place::write_whole(file, &text)
}

pub(super) fn write_report(folder: &Path, report: &Report<'_>) -> Result<(), Refused> {
    let xml = junit::junit(report)
        .map_err(|error| Refused::unfinished(error, "this is a fault of gaugeblock"))?;
    let page = html::html(report)
        .map_err(|error| Refused::unfinished(error, "this is a fault of gaugeblock"))?;
    let text = anstream::adapter::strip_str(&terminal::terminal(report, true)).to_string();
    place::write_whole(&folder.join("report.json"), format!("{:#}\n", json::json(report)))?;
    place::write_whole(&folder.join("report.html"), &page)?;
    place::write_whole(&folder.join(cost::FILE), Cost::of(report.run).to_text())?;
    place::write_whole(&folder.join("junit.xml"), &xml)?;
    place::write_whole(&folder.join("report.txt"), &text)?;
    place::write_whole(&folder.join("summary.md"), markdown::markdown(report))
}
