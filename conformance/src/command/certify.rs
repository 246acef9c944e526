//! `gaugeblock certify`.

use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;

use super::{Format, Refused, controller, place, write_out};
use crate::adapters::exec::Limits;
use crate::adapters::{Adapter, Capabilities};
use crate::certify::{CaseResult, Course, Plan, Run, cases, certify_in};
use crate::expectations::Expectations;
use crate::journal::{self, Journal};
use crate::report::stored::StoredCase;
use crate::report::{Header, Report, html, json, junit, profiles, terminal};
use crate::shard::Shard;
use crate::suite::Suite;
use crate::waivers::{Day, Waivers};

const EXAMPLES: &str = "Examples:
  gaugeblock certify
      hold the interpreter of this project to the manual of its edition: about a second
  gaugeblock certify rs274
      hold LinuxCNC's interpreter to its own manual: each deviating rule, with its program
  gaugeblock certify rs274 --expectations conformance/expectations/rs274-2.9.toml
      only what is new or has changed
  gaugeblock certify rs274 --edition rs274-2.9-observed --report out
      hold it to what is known of it; write out/report.html, report.json, junit.xml, report.txt
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
  gaugeblock certify rs274 --as \"exec:python3 rs274.py\"
      hold it to no more than that adapter declares, so that the verdicts of both can be compared
  gaugeblock certify reference --edition m70-draft --only saved-state
      hold the specification to one chapter of an edition";

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
    /// What the controller is known to do otherwise; anything else fails
    #[arg(long, value_name = "FILE")]
    expectations: Option<PathBuf>,
    /// An earlier report: only divergences that are new or have changed since fail
    #[arg(long, value_name = "REPORT", conflicts_with = "expectations")]
    baseline: Option<PathBuf>,
    /// Divergences that somebody answers for until a day: rule, case, reason, owner, expires (TOML)
    #[arg(long, value_name = "FILE")]
    waivers: Option<PathBuf>,
    /// The day on which waivers are held to be [default: today]
    #[arg(long, value_name = "YYYY-MM-DD")]
    today: Option<Day>,
    /// Write what it does otherwise as a file of expectations, to be read before it is used
    #[arg(long, value_name = "FILE")]
    write_expectations: Option<PathBuf>,
    /// Write report.html, report.json, junit.xml and report.txt into this folder, and a journal while it runs
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// Go on with the journal in the folder of --report
    #[arg(long, requires = "report")]
    resume: bool,
    /// A part: I of N, from 1; together the parts run every case once, and `gaugeblock report merge` makes one report of theirs
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    shard: Shard,
    /// What to print
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
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

pub(super) fn certify(arguments: &Arguments, suite: &Suite) -> Result<u8, Refused> {
    if let Some(edition) = &arguments.edition {
        super::edition(suite, edition)?;
    }
    known_profiles(&arguments.profile, suite)?;
    let expectations = arguments.expectations.as_deref().map(read).transpose()?;
    let baseline = arguments.baseline.as_deref().map(super::report::stored).transpose()?;
    let baseline = baseline.map(|(_, stored)| stored);
    let waivers = arguments.waivers.as_deref().map(read_waivers).transpose()?;
    if let Some(folder) = &arguments.report {
        place::folder(folder)?;
    }
    let mut controller: Box<dyn Adapter> = match arguments.controller.strip_prefix("exec:") {
        Some(command) => {
            let time = Duration::from_secs(arguments.time_limit);
            Box::new(controller::exec(command, Limits { time, ..Limits::default() })?)
        }
        None => controller::controller(&arguments.controller)?,
    };
    if let Some(like) = &arguments.like {
        controller = controller::narrowed(controller, like)?;
    }
    let own = controller.own_edition().unwrap_or(controller::own_edition(&arguments.controller));
    let edition = super::edition(suite, arguments.edition.as_deref().unwrap_or(own))?;
    controller::belongs(controller.as_ref(), suite, edition)?;
    controller::declared_options(controller.as_ref(), suite)?;
    controller::honours(controller.as_ref(), &suite.options(edition))?;
    controller::speaks(controller.as_ref(), edition)?;
    if arguments.check_observation {
        controller.check_observation();
    }
    if let Some(expectations) = &expectations {
        let shows = controller.capabilities();
        fits(expectations, (&shows.name, &shows.version), &edition.id)?;
    }
    let jobs = super::jobs(arguments.jobs.or(controller.best_jobs()));
    let plan = Plan { suite, edition, only: &arguments.only, jobs };
    let shard = arguments.shard;
    let laws = controller.has_laws_of_motion();
    if cases(plan, laws, Shard::WHOLE).is_empty() {
        return Err(Refused::wrong(
            "no case is selected",
            "`gaugeblock rules` lists the rules' ids",
        ));
    }
    let header = Header::of(plan, controller.as_ref(), shard);
    let run = run_with_journal(arguments, plan, controller.as_ref(), &header)?;
    let whole = arguments.only.is_empty() && shard == Shard::WHOLE;
    let mut notes = controller.notes();
    let mut troubles = expectations.map(|expectations| expectations.hold(&run, whole));
    if let Some(baseline) = baseline {
        let (new, mended) = baseline.hold(&run);
        troubles = Some(new);
        notes.extend(mended);
    }
    if let Some(waivers) = waivers {
        let today = arguments.today.unwrap_or_else(today);
        let (left, waived) = waivers.hold(&run, troubles, today);
        troubles = Some(left);
        notes.extend(waived);
    }
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
        Format::Text => write_out(&terminal::terminal(report, verbose)),
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
            journal.as_mut().map(|journal| journal.done(&StoredCase::of(result)))
        {
            trouble.get_or_insert(why);
        }
    };
    let run = certify_in(plan, controller, Course { shard, done, each: &mut each });
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
    let journal = Journal::open(folder, header, resume, &mut |case: StoredCase| done.push(case));
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

fn read_waivers(path: &Path) -> Result<Waivers, Refused> {
    let name = path.display();
    let hint = "[[waiver]] with rule, reason, owner, expires = \"2027-01-31\", and case for one of its cases";
    let text = std::fs::read_to_string(path)
        .map_err(|error| Refused::wrong(format!("{name}: {error}"), hint))?;
    Waivers::read(&text)
        .map_err(|error| Refused::wrong(format!("{name}: {}", error.trim_end()), hint))
}

#[expect(clippy::disallowed_methods, reason = "a waiver ends on a day of the calendar")]
fn today() -> Day {
    let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    Day::after_epoch(since.map_or(0, |since| since.as_secs() / 86_400))
}

pub(super) fn read(path: &Path) -> Result<Expectations, Refused> {
    let name = path.display();
    let text = std::fs::read_to_string(path).map_err(|error| {
        Refused::wrong(format!("{name}: {error}"), "--write-expectations makes such a file")
    })?;
    Expectations::read(&text).map_err(|error| {
        Refused::wrong(
            format!("{name}: {}", error.trim_end()),
            "--write-expectations makes such a file",
        )
    })
}

pub(super) fn fits(
    expectations: &Expectations,
    (name, version): (&str, &str),
    edition: &str,
) -> Result<(), Refused> {
    if expectations.controller != name || expectations.edition != edition {
        return Err(Refused::wrong(
            format!(
                "these expectations are of {} held to {}, not of {name} held to {edition}",
                expectations.controller, expectations.edition
            ),
            "name the expectations of this controller and edition",
        ));
    }
    if expectations.version != version {
        return Err(Refused::unfinished(
            format!(
                "these expectations are of version {}, the controller is of {version}",
                expectations.version
            ),
            "look at what the new version does, then --write-expectations",
        ));
    }
    Ok(())
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
    place::write_whole(&folder.join("junit.xml"), &xml)?;
    place::write_whole(&folder.join("report.txt"), &text)
}
