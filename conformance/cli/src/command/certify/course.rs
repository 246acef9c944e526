//! A controller is opened, runs the suite, and has a report.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::num::NonZero;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

use gaugeblock_adapter::Adapter;
use gaugeblock_adapter::exec::Limits;
use gaugeblock_compare::Capabilities;
use gaugeblock_filesystem::move_into;
use gaugeblock_report::cost::{self, Cost};
use gaugeblock_report::stored::JournalCase;
use gaugeblock_report::terminal::Detail;
use gaugeblock_report::{
    ControllerFile, Header, Report, html, json, junit, markdown, profiles, terminal,
};
use gaugeblock_runner::certify::{
    CaseResult, ModelOutcomes, Plan, RepeatSampling, Run, RunOptions, Scope, cases, run_plan,
};
use gaugeblock_runner::expectations::Expectations;
use gaugeblock_runner::fingerprint::{fingerprint_entries, may_be_refused, shown_open_options};
use gaugeblock_runner::journal::{self, Journal};
use gaugeblock_runner::measure::{self, Measurement};
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::{Edition, Suite, only_case, options_of};
use gaugeblock_vocabulary::Options;
use serde_json::json;

use super::arguments::{Arguments, FingerprintWhen};
use super::selection::{only, profiles_in_edition};
use crate::arguments::Format;
use crate::command::comparison::ComparisonFiles;
use crate::command::{certificate, controller, options, user_files};
use crate::error::CliError;
use crate::progress::Progress;
use crate::streams::{write_out, write_out_in_colours};

/// What every controller of a call is judged with.
pub(super) struct Course<'a> {
    pub(super) arguments: &'a Arguments,
    pub(super) suite: &'a Suite,
    pub(super) known: ComparisonFiles,
    pub(super) earlier: Option<Expectations>,
    pub(super) model: Option<ModelOutcomes>,
}

/// A controller that is ready to run, and the edition that it is compared against.
pub(super) struct Candidate<'a> {
    pub(super) controller: Box<dyn Adapter>,
    pub(super) edition: &'a Edition,
    /// Its files, if they are written anywhere.
    pub(super) files: Vec<ControllerFile>,
}

impl<'a> Course<'a> {
    /// Opens a controller, and checks that it can be judged.
    pub(super) fn open(&self, name: &str) -> Result<Candidate<'a>, CliError> {
        let Self { arguments, suite, .. } = *self;
        let time = Duration::from_secs(arguments.time_limit);
        let limits = Limits { time, start: time, ..Limits::default() };
        let mut controller = controller::controller_with_limits(name, limits, suite.defaults())?;
        if let Some(like) = &arguments.restrict_to {
            controller = controller::restricted(controller, like)?;
        }
        let own = controller::own_edition(controller.as_ref(), suite);
        let edition =
            crate::documents::edition(suite, arguments.edition.as_deref().unwrap_or(own))?;
        profiles_in_edition(&arguments.profile, suite, edition)?;
        controller::check_observed_edition(controller.as_ref(), suite)?;
        controller::check_exported_from(controller.as_ref(), suite, edition)?;
        controller::declared_options(controller.as_ref(), suite)?;
        controller::check_options(controller.as_ref(), &suite.options(edition))?;
        controller::check_language(controller.as_ref(), edition)?;
        if arguments.check_observation {
            controller.check_observation();
        }
        Ok(Candidate { files: self.files(controller.as_ref())?, controller, edition })
    }

    /// Moves an earlier report into a folder of its own, so that it is not mistaken for that of a run that ends without
    /// one. A report that this run is compared with stays.
    pub(super) fn set_aside(&self, folder: &Path) -> Result<(), CliError> {
        let files = REPORT_FILES.map(|name| folder.join(name));
        let compared: Vec<_> =
            self.arguments.against.files().iter().flat_map(|file| file.canonicalize()).collect();
        if files.iter().flat_map(|file| file.canonicalize()).any(|file| compared.contains(&file)) {
            return Ok(());
        }
        for file in files {
            // A link or a device at the path of an output stays where it is.
            if file.symlink_metadata().is_ok_and(|metadata| metadata.is_file()) {
                move_into(&file, &folder.join(EARLIER)).map_err(|error| {
                    CliError::usage(
                        format!("{}: {error}", file.display()),
                        "the report of an earlier run is moved before another one begins",
                    )
                })?;
            }
        }
        Ok(())
    }

    /// The files of a controller, for a report or a certificate.
    fn files(&self, controller: &dyn Adapter) -> Result<Vec<ControllerFile>, CliError> {
        let wants_certificate = self.arguments.certificate.certificate.is_some();
        if self.arguments.report.is_none() && !wants_certificate {
            return Ok(Vec::new());
        }
        let files = certificate::controller_files(controller, &self.arguments.subject)?;
        if files.is_empty() && wants_certificate {
            return Err(CliError::usage(
                format!("{}: no file of it is within reach", controller.capabilities().name),
                "name one with --subject, such as its firmware image: a certificate is about the digests of files",
            ));
        }
        Ok(files)
    }

    /// The controller's limits.
    fn measurements(&self, edition: &Edition, controller: &dyn Adapter) -> Vec<Measurement> {
        let options = self.suite.options(edition);
        let progress = Progress::of(measure::names().len(), "measurements");
        let all = measure::measure(controller, &options, |_| true, |_| progress.add(1));
        progress.finish();
        all
    }

    /// Lists the cases that a call selects for a controller.
    pub(super) fn list(
        &self,
        Candidate { controller, edition, .. }: &Candidate<'_>,
    ) -> Result<u8, CliError> {
        let Self { arguments, suite, .. } = self;
        let only = only(arguments, suite)?;
        let plan = Plan {
            suite,
            edition,
            only: &only,
            jobs: crate::arguments::jobs(arguments.jobs),
            scope: Scope::Full,
        };
        let cases = cases(plan, controller.has_laws_of_motion(), arguments.shard);
        if cases.is_empty() {
            return Err(nothing_selected());
        }
        match arguments.format {
            Format::Text => {
                let mut text = String::new();
                for (rule, case) in &cases {
                    let _infallible = writeln!(text, "{}", only_case(rule, case));
                }
                write_out(&text);
            }
            Format::Json => {
                let named = |(rule, case): &(&str, &str)| json!({ "rule": rule, "case": case });
                let cases: Vec<_> = cases.iter().map(named).collect();
                let document = json!({
                    "gaugeblock": "cases", "schema": gaugeblock_vocabulary::schema::VERSION,
                    "edition": edition.id, "cases": cases,
                });
                write_out(&format!("{document:#}\n"));
            }
        }
        Ok(0)
    }

    /// Runs the suite on a controller, writes its report into a folder, and hands the report over.
    pub(super) fn judge<T>(
        &self,
        Candidate { controller, edition, files }: &Candidate<'_>,
        folder: Option<&Path>,
        then: impl FnOnce(&Report<'_>) -> Result<T, CliError>,
    ) -> Result<T, CliError> {
        let Self { arguments, suite, known, .. } = self;
        let controller = controller.as_ref();
        let jobs = crate::arguments::jobs(arguments.jobs.or(controller.best_jobs()));
        let only = only(arguments, suite)?;
        let scope = if arguments.assertions_only { Scope::AssertionsOnly } else { Scope::Full };
        let plan = Plan { suite, edition, only: &only, jobs, scope };
        let shard = arguments.shard;
        if cases(plan, controller.has_laws_of_motion(), Shard::WHOLE).is_empty() {
            return Err(nothing_selected());
        }
        let twice = arguments.repeat_percent;
        let (options, undeclared) = comparison_options(arguments, suite, edition, controller)?;
        let controller_files = files.clone();
        let header =
            Header { twice, options, controller_files, ..Header::of(plan, controller, shard) };
        let newer = known.check_header(&header, suite)?;
        if let Some(folder) = folder {
            self.set_aside(folder)?;
        }
        let mut run = self.run_with_journal(plan, controller, &header, folder)?;
        if is_fingerprinted(arguments, controller) {
            let options = options_of(suite, edition, &header.options);
            let environment = edition.environment.as_deref();
            run.fingerprint = Some(fingerprint_entries(suite, &options, environment, controller));
        }
        let left = cases(plan, header.laws, shard).len() - run.cases.len();
        let whole = arguments.only.is_empty() && shard == Shard::WHOLE && left == 0;
        let (mismatches, fixed) = known.compare(&mut run, whole);
        let mut notes = [controller.notes(), undeclared, newer, fixed].concat();
        if left > 0 {
            let why = match arguments.max_fail {
                Some(most) if failed(&run) >= most.get() => "by --max-fail".to_owned(),
                _ => format!("after {MOST_WITHOUT_OUTCOME} cases in a row without an outcome"),
            };
            notes.push(format!("stopped {why}: {left} cases were not run"));
        }
        // Only a whole run can pass a profile.
        let claimed = if shard == Shard::WHOLE { arguments.profile.as_slice() } else { &[] };
        let profiles = profiles::profiles(suite, &run, claimed);
        if let Some(file) = &arguments.write_expectations {
            let earlier = self.earlier.as_ref();
            notes.extend(write_expectations(file, earlier, &run, controller.capabilities())?);
        }
        let measurements =
            if arguments.measure { self.measurements(edition, controller) } else { Vec::new() };
        let report =
            Report { notes, profiles, mismatches, measurements, ..Report::of(suite, &run, header) };
        if let Some(folder) = folder {
            write_report(folder, &report)?;
            // The report has all that the journal had.
            let _gone = std::fs::remove_file(folder.join(journal::FILE));
        }
        then(&report)
    }

    /// Runs the open cases of a plan. With a report folder, each finished case is written to its journal.
    fn run_with_journal<'p>(
        &self,
        plan: Plan<'p>,
        controller: &dyn Adapter,
        header: &Header,
        folder: Option<&Path>,
    ) -> Result<Run<'p>, CliError> {
        let shard = header.shard;
        let (mut journal, done) = match folder {
            Some(folder) => {
                let (journal, done) =
                    open_journal(folder, header, self.arguments.resume, plan.suite)?;
                (Some(journal), done)
            }
            None => (None, Vec::new()),
        };
        let progress = Progress::of(cases(plan, header.laws, shard).len(), "cases");
        progress.add(done.len());
        let mut mismatch = None;
        let (mut failed, mut without_answer) = (0, 0);
        let most = self.arguments.max_fail.map_or(usize::MAX, NonZero::get);
        let mut each = |result: &CaseResult<'_>| {
            progress.add(1);
            failed += usize::from(is_failed(result));
            if let Some(Err(why)) =
                journal.as_mut().map(|journal| journal.done(&JournalCase::of(result)))
            {
                mismatch.get_or_insert(why);
            }
            without_answer =
                if result.verdict.is_without_outcome() { without_answer + 1 } else { 0 };
            if failed >= most || without_answer >= MOST_WITHOUT_OUTCOME {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let twice = RepeatSampling(header.twice);
        let run_options = RunOptions {
            shard,
            options: header.options.clone(),
            finished: done,
            repeat: twice,
            shrink_attempts: self.arguments.shrink,
            model: self.model.as_ref(),
            on_result: &mut each,
        };
        let run = run_plan(plan, controller, run_options);
        progress.finish();
        match mismatch {
            Some(why) => Err(CliError::failure(format!("the journal: {why}"), "is the disk full?")),
            None => Ok(run),
        }
    }
}

/// After so many cases in a row without an outcome a run ends: with a hanging controller it could take days.
const MOST_WITHOUT_OUTCOME: usize = 200;

/// Whether a case counts for --max-fail.
fn is_failed(result: &CaseResult<'_>) -> bool {
    result.verdict.divergence().is_some()
}

fn failed(run: &Run<'_>) -> usize {
    run.cases.iter().filter(|result| is_failed(result)).count()
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
                "the only option left of `{id}` is to refuse, and it never refuses: its cases are not judged"
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

/// A fingerprint takes minutes on a controller in real time, and a second at most on others.
fn is_fingerprinted(arguments: &Arguments, controller: &dyn Adapter) -> bool {
    match arguments.fingerprint {
        Some(when) => when == FingerprintWhen::Always,
        None => arguments.report.is_some() && controller.capabilities().pin_period <= 0.0,
    }
}

pub(crate) fn print(report: &Report<'_>, format: Format, detail: Detail) {
    match format {
        Format::Text => write_out_in_colours(&terminal::terminal(report, detail)),
        Format::Json => write_out(&json::text(report)),
    }
}

fn nothing_selected() -> CliError {
    CliError::usage(
        "no case is selected",
        "`gaugeblock rules` lists the rules; remove --only and --case, or choose another edition",
    )
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
    check_journal(folder, &done)?;
    let done = done.iter().map(|case| case.result(suite)).collect::<Result<Vec<_>, _>>();
    let done = done.map_err(|why| CliError::usage(why, "the journal belongs to another suite"))?;
    Ok((journal, done))
}

/// Refuses a journal with two results of one case: a run writes each case once.
fn check_journal(folder: &Path, done: &[JournalCase]) -> Result<(), CliError> {
    let mut seen = BTreeMap::new();
    for JournalCase { case, .. } in done {
        let earlier = seen.insert((&case.rule, &case.case), case);
        if earlier.is_some_and(|earlier| earlier != case) {
            return Err(CliError::usage(
                format!(
                    "{}: {} / {} is there twice, with different results",
                    folder.join(journal::FILE).display(),
                    case.rule,
                    case.case
                ),
                "choose another folder, or remove the journal and run all cases again",
            ));
        }
    }
    Ok(())
}

/// Writes the divergences as expectations, with the reasons that the earlier file had. Returns notes about reasons.
fn write_expectations(
    file: &Path,
    earlier: Option<&Expectations>,
    run: &Run<'_>,
    observables: &Capabilities,
) -> Result<Vec<String>, CliError> {
    let mut listed = Expectations::of(run, &observables.name, &observables.version);
    let notes = earlier.map_or_else(Vec::new, |earlier| listed.keep_reasons(earlier));
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
    let text =
        anstream::adapter::strip_str(&terminal::terminal(report, Detail::Everything)).to_string();
    let texts = [
        json::text(report),
        page,
        Cost::of(report.run).to_text(),
        xml,
        text,
        markdown::markdown(report),
    ];
    REPORT_FILES
        .iter()
        .zip(texts)
        .try_for_each(|(name, text)| user_files::write_whole(&folder.join(name), &text))
}

/// The files of a report.
const REPORT_FILES: [&str; 6] =
    ["report.json", "report.html", cost::FILE, "junit.xml", "report.txt", "summary.md"];

/// The folder of an earlier report, within the folder of reports.
const EARLIER: &str = "earlier";
