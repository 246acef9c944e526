//! Turns: while a case is judged, the controller can work on the next one.

use gaugeblock_suite::{Case, MotionCase, Rule, scenario_of};
use gaugeblock_vocabulary::Scenario;

use super::Held;
use super::select::Subject;
use super::verdict::{CaseResult, Cause, Unjudged, Verdict};

/// What is judged next.
#[derive(Debug)]
pub(super) enum Turn<'a> {
    /// A case whose scenario is run.
    Run(&'a Case, Box<Scenario>),
    /// A case that is not run, and its verdict.
    NotRun(&'a Case, Box<Verdict>),
    /// A case of motion.
    Motion(&'a MotionCase),
}

impl Held<'_> {
    /// The turn of a case.
    pub(super) fn turn<'r>(self, subject: Subject<'r>) -> Turn<'r> {
        let Self { plan, options, controller, .. } = self;
        let case = match subject {
            Subject::Run(case) => case,
            Subject::Motion(case) => return Turn::Motion(case),
        };
        let scenario = scenario_of(case, options, plan.edition);
        if let Some(why) = controller.awaited(&scenario) {
            let why = Unjudged::new(Cause::NotRun, why);
            return Turn::NotRun(case, Box::new(Verdict::NotJudged(why)));
        }
        match controller.supports(&scenario) {
            Ok(()) => Turn::Run(case, Box::new(scenario)),
            Err(reason) => Turn::NotRun(case, Box::new(Verdict::Unsupported(reason))),
        }
    }

    /// Lets a case have its turn; `next` has the one after it.
    pub(super) fn judged<'r>(
        self,
        rule: &'r Rule,
        turn: Turn<'r>,
        next: Option<&Turn<'_>>,
    ) -> CaseResult<'r> {
        let ahead = || {
            if let Some(Turn::Run(_, scenario)) = next {
                self.controller.ahead(scenario);
            }
        };
        match turn {
            Turn::Run(case, scenario) => self.run_case((rule, case), &scenario, ahead),
            Turn::NotRun(case, verdict) => {
                let verdict = *verdict;
                CaseResult { verdict, ..CaseResult::begun(rule, &case.name, &case.program) }
            }
            Turn::Motion(case) => self.run_motion(rule, case),
        }
    }
}
