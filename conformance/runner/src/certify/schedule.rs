//! Scheduling: while the referee judges a case, the controller can work on the next one.

use gaugeblock_suite::{Case, MotionCase, Rule, scenario_of};
use gaugeblock_vocabulary::Scenario;

use super::CaseRunner;
use super::metric::on_metric_machine;
use super::plan::Scope;
use super::select::Subject;
use super::verdict::{CaseResult, Cause, NotJudgedReason, Verdict};

/// A case that is ready to run.
#[derive(Debug)]
pub(super) enum ScheduledCase<'a> {
    /// A case, and the scenario to run.
    Run(&'a Case, Box<Scenario>),
    /// A case that is not run, with its verdict.
    NotRun(&'a Case, Box<Verdict>),
    /// A case of motion.
    Motion(&'a MotionCase),
}

impl CaseRunner<'_> {
    /// Decides whether a case runs.
    pub(super) fn schedule<'r>(self, subject: Subject<'r>) -> ScheduledCase<'r> {
        let Self { plan, options, controller, .. } = self;
        let case = match subject {
            Subject::Run(case) => case,
            Subject::Motion(case) => return ScheduledCase::Motion(case),
        };
        let scenario = scenario_of(case, options, plan.edition);
        if let Some(why) = controller.pending(&scenario) {
            let why = NotJudgedReason::new(Cause::NotRun, why);
            return ScheduledCase::NotRun(case, Box::new(Verdict::NotJudged(why)));
        }
        let Err(reason) = controller.supports(&scenario) else {
            return ScheduledCase::Run(case, Box::new(scenario));
        };
        // The model says which assertions hold on a machine in millimetres.
        let metric = match plan.scope {
            Scope::Full => on_metric_machine(case, &scenario, &plan.edition.id),
            Scope::AssertionsOnly => None,
        };
        match metric.filter(|metric| controller.supports(metric).is_ok()) {
            Some(metric) => ScheduledCase::Run(case, Box::new(metric)),
            None => ScheduledCase::NotRun(case, Box::new(Verdict::Unsupported(reason))),
        }
    }

    /// Runs a case; `next` is the case after it.
    pub(super) fn run_scheduled<'r>(
        self,
        rule: &'r Rule,
        scheduled: ScheduledCase<'r>,
        next: Option<&ScheduledCase<'_>>,
    ) -> CaseResult<'r> {
        let prefetch = || {
            if let Some(ScheduledCase::Run(_, scenario)) = next {
                self.controller.prefetch(scenario);
            }
        };
        match scheduled {
            ScheduledCase::Run(case, scenario) => self.run_case((rule, case), &scenario, prefetch),
            ScheduledCase::NotRun(case, verdict) => {
                let verdict = *verdict;
                CaseResult { verdict, ..CaseResult::new(rule, &case.name, &case.program) }
            }
            ScheduledCase::Motion(case) => self.run_motion(rule, case),
        }
    }
}
