//! A share of the cases, run again on a controller and compared with a certificate.

use std::hash::{BuildHasher as _, Hasher as _, RandomState};
use std::ops::ControlFlow;
use std::time::Duration;

use gaugeblock_adapter::Adapter;
use gaugeblock_adapter::exec::Limits;
use gaugeblock_certificate::{Change, Statement, changes, sample};
use gaugeblock_report::Header;
use gaugeblock_runner::certify::{CaseResult, Plan, RepeatSampling, RunOptions, run_plan};
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::{Suite, only_case};

use super::arguments::{Arguments, Percent};
use super::files::controller_files;
use crate::command::controller;
use crate::error::CliError;
use crate::progress::Progress;

/// What another run of some cases found.
#[derive(Clone, Debug)]
pub(crate) struct Rerun {
    pub(super) percent: usize,
    pub(super) seed: u64,
    pub(super) cases: usize,
    /// In what the controller is another one than the certified one. Nothing was run then.
    pub(super) other_controller: Option<String>,
    pub(super) changes: Vec<Change>,
}

impl Rerun {
    /// Whether the controller is the certified one, and every verdict the same.
    pub(super) fn is_same(&self) -> bool {
        self.other_controller.is_none() && self.changes.is_empty()
    }
}

/// Runs a share of the cases of certificates again. They are of one run.
pub(super) fn rerun(
    arguments: &Arguments,
    suite: &Suite,
    statements: &[&Statement],
) -> Result<Option<Rerun>, CliError> {
    let (Some(name), Some(Percent(percent)), Some(first)) =
        (&arguments.controller, arguments.rerun, statements.first())
    else {
        return Ok(None);
    };
    let header = &first.predicate.run;
    let time = Duration::from_secs(arguments.time_limit);
    let limits = Limits { time, start: time, ..Limits::default() };
    let controller = controller::controller_with_limits(name, limits, suite.defaults())?;
    let edition = crate::documents::edition(suite, &header.edition)?;
    controller::check_observed_edition(controller.as_ref(), suite)?;
    controller::check_exported_from(controller.as_ref(), suite, edition)?;
    controller::check_language(controller.as_ref(), edition)?;
    let seed = arguments.seed.unwrap_or_else(random_seed);
    let chosen = sample(statements, percent, seed);
    let mut rerun = Rerun {
        percent,
        seed,
        cases: chosen.len(),
        other_controller: other_controller(arguments, controller.as_ref(), header)?,
        changes: Vec::new(),
    };
    if rerun.other_controller.is_some() {
        return Ok(Some(rerun));
    }
    let only: Vec<String> = chosen.iter().map(|(rule, case)| only_case(rule, case)).collect();
    let jobs = crate::arguments::jobs(controller.best_jobs());
    let plan = Plan { suite, edition, only: &only, jobs, scope: header.scope };
    let progress = Progress::of(only.len(), "cases");
    let mut each = |_: &CaseResult<'_>| {
        progress.add(1);
        ControlFlow::Continue(())
    };
    let run_options = RunOptions {
        shard: Shard::WHOLE,
        options: header.options.clone(),
        finished: Vec::new(),
        repeat: RepeatSampling(header.twice),
        shrink_attempts: 0,
        model: None,
        on_result: &mut each,
    };
    let run = run_plan(plan, controller.as_ref(), run_options);
    progress.finish();
    rerun.changes = changes(statements, &run.cases);
    Ok(Some(rerun))
}

/// In what a controller is another one than that of a run.
fn other_controller(
    arguments: &Arguments,
    controller: &dyn Adapter,
    certified: &Header,
) -> Result<Option<String>, CliError> {
    let observables = controller.capabilities();
    let files = controller_files(controller, &arguments.subject)?;
    let digests = |files: &[gaugeblock_report::ControllerFile]| {
        let mut digests: Vec<String> = files.iter().map(|file| file.sha256.clone()).collect();
        digests.sort();
        digests.join(", ")
    };
    let accuracy = (observables.accuracy().to_string(), certified.accuracy.to_string());
    let pairs = [
        ("name", observables.name.clone(), certified.controller.clone()),
        ("version", observables.version.clone(), certified.version.clone()),
        ("accuracy", accuracy.0, accuracy.1),
        ("digest of its files", digests(&files), digests(&certified.controller_files)),
    ];
    let other = pairs.into_iter().find(|(_, found, certified)| found != certified);
    Ok(other.map(|(what, found, certified)| format!("{what} {found}; certified is {certified}")))
}

/// A seed that cannot be foreseen.
fn random_seed() -> u64 {
    RandomState::new().build_hasher().finish()
}
