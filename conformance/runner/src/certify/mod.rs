//! The suite run against a controller: a verdict for each case, in any order and in parallel with the same result.

mod accepted;
mod contradicted;
mod metric;
mod model;
mod motion_case;
mod plan;
mod repeat;
mod schedule;
mod select;
mod shrink;
mod verdict;

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::fmt;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use gaugeblock_adapter::clock::now;
use gaugeblock_adapter::{Adapter, Expected};
use gaugeblock_compare::accuracy::is_hidden;
use gaugeblock_compare::judge::{Finding, judge};
use gaugeblock_compare::observe::Observed;
use gaugeblock_compare::{Capabilities, ComparedKind, Tally, compare, state};
use gaugeblock_suite::assertion::Claim;
use gaugeblock_suite::{Assertion, Case, Edition, Rule, Suite, applies, options_of, scenario_of};
use gaugeblock_vocabulary::{End, Options, Outcome, Scenario, Undetermined};

use crate::explain::{AlternativeOption, DivergenceContext};
use crate::observables::judged_observables;
use crate::shard::Shard;
pub use accepted::{AcceptsUnjudged, ListName};
pub use model::ModelOutcomes;
use model::SpecifiedOutcome;
pub use plan::{Plan, Scope};
pub use repeat::RepeatSampling;
use repeat::{Confirmation, RunAttempt, RunAttempts};
use select::{Selected, Subject, select};
pub use select::{cases, not_applicable};
pub use verdict::{
    BASELINE, CaseResult, Cause, EXPECTATIONS, NotJudgedReason, RuleDivergence, Run, Traces,
    Verdict,
};

/// How a plan is run.
pub struct RunOptions<'a, 'c> {
    /// The part of the cases to run.
    pub shard: Shard,
    /// The options of the controller, where they are not those of the edition.
    pub options: Options,
    /// Results of an earlier run; these cases are not run again.
    pub finished: Vec<CaseResult<'a>>,
    /// Which cases are run twice.
    pub repeat: RepeatSampling,
    /// How many programs the minimiser may try for each unexplained divergence; 0 keeps the case's own program.
    pub shrink_attempts: u32,
    /// Outcomes of the model that this run shares with others.
    pub model: Option<&'c ModelOutcomes>,
    /// Called with each result, one call at a time. After a break no further case begins.
    pub on_result: &'c mut (dyn FnMut(&CaseResult<'a>) -> ControlFlow<()> + Send),
}

impl fmt::Debug for RunOptions<'_, '_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "shard {}, {} done before", self.shard, self.finished.len())
    }
}

/// Runs the suite; `done` is called after each case.
pub fn certify<'a>(plan: Plan<'a>, controller: &dyn Adapter, done: &(dyn Fn() + Sync)) -> Run<'a> {
    let mut each = |_: &CaseResult<'a>| {
        done();
        ControlFlow::Continue(())
    };
    let run_options = RunOptions {
        shard: Shard::WHOLE,
        options: controller.options(),
        finished: Vec::new(),
        repeat: RepeatSampling::default(),
        shrink_attempts: 0,
        model: None,
        on_result: &mut each,
    };
    run_plan(plan, controller, run_options)
}

/// Runs the cases of a plan, in parallel, and judges them.
pub fn run_plan<'a>(
    plan: Plan<'a>,
    controller: &dyn Adapter,
    run_options: RunOptions<'a, '_>,
) -> Run<'a> {
    let options = options_of(plan.suite, plan.edition, &run_options.options);
    let Selected { not_applicable, cases } =
        select(plan, controller.has_laws_of_motion()).shard(run_options.shard);
    let RunOptions { repeat, shrink_attempts, model, .. } = run_options;
    let mut finished = BTreeMap::new();
    for result in run_options.finished {
        finished.insert((result.rule.id.as_str(), result.name), result);
    }
    let results: Vec<Option<CaseResult<'a>>> = cases
        .iter()
        .map(|(rule, subject)| finished.remove(&(rule.id.as_str(), subject.name())))
        .collect();
    let key = |subject: &Subject<'_>| match subject {
        Subject::Run(case) => controller.order_key(&scenario_of(case, &options, plan.edition)),
        Subject::Motion(_) => String::new(),
    };
    let open = cases.iter().zip(0..).zip(&results).filter(|(_, result)| result.is_none());
    let mut order: Vec<(String, usize)> =
        open.map(|(((_, subject), place), _)| (key(subject), place)).collect();
    order.sort();
    let results = Mutex::new((results, run_options.on_result));
    let next_case = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..plan.jobs.get().min(order.len()) {
            scope.spawn(|| {
                let options = &options;
                let runner =
                    CaseRunner { plan, options, controller, repeat, shrink_attempts, model };
                let take = || {
                    let (_, place) = order.get(next_case.fetch_add(1, Ordering::Relaxed))?;
                    let (rule, subject) = cases[*place];
                    Some((*place, rule, runner.schedule(subject)))
                };
                let mut following = take();
                while let Some((place, rule, scheduled)) = following {
                    let begun = now();
                    following = take();
                    let next = following.as_ref().map(|(_, _, scheduled)| scheduled);
                    let mut result = runner.run_scheduled(rule, scheduled, next);
                    result.cost = begun.elapsed();
                    let mut guard = results.lock().unwrap_or_else(PoisonError::into_inner);
                    let (results, each) = &mut *guard;
                    if each(&result).is_break() {
                        next_case.store(order.len(), Ordering::Relaxed);
                        following = None;
                    }
                    results[place] = Some(result);
                }
            });
        }
    });
    let (results, _) = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    let mut cases: Vec<_> = results.into_iter().flatten().collect();
    contradicted::withdraw(plan, &options, controller, &mut cases);
    Run { edition: plan.edition, scope: plan.scope, cases, not_applicable, fingerprint: None }
}

/// Runs and judges cases of a plan on one controller.
#[derive(Clone, Copy)]
struct CaseRunner<'a> {
    plan: Plan<'a>,
    options: &'a Options,
    controller: &'a dyn Adapter,
    repeat: RepeatSampling,
    shrink_attempts: u32,
    model: Option<&'a ModelOutcomes>,
}

impl CaseRunner<'_> {
    /// Runs a case and judges it. In between, `prefetch` lets the controller begin the next one.
    fn run_case<'r>(
        self,
        (rule, case): (&'r Rule, &'r Case),
        scenario: &Scenario,
        prefetch: impl FnOnce(),
    ) -> CaseResult<'r> {
        let Self { plan, controller, repeat, shrink_attempts, .. } = self;
        let mut result = CaseResult::new(rule, &case.name, &case.program);
        let specified = SpecifiedOutcome {
            rule: &rule.id,
            case: &case.name,
            scenario,
            shared: self.model,
            outcome: OnceCell::new(),
        };
        let expected: Option<&Expected<'_>> = match plan.scope {
            Scope::Full => Some(&specified),
            Scope::AssertionsOnly => None,
        };
        let attempts = RunAttempts { controller, scenario };
        let run = || attempts.run(expected, repeat.includes(&rule.id, &case.name));
        let begun = controller.is_out_of_process().then(run);
        prefetch();
        if let Some(why) = expected.and_then(|expected| undetermined_reason(&expected.end)) {
            result.verdict = Verdict::Inconclusive(why);
            return result;
        }
        let found = match begun.unwrap_or_else(run) {
            Ok(RunAttempt { found, leaked_failure }) => {
                result.rerun = leaked_failure.is_some();
                result.leaked_failure = leaked_failure;
                found
            }
            Err(not_judged) => {
                result.verdict = Verdict::NotJudged(not_judged);
                return result;
            }
        };
        if let End::Unsupported { what, .. } = &found.end {
            result.verdict = Verdict::Unsupported(what.clone());
            return result;
        }
        let case_judge =
            CaseJudge { suite: plan.suite, scenario, edition: plan.edition, controller };
        if !controller.capabilities().refuses
            && !matches!(found.end, End::Fault(_))
            && expected.is_some_and(|expected| matches!(expected.end, End::Fault(_)))
        {
            let why = "the documents refuse it, and the controller declares that it never refuses";
            result.verdict = Verdict::Unsupported(why.to_owned());
            return result;
        }
        let observes_nothing = case_judge.observes_nothing_asserted(case, &found);
        let expected = expected.map(|expected| &**expected);
        match case_judge.confirm_on_fresh(case, expected, found, &mut result) {
            Ok(Some((divergence, found))) => {
                result.verdict = case_judge.attribute(rule, case, divergence, &found);
            }
            Ok(None) if observes_nothing => {
                let why = "nothing was reported that its assertions check";
                result.verdict = Verdict::Unsupported(why.to_owned());
            }
            Ok(None) if plan.scope == Scope::AssertionsOnly => {
                result.verdict = verdict_of_assertions(&result.compared);
            }
            Ok(None) => {}
            Err(not_judged) => result.verdict = Verdict::NotJudged(not_judged),
        }
        // An explained divergence keeps its program: a smaller one could diverge in the same way by another quirk.
        if let (Verdict::Diverges(divergence) | Verdict::SideDifference(divergence), 1..) =
            (&mut result.verdict, shrink_attempts)
            && divergence.explanation.is_empty()
            && plan.scope == Scope::Full
        {
            divergence.shrunk = shrink::smallest(controller, scenario, shrink_attempts);
        }
        result
    }
}

/// Verdict of a case that fails no assertion, where nothing else is compared.
fn verdict_of_assertions(compared: &Tally) -> Verdict {
    if compared.of(ComparedKind::Assertions) > 0 {
        Verdict::Pass
    } else if compared.unjudged() > 0 {
        Verdict::Unsupported("nothing was reported that its assertions check".to_owned())
    } else {
        Verdict::without_assertion()
    }
}

/// Why the specification leaves a case open, if it does.
fn undetermined_reason(end: &End) -> Option<String> {
    end.undetermined().map(|undetermined| match undetermined {
        Undetermined::Unsupported(what) => format!("the model does not specify it yet: {what}"),
        Undetermined::Unspecified(why) => format!("the documents leave it open: {why}"),
    })
}

/// Judges the outcome of one case.
struct CaseJudge<'a> {
    suite: &'a Suite,
    scenario: &'a Scenario,
    edition: &'a Edition,
    controller: &'a dyn Adapter,
}

impl CaseJudge<'_> {
    /// The divergence on a fresh controller, and the outcome it was found in.
    ///
    /// A used controller may have kept state of an earlier program. A divergence that the observed edition predicts
    /// needs no second run. A controller that differs from run to run gets no verdict. Without `expected` only the
    /// assertions are judged.
    fn confirm_on_fresh(
        &self,
        case: &Case,
        expected: Option<&Outcome>,
        found: Outcome,
        result: &mut CaseResult<'_>,
    ) -> Result<Option<(RuleDivergence, Outcome)>, NotJudgedReason> {
        let begun = result.clone();
        let Some(divergence) = self.find_divergence(case, expected, &found, result) else {
            return Ok(None);
        };
        if expected.is_some()
            && self.context(result.rule, case, &found).matches_observed_edition(&self.edition.id)
        {
            return Ok(Some((divergence, found)));
        }
        let runs = RunAttempts { controller: self.controller, scenario: self.scenario };
        let confirmation = runs.confirm(&found);
        if matches!(confirmation, Ok(Confirmation::Same)) {
            return Ok(Some((divergence, found)));
        }
        *result = CaseResult { rerun: true, ..begun };
        let (fresh, leaks) = match confirmation? {
            Confirmation::Same => (found, false),
            Confirmation::Alone(fresh) => (fresh, false),
            Confirmation::Leaked(fresh) => (fresh, true),
        };
        let first = divergence.summary();
        result.leaked_failure = leaks.then_some(first.clone());
        let divergence = self.find_divergence(case, expected, &fresh, result);
        if divergence.is_none() && !leaks {
            return Err(NotJudgedReason::new(Cause::Nondeterministic, format!("once: {first}")));
        }
        Ok(divergence.map(|divergence| (divergence, fresh)))
    }

    /// The verdict on a divergence, with what explains it.
    fn attribute(
        &self,
        rule: &Rule,
        case: &Case,
        divergence: RuleDivergence,
        found: &Outcome,
    ) -> Verdict {
        let context = self.context(rule, case, found);
        let mut why = divergence.difference.as_ref().map(|_| context.explain()).unwrap_or_default();
        if let (2.., Some((assertion, _))) = (why.len(), &divergence.assertion) {
            // The option that breaks the assertion by itself is the cause; others change what follows.
            why.sort_by_key(|option| !self.breaks(option, case, assertion));
        }
        let explanation = why.iter().map(AlternativeOption::name).collect();
        Verdict::of_divergence(RuleDivergence { explanation, ..divergence })
    }

    /// Whether an assertion is for another option of a choice than the one in force: the options are not those of the
    /// edition, and it does not hold on the model either. The whole outcome is compared all the same. Without the
    /// model's outcome, the assertions of a rule that names such a choice are for another option, except guarded ones.
    fn is_for_another_option(
        &self,
        rule: &Rule,
        claim: &Assertion,
        expected: Option<&Observed>,
        observables: &Capabilities,
    ) -> bool {
        let (own, in_force) = (self.suite.options(self.edition), &self.scenario.options);
        if own == *in_force {
            return false;
        }
        match expected {
            Some(expected) => matches!(judge(claim, expected, observables), Finding::Fails(_)),
            None => {
                let names = |id: &String| own.get(id) != in_force.get(id);
                claim.guards.is_empty() && rule.options.iter().any(names)
            }
        }
    }

    /// Whether an assertion does not hold on the model under one other option.
    fn breaks(&self, option: &AlternativeOption<'_>, case: &Case, assertion: &str) -> bool {
        let found = Observed::of(&gaugeblock_reference::run(&option.applied_to(self.scenario)).0);
        let observables = self.observables();
        let claims = case.parsed();
        let claim = claims.iter().find(|claim| claim.text == assertion);
        claim.is_some_and(|claim| matches!(judge(claim, &found, &observables), Finding::Fails(_)))
    }

    /// Whether a pass would rest on nothing but the acceptance of the program: no assertion about anything else is
    /// observable. Controllers that report no blocks, and answers on paper, can be that silent; and a declared
    /// resolution can hide each difference.
    fn observes_nothing_asserted(&self, case: &Case, found: &Outcome) -> bool {
        let observables = self.observables();
        let is_silent = !observables.blocks || self.controller.exported_from().is_some();
        if !is_silent && observables.accuracy().is_exact() {
            return false;
        }
        let found = Observed::of(found);
        let claims = case.parsed().into_iter().filter(|claim| {
            applies(claim, &self.scenario.options, &self.edition.id)
                && claim.claim != Claim::Accepted
        });
        let mut hides = is_silent;
        let mut findings = claims.map(|claim| judge(&claim, &found, &observables)).peekable();
        findings.peek().is_some()
            && findings.all(|found| {
                hides |= matches!(&found, Finding::Masked(what) if is_hidden(what));
                matches!(found, Finding::Masked(_))
            })
            && hides
    }

    fn context<'a>(
        &'a self,
        rule: &'a Rule,
        case: &'a Case,
        found: &'a Outcome,
    ) -> DivergenceContext<'a> {
        DivergenceContext {
            suite: self.suite,
            rule,
            case,
            scenario: self.scenario,
            found,
            controller: self.controller,
            edition: self.edition,
        }
    }

    /// What is judged.
    fn observables(&self) -> Capabilities {
        judged_observables(self.controller, self.scenario, self.edition)
    }

    fn find_divergence(
        &self,
        case: &Case,
        expected: Option<&Outcome>,
        found: &Outcome,
        result: &mut CaseResult<'_>,
    ) -> Option<RuleDivergence> {
        let observables = self.observables();
        let outcomes = (expected, found);
        let (expected, found) = (expected.map(Observed::of), Observed::of(found));
        let (rule, specified) = (result.rule, expected.as_ref());
        let mut assertion = None;
        for claim in
            case.parsed().iter().filter(|a| applies(a, &self.scenario.options, &self.edition.id))
        {
            match judge(claim, &found, &observables) {
                Finding::Holds => result.compared.add(ComparedKind::Assertions, 1),
                Finding::Masked(what) => {
                    result.compared.add(ComparedKind::UnjudgedAssertions, 1);
                    result.masked.insert(what);
                }
                Finding::Fails(_)
                    if self.is_for_another_option(rule, claim, specified, &observables) =>
                {
                    result.compared.add(ComparedKind::UnjudgedAssertions, 1);
                    result.masked.insert("an assertion for another option".to_owned());
                }
                Finding::Fails(what) => {
                    assertion.get_or_insert((claim.text.clone(), what));
                }
            }
        }
        let (Some(expected), Some(specified)) = (expected, outcomes.0) else {
            let asserted = RuleDivergence { assertion, ..RuleDivergence::default() };
            return asserted.assertion.is_some().then_some(asserted);
        };
        let comparison = compare(&expected, &found, &observables);
        result.masked.extend(comparison.masked);
        result.compared.extend(&comparison.compared);
        let difference = comparison.divergence.map(|divergence| divergence.to_string());
        let differs = assertion.is_some() || difference.is_some();
        differs.then(|| {
            let traces = Some(Traces::of(specified, outcomes.1));
            let state = state(&expected, &found, &observables);
            RuleDivergence { assertion, difference, traces, state, ..RuleDivergence::default() }
        })
    }
}
