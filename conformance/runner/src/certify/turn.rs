//! Turns: while a case is judged, the controller can work on the next one.

use gaugeblock_suite::{Case, MotionCase, Rule, scenario_of};
use gaugeblock_vocabulary::Scenario;

use super::CaseRunner;
use super::select::Subject;
use super::verdict::{CaseResult, Cause, NotJudgedReason, Verdict};

/// What is judged next.
#[derive(Debug)]
pub(super) enum ScheduledCase<'a> {
    /// A case whose scenario is run.
    Run(&'a Case, Box<Scenario>),
    /// A case that is not run, and its verdict.
    NotRun(&'a Case, Box<Verdict>),
    /// A case of motion.
    Motion(&'a MotionCase),
}

impl CaseRunner<'_> {
    /// The turn of a case.
    pub(super) fn turn<'r>(self, subject: Subject<'r>) -> ScheduledCase<'r> {
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
        match controller.supports(&scenario) {
            Ok(()) => ScheduledCase::Run(case, Box::new(scenario)),
            Err(reason) => ScheduledCase::NotRun(case, Box::new(Verdict::Unsupported(reason))),
        }
    }

    /// Lets a case have its turn; `next` has the one after it.
    pub(super) fn judged<'r>(
        self,
        rule: &'r Rule,
        turn: ScheduledCase<'r>,
        next: Option<&ScheduledCase<'_>>,
    ) -> CaseResult<'r> {
        let ahead = || {
            if let Some(ScheduledCase::Run(_, scenario)) = next {
                self.controller.prefetch(scenario);
            }
        };
        match turn {
            ScheduledCase::Run(case, scenario) => self.run_case((rule, case), &scenario, ahead),
            ScheduledCase::NotRun(case, verdict) => {
                let verdict = *verdict;
                CaseResult { verdict, ..CaseResult::begun(rule, &case.name, &case.program) }
            }
            ScheduledCase::Motion(case) => self.run_motion(rule, case),
        }
    }
}
