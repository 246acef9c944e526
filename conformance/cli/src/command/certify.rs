//! `gaugeblock certify`.

use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::{Args, ValueEnum};
use gaugeblock_adapter::Adapter;
use gaugeblock_adapter::exec::Limits;
use gaugeblock_compare::Capabilities;
use gaugeblock_report::cost::{self, Cost};
use gaugeblock_report::stored::JournalCase;
use gaugeblock_report::{Header, Report, html, json, junit, markdown, profiles, terminal};
use gaugeblock_runner::certify::{
    CaseResult, Plan, RepeatSampling, Run, RunOptions, Scope, cases, only_case, run_plan,
};
use gaugeblock_runner::expectations::Expectations;
use gaugeblock_runner::fingerprint::{fingerprint_entries, may_be_refused, shown_open_options};
use gaugeblock_runner::journal::{self, Journal};
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::{Edition, Rule, Suite, options_of};
use gaugeblock_vocabulary::Options;

use super::comparison::{ComparisonArguments, earlier_expectations};
use super::{controller, options, user_files};
use crate::arguments::Format;
use crate::error::CliError;
use crate::streams::{write_out, write_out_in_colours};

const EXAMPLES: &str = "Examples:
  gaugeblock certify
      certify the production interpreter: about a second
  gaugeblock certify --controller rs274
      certify LinuxCNC's stand-alone interpreter against its own manual
  gaugeblock certify --controller rs274 --expectations conformance/expectations/rs274-2.9.toml
      fail only on divergences that are new or changed
  gaugeblock certify --controller rs274 --edition rs274-2.9-observed --report out
      certify it against its recorded behaviour; write out/report.html and the other report files
  gaugeblock certify --controller rs274 --baseline main/report.json --waivers waivers.toml
      in a pull request: fail only on what is new or changed and not waived
  gaugeblock certify --controller linuxcnc --shard 3/8 --report shard-3
      run one of eight shards; after an interruption, repeat the call with --resume
  gaugeblock certify --controller rs274 --profile modal-save --profile subroutines
      fail unless every rule of these profiles passes
  gaugeblock certify --controller rs274 --only saved-state.feed --case \"with decimals\"
      run one case: a verdict prints its rule and its name as RULE / NAME
  gaugeblock certify --controller reference --assertions-only
      judge the model by the assertions that people wrote, without a comparison with itself
  gaugeblock certify --controller exec:./mill --options options.json
      compare under the options that `fingerprint --format json` wrote
  gaugeblock certify --controller linuxcnc --only outputs --only inputs
      certify the whole LinuxCNC controller, with a simulated machine, on two chapters
  gaugeblock certify --controller \"exec:python3 adapter.py\" --profile modal-save
      certify a controller through an adapter (`gaugeblock adapter --help`)
  gaugeblock certify --controller rs274 --restrict-to offline:campaign
      judge rs274 only on what these answer sheets report, so that both verdicts can be compared

Exit status: 0 at least one case was judged, and every judged case passes, is known or is waived;
1 a divergence, a stale expectation, or a claimed profile that is not passed; 2 wrong call or input;
3 a case could not be judged, or every selected case is unsupported.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The controller: reference, production, rs274, linuxcnc, exec:COMMAND, tcp:HOST:PORT or offline:DIR
    #[arg(long, short, value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    controller: String,
    /// Compare only the observables that this other controller also reports
    #[arg(long, value_name = "CONTROLLER")]
    restrict_to: Option<String>,
    /// Edition of the documents [default: the controller's own]
    #[arg(long, value_name = "EDITION")]
    edition: Option<String>,
    /// Run only rules whose id begins with this, such as `saved-state` or `feed.zero`; may be repeated
    #[arg(long, value_name = "PREFIX")]
    only: Vec<String>,
    /// Run only the case with exactly this name, of the rules of --only; may be repeated
    #[arg(long, value_name = "NAME", requires = "only")]
    case: Vec<String>,
    /// Claim this profile: its unsupported and unjudged rules fail too; may be repeated
    #[arg(long, value_name = "PROFILE")]
    profile: Vec<String>,
    /// Compare under the options of this file: the JSON output of `gaugeblock fingerprint`
    #[arg(long, value_name = "FILE")]
    options: Option<PathBuf>,
    /// Judge the assertions of each case, which people wrote, and nothing else: no comparison with the model's outcome
    #[arg(long, conflicts_with_all = ["profile", "write_expectations", "shrink"])]
    assertions_only: bool,
    #[command(flatten)]
    against: ComparisonArguments,
    /// Write the divergences as a file for --expectations, and keep the reasons that the file has; read it before you
    /// use it
    #[arg(long, value_name = "FILE")]
    write_expectations: Option<PathBuf>,
    /// Write report.html, report.json, junit.xml, report.txt, summary.md and cost.json into this folder; keep a journal
    /// there while the run lasts
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// Resume an interrupted run from the journal in --report
    #[arg(long, requires = "report")]
    resume: bool,
    /// Run part I of N, counted from 1; all parts together run every case once (`gaugeblock report merge`)
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    shard: Shard,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Percentage of cases that run a second time, to detect nondeterminism
    #[arg(long, value_name = "PERCENT", default_value_t = 1, value_parser = clap::value_parser!(u8).range(0..=100))]
    repeat_percent: u8,
    /// Minimise the program of each divergence that no quirk explains, with at most ATTEMPTS runs each [without a
    /// value: 300]
    #[arg(long, value_name = "ATTEMPTS", num_args = 0..=1, default_value_t = 0, default_missing_value = "300", hide_default_value = true)]
    shrink: u32,
    /// Whether to detect the option of each choice and quirk for the report [default: always with --report, unless the
    /// controller runs in real time]
    #[arg(long, value_name = "WHEN", value_enum)]
    fingerprint: Option<FingerprintWhen>,
    /// Run every program a second time without instrumentation, to check that it changes nothing [default: a sample]
    #[arg(long)]
    check_observation: bool,
    /// Time limit of an adapter's answer, seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..))]
    time_limit: u64,
    /// Number of cases that run at once [default: number of processors + 1]
    #[arg(long, short, value_name = "N")]
    jobs: Option<NonZero<usize>>,
    /// Also print known divergences, and how many values were not compared because the controller does not report them
    #[arg(long, short)]
    verbose: bool,
}

/// Whether the options of choices and quirks are detected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FingerprintWhen {
    /// Detect them, also on a controller in real time
    Always,
    /// Do not detect them
    Never,
}

pub(crate) fn certify(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    if let Some(edition) = &arguments.edition {
        crate::documents::edition(suite, edition)?;
    }
    known_profiles(&arguments.profile, suite)?;
    let known = arguments.against.read()?;
    let earlier = earlier_expectations(arguments.write_expectations.as_deref())?;
    if let Some(folder) = &arguments.report {
        user_files::create_folder(folder)?;
    }
    let time = Duration::from_secs(arguments.time_limit);
    let limits = Limits { time, start: time, ..Limits::default() };
    let mut controller =
        controller::controller_with_limits(&arguments.controller, limits, suite.defaults())?;
    if let Some(like) = &arguments.restrict_to {
        controller = controller::restricted(controller, like)?;
    }
    let own = controller::own_edition(controller.as_ref(), suite);
    let edition = crate::documents::edition(suite, arguments.edition.as_deref().unwrap_or(own))?;
    profiles_in_edition(&arguments.profile, suite, edition)?;
    controller::check_observed_edition(controller.as_ref(), suite)?;
    controller::check_exported_from(controller.as_ref(), suite, edition)?;
    controller::declared_options(controller.as_ref(), suite)?;
    controller::check_options(controller.as_ref(), &suite.options(edition))?;
    controller::check_language(controller.as_ref(), edition)?;
    if arguments.check_observation {
        controller.check_observation();
    }
    let jobs = crate::arguments::jobs(arguments.jobs.or(controller.best_jobs()));
    let only = only(arguments, suite)?;
    let scope = if arguments.assertions_only { Scope::AssertionsOnly } else { Scope::Full };
    let plan = Plan { suite, edition, only: &only, jobs, scope };
    let shard = arguments.shard;
    let laws = controller.has_laws_of_motion();
    if cases(plan, laws, Shard::WHOLE).is_empty() {
        return Err(CliError::usage(
            "no case is selected",
            "`gaugeblock rules` lists the rules; remove --only and --case, or choose another edition",
        ));
    }
    let twice = arguments.repeat_percent;
    let (options, undeclared) = comparison_options(arguments, suite, edition, controller.as_ref())?;
    let header = Header { twice, options, ..Header::of(plan, controller.as_ref(), shard) };
    let newer = known.check_header(&header, suite)?;
    let mut run = run_with_journal(arguments, plan, controller.as_ref(), &header)?;
    if is_fingerprinted(arguments, controller.as_ref()) {
        let options = options_of(suite, edition, &header.options);
        let environment = edition.environment.as_deref();
        run.fingerprint =
            Some(fingerprint_entries(suite, &options, environment, controller.as_ref()));
    }
    let whole = arguments.only.is_empty() && shard == Shard::WHOLE;
    let (mismatches, fixed) = known.compare(&mut run, whole);
    let mut notes = controller.notes();
    notes.extend(undeclared);
    notes.extend(newer);
    notes.extend(fixed);
    // Only a whole run can pass a profile.
    let claimed = if shard == Shard::WHOLE { arguments.profile.as_slice() } else { &[] };
    let profiles = profiles::profiles(suite, &run, claimed);
    if let Some(file) = &arguments.write_expectations {
        notes.extend(write_expectations(file, earlier, &run, controller.capabilities())?);
    }
    let report = Report { notes, profiles, mismatches, ..Report::of(suite, &run, header) };
    if let Some(folder) = &arguments.report {
        write_report(folder, &report)?;
        // The report has all that the journal had.
        let _gone = std::fs::remove_file(folder.join(journal::FILE));
    }
    print(&report, arguments.format, arguments.verbose);
    Ok(report.exit_status())
}

/// The options that differ from those of the edition: those of --options, those that the controller declares, and those
/// that it was observed to have for open choices, with a note for each of the last.
fn comparison_options(
    arguments: &Arguments,
    suite: &Suite,
    edition: &Edition,
    controller: &dyn Adapter,
) -> Result<(Options, Vec<String>), CliError> {
    let mut options = controller.options();
    if let Some(file) = &arguments.options {
        options::read_into(file, suite, &mut options)?;
    }
    let shown = shown_open_options(suite, edition, &options, controller);
    let never_refuses = !controller.capabilities().refuses;
    let note = |(id, option): (&String, &String)| {
        if never_refuses && may_be_refused(suite, id, option) {
            return format!(
                "has no option of `{id}` but to refuse, and never refuses: its cases are not judged"
            );
        }
        format!("looks like `{id} = {option}`, which the documents leave open: declare it")
    };
    let notes = shown.0.iter().map(note).collect();
    for (id, option) in shown.0.iter() {
        options.0.insert(id.clone(), option.clone());
    }
    Ok((options, notes))
}

/// What a plan runs: the rules of --only, or their cases of --case.
fn only(arguments: &Arguments, suite: &Suite) -> Result<Vec<String>, CliError> {
    known_rules(&arguments.only, suite)?;
    if arguments.case.is_empty() {
        return Ok(arguments.only.clone());
    }
    let wanted =
        |rule: &&Rule| arguments.only.iter().any(|only| rule.id.starts_with(only.as_str()));
    let rules: Vec<&Rule> = suite.rules.iter().filter(wanted).collect();
    let mut selected = Vec::new();
    for case in &arguments.case {
        let having = rules.iter().filter(|rule| rule.case_names().any(|name| name == case));
        let before = selected.len();
        selected.extend(having.map(|rule| only_case(&rule.id, case)));
        if selected.len() == before {
            return Err(unknown_case(case, &rules));
        }
    }
    Ok(selected)
}

/// An error that lists the names that are nearest to one that no case of these rules has.
fn unknown_case(case: &str, rules: &[&Rule]) -> CliError {
    const LISTED: usize = 5;
    let mut names: Vec<(usize, &str)> = rules
        .iter()
        .flat_map(|rule| rule.case_names())
        .map(|name| (strsim::damerau_levenshtein(name, case), name))
        .collect();
    names.sort_unstable();
    names.dedup();
    let close = |(distance, name): &&(usize, &str)| *distance <= 4 || name.contains(case);
    let near: Vec<_> = names.iter().filter(close).take(LISTED).map(|(_, name)| *name).collect();
    let hint = match (near.as_slice(), rules) {
        ([_, ..], _) => format!("did you mean `{}`?", near.join("`, `")),
        ([], [rule]) => format!("`gaugeblock explain {}` prints its cases", rule.id),
        ([], _) => "`gaugeblock explain RULE` prints the cases of a rule".to_owned(),
    };
    CliError::usage(format!("invalid `--case {case}`: no case of --only has this name"), hint)
}

/// A fingerprint takes minutes on a controller in real time, and a second at most on others.
fn is_fingerprinted(arguments: &Arguments, controller: &dyn Adapter) -> bool {
    match arguments.fingerprint {
        Some(when) => when == FingerprintWhen::Always,
        None => arguments.report.is_some() && controller.capabilities().pin_period <= 0.0,
    }
}

/// Refuses a prefix that no rule id has.
pub(crate) fn known_rules(only: &[String], suite: &Suite) -> Result<(), CliError> {
    let is_known = |only: &&String| suite.rules.iter().any(|rule| rule.id.starts_with(*only));
    match only.iter().find(|only| !is_known(only)) {
        None => Ok(()),
        Some(only) => Err(CliError::usage(
            format!("invalid `--only {only}`: no rule has an id that begins with it"),
            "`gaugeblock rules` lists the ids",
        )),
    }
}

/// Refuses an unknown profile.
pub(crate) fn known_profiles(profiles: &[String], suite: &Suite) -> Result<(), CliError> {
    match profiles.iter().find(|id| suite.profile(id).is_none()) {
        None => Ok(()),
        Some(unknown) => {
            let known: Vec<_> = suite.profiles.iter().map(|profile| profile.id.as_str()).collect();
            Err(CliError::usage(
                format!("unknown profile `{unknown}`"),
                format!("expected one of: {}", known.join(", ")),
            ))
        }
    }
}

/// Refuses a claimed profile of which no rule is in the edition: no result could pass or fail it.
fn profiles_in_edition(
    profiles: &[String],
    suite: &Suite,
    edition: &Edition,
) -> Result<(), CliError> {
    let is_absent = |id: &&String| {
        let mut rules = suite.rules.iter().filter(|rule| rule.profile == **id);
        !rules.any(|rule| profiles::is_in_edition(rule, edition))
    };
    match profiles.iter().find(is_absent) {
        None => Ok(()),
        Some(id) => Err(CliError::usage(
            format!("no rule of profile {id} is in edition {}", edition.id),
            "choose another edition with --edition, or remove --profile",
        )),
    }
}

pub(crate) fn print(report: &Report<'_>, format: Format, verbose: bool) {
    match format {
        Format::Text => write_out_in_colours(&terminal::terminal(report, verbose)),
        Format::Json => write_out(&format!("{:#}\n", json::json(report))),
    }
}

/// Runs the open cases of a plan. With a report folder, each finished case is written to its journal.
fn run_with_journal<'a>(
    arguments: &Arguments,
    plan: Plan<'a>,
    controller: &dyn Adapter,
    header: &Header,
) -> Result<Run<'a>, CliError> {
    let shard = header.shard;
    let (mut journal, done) = match &arguments.report {
        Some(folder) => {
            let (journal, done) = open_journal(folder, header, arguments.resume, plan.suite)?;
            (Some(journal), done)
        }
        None => (None, Vec::new()),
    };
    let bar = progress(cases(plan, header.laws, shard).len());
    bar.inc(u64::try_from(done.len()).unwrap_or_default());
    let mut mismatch = None;
    let mut each = |result: &CaseResult<'_>| {
        bar.inc(1);
        if let Some(Err(why)) =
            journal.as_mut().map(|journal| journal.done(&JournalCase::of(result)))
        {
            mismatch.get_or_insert(why);
        }
    };
    let twice = RepeatSampling(header.twice);
    let run_options = RunOptions {
        shard,
        options: header.options.clone(),
        finished: done,
        repeat: twice,
        shrink_attempts: arguments.shrink,
        on_result: &mut each,
    };
    let run = run_plan(plan, controller, run_options);
    bar.finish_and_clear();
    match mismatch {
        Some(why) => Err(CliError::failure(format!("the journal: {why}"), "is the disk full?")),
        None => Ok(run),
    }
}

/// The journal of a run in a folder, and what was run before.
fn open_journal<'a>(
    folder: &Path,
    header: &Header,
    resume: bool,
    suite: &'a Suite,
) -> Result<(Journal, Vec<CaseResult<'a>>), CliError> {
    let mut done = Vec::new();
    let journal = Journal::open(folder, header, resume, &mut |case: JournalCase| done.push(case));
    let journal = journal.map_err(|why| {
        CliError::usage(why, "--resume continues an interrupted run; or choose another folder")
    })?;
    let done = done.iter().map(|case| case.result(suite)).collect::<Result<Vec<_>, _>>();
    let done = done.map_err(|why| CliError::usage(why, "the journal belongs to another suite"))?;
    Ok((journal, done))
}

/// A bar on a terminal, nothing in a pipe.
pub(crate) fn progress(cases: usize) -> indicatif::ProgressBar {
    let cases = u64::try_from(cases).unwrap_or(u64::MAX);
    let style = indicatif::ProgressStyle::with_template("{bar:32} {pos}/{len} cases, {elapsed}");
    let bar = indicatif::ProgressBar::new(cases);
    match style {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// Writes the divergences as expectations, with the reasons that the earlier file had. Returns notes about reasons.
fn write_expectations(
    file: &Path,
    earlier: Option<Expectations>,
    run: &Run<'_>,
    observables: &Capabilities,
) -> Result<Vec<String>, CliError> {
    let mut listed = Expectations::of(run, &observables.name, &observables.version);
    let notes = earlier.map_or_else(Vec::new, |earlier| listed.keep_reasons(&earlier));
    let text = listed.to_text().map_err(|error| {
        CliError::failure(error, "this is a bug in gaugeblock; please report it")
    })?;
    user_files::write_whole(file, &text)?;
    Ok(notes)
}

pub(crate) fn write_report(folder: &Path, report: &Report<'_>) -> Result<(), CliError> {
    let xml = junit::junit(report).map_err(|error| {
        CliError::failure(error, "this is a bug in gaugeblock; please report it")
    })?;
    let page = html::html(report).map_err(|error| {
        CliError::failure(error, "this is a bug in gaugeblock; please report it")
    })?;
    let text = anstream::adapter::strip_str(&terminal::terminal(report, true)).to_string();
    user_files::write_whole(&folder.join("report.json"), format!("{:#}\n", json::json(report)))?;
    user_files::write_whole(&folder.join("report.html"), &page)?;
    user_files::write_whole(&folder.join(cost::FILE), Cost::of(report.run).to_text())?;
    user_files::write_whole(&folder.join("junit.xml"), &xml)?;
    user_files::write_whole(&folder.join("report.txt"), &text)?;
    user_files::write_whole(&folder.join("summary.md"), markdown::markdown(report))
}
