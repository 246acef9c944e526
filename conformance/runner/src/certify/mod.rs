//! The suite run against a controller: a verdict for each case, in any order and in parallel with the same result.

mod again;
mod excuse;
mod moved;
mod plan;
mod select;
mod shrunk;
mod turn;
mod verdict;

use std::cell::LazyCell;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use gaugeblock_adapter::Adapter;
use gaugeblock_adapter::clock::now;
use gaugeblock_compare::judge::{Finding, judge};
use gaugeblock_compare::observe::Observed;
use gaugeblock_compare::{Basis, compare, state};
use gaugeblock_suite::assertion::Claim;
use gaugeblock_suite::{Case, Rule, Suite, applies, options_of, scenario_of};
use gaugeblock_vocabulary::{End, Options, Outcome, Scenario, Undetermined};

use crate::explain::{AlternativeOption, DivergenceContext};
use crate::shard::Shard;
pub use again::RepeatSampling;
use again::{RunAttempt, RunAttempts};
pub use excuse::{BASELINE, EXPECTATIONS};
pub use plan::Plan;
use select::{Selected, Subject, select};
pub use select::{cases, void};
pub use verdict::{CaseResult, Cause, NotJudgedReason, RuleDivergence, Run, Traces, Verdict};

/// What of a plan is run.
pub struct RunOptions<'a, 'c> {
    /// The part of the cases.
    pub shard: Shard,
    /// What was run before, which is not run again.
    pub done: Vec<CaseResult<'a>>,
    /// Which cases are run twice.
    pub twice: RepeatSampling,
    /// How many programs are tried to make that of a divergence smaller, where nothing explains it; none where it
    /// stays as it is.
    pub shrink: u32,
    /// Told of each case that is run, one at a time.
    pub each: &'c mut (dyn FnMut(&CaseResult<'a>) + Send),
}

impl fmt::Debug for RunOptions<'_, '_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "shard {}, {} done before", self.shard, self.done.len())
    }
}

/// Runs the suite; `done` is told of each finished case.
pub fn certify<'a>(plan: Plan<'a>, controller: &dyn Adapter, done: &(dyn Fn() + Sync)) -> Run<'a> {
    let mut each = |_: &CaseResult<'a>| done();
    let course = RunOptions {
        shard: Shard::WHOLE,
        done: Vec::new(),
        twice: RepeatSampling::default(),
        shrink: 0,
        each: &mut each,
    };
    run_plan(plan, controller, course)
}

/// Runs as much of the suite as is to be run.
pub fn run_plan<'a>(
    plan: Plan<'a>,
    controller: &dyn Adapter,
    course: RunOptions<'a, '_>,
) -> Run<'a> {
    let options = options_of(plan.suite, plan.edition, &controller.options());
    let Selected { void, cases } = select(plan, controller.has_laws_of_motion()).of(course.shard);
    let (twice, shrink) = (course.twice, course.shrink);
    let mut before = BTreeMap::new();
    for result in course.done {
        before.insert((result.rule.id.as_str(), result.name), result);
    }
    let results: Vec<Option<CaseResult<'a>>> = cases
        .iter()
        .map(|(rule, subject)| before.remove(&(rule.id.as_str(), subject.name())))
        .collect();
    let key = |subject: &Subject<'_>| match subject {
        Subject::Run(case) => controller.order_key(&scenario_of(case, &options, plan.edition)),
        Subject::Motion(_) => String::new(),
    };
    let open = cases.iter().zip(0..).zip(&results).filter(|(_, result)| result.is_none());
    let mut order: Vec<(String, usize)> =
        open.map(|(((_, subject), place), _)| (key(subject), place)).collect();
    order.sort();
    let results = Mutex::new((results, course.each));
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..plan.jobs.get().min(order.len()) {
            scope.spawn(|| {
                let held = CaseRunner { plan, options: &options, controller, twice, shrink };
                let take = || {
                    let (_, place) = order.get(next.fetch_add(1, Ordering::Relaxed))?;
                    let (rule, subject) = cases[*place];
                    Some((*place, rule, held.turn(subject)))
                };
                let mut following = take();
                while let Some((place, rule, turn)) = following {
                    let begun = now();
                    following = take();
                    let next = following.as_ref().map(|(_, _, turn)| turn);
                    let mut result = held.judged(rule, turn, next);
                    result.cost = begun.elapsed();
                    let mut guard = results.lock().unwrap_or_else(PoisonError::into_inner);
                    let (results, each) = &mut *guard;
                    each(&result);
                    results[place] = Some(result);
                }
            });
        }
    });
    let (results, _) = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    Run {
        edition: plan.edition,
        cases: results.into_iter().flatten().collect(),
        void,
        fingerprint: None,
    }
}

/// A controller, and what it is held to.
#[derive(Clone, Copy)]
struct CaseRunner<'a> {
    plan: Plan<'a>,
    options: &'a Options,
    controller: &'a dyn Adapter,
    twice: RepeatSampling,
    shrink: u32,
}

impl CaseRunner<'_> {
    /// Runs a case and judges it. In between, `ahead` tells the controller what is next.
    fn run_case<'r>(
        self,
        (rule, case): (&'r Rule, &'r Case),
        scenario: &Scenario,
        ahead: impl FnOnce(),
    ) -> CaseResult<'r> {
        let Self { plan, controller, twice, shrink, .. } = self;
        let mut result = CaseResult::begun(rule, &case.name, &case.program);
        let expected = LazyCell::new(|| gaugeblock_reference::run(scenario).0);
        let runs = RunAttempts { controller, scenario };
        let ran = || runs.outcome(&expected, twice.chooses(&rule.id, &case.name));
        let begun = controller.is_out_of_process().then(ran);
        ahead();
        if let Some(why) = left_open(&expected.end) {
            result.verdict = Verdict::Inconclusive(why);
            return result;
        }
        let found = match begun.unwrap_or_else(ran) {
            Ok(RunAttempt { found, before }) => {
                result.repeated = before.is_some();
                result.before = before;
                found
            }
            Err(unjudged) => {
                result.verdict = Verdict::NotJudged(unjudged);
                return result;
            }
        };
        if let End::Unsupported { what, .. } = &found.end {
            result.verdict = Verdict::Unsupported(what.clone());
            return result;
        }
        let against =
            CaseJudge { suite: plan.suite, scenario, edition: &plan.edition.id, controller };
        let shows_nothing = against.shows_nothing_of(case, &found);
        match against.lasting(case, &expected, found, &mut result) {
            Ok(Some((departure, found))) => {
                result.verdict = against.charged(rule, case, departure, &found);
            }
            Ok(None) if shows_nothing => {
                let why = "nothing was shown of what its assertions are about";
                result.verdict = Verdict::Unsupported(why.to_owned());
            }
            Ok(None) => {}
            Err(unjudged) => result.verdict = Verdict::NotJudged(unjudged),
        }
        // A smaller program could depart by another quirk in the same way, so that what is explained stays as it is.
        if let (Verdict::Diverges(departure), 1..) = (&mut result.verdict, shrink)
            && departure.explanation.is_empty()
        {
            departure.shrunk = shrunk::smallest(controller, scenario, shrink);
        }
        result
    }
}

/// Why the specification says nothing of a case.
fn left_open(end: &End) -> Option<String> {
    end.undetermined().map(|undetermined| match undetermined {
        Undetermined::Unsupported(what) => format!("the model does not specify it yet: {what}"),
        Undetermined::Unspecified(why) => format!("the documents leave it open: {why}"),
    })
}

struct CaseJudge<'a> {
    suite: &'a Suite,
    scenario: &'a Scenario,
    edition: &'a str,
    controller: &'a dyn Adapter,
}

impl CaseJudge<'_> {
    /// The departure that a controller shows on which nothing ran before, and what it did; another one may only have
    /// kept something of an earlier program. What it is known to do needs no second run, and one that does something
    /// else each time has no verdict.
    fn lasting(
        &self,
        case: &Case,
        expected: &Outcome,
        found: Outcome,
        result: &mut CaseResult<'_>,
    ) -> Result<Option<(RuleDivergence, Outcome)>, NotJudgedReason> {
        let begun = result.clone();
        let Some(departure) = self.departure(case, expected, &found, result) else {
            return Ok(None);
        };
        if self.departed(result.rule, case, &found).is_known(self.edition) {
            return Ok(Some((departure, found)));
        }
        let Some(Ok(anew)) = self.controller.run_fresh(self.scenario) else {
            return Ok(Some((departure, found)));
        };
        if anew == found {
            return Ok(Some((departure, found)));
        }
        *result = CaseResult { repeated: true, ..begun };
        let runs = RunAttempts { controller: self.controller, scenario: self.scenario };
        if let Ok(once_more) = runs.alone()
            && let Some(difference) = runs.difference(&anew, &once_more)
        {
            let why = format!("twice on a new controller: {difference}");
            return Err(NotJudgedReason { cause: Cause::Nondeterministic, why });
        }
        let departure = self.departure(case, expected, &anew, result);
        Ok(departure.map(|departure| (departure, anew)))
    }

    /// Whose departure it is: that of the rule, or of others that are about what explains it.
    fn charged(
        &self,
        rule: &Rule,
        case: &Case,
        departure: RuleDivergence,
        found: &Outcome,
    ) -> Verdict {
        let departed = self.departed(rule, case, found);
        let why = departure.divergence.as_ref().map(|_| departed.explanation()).unwrap_or_default();
        let explanation = why.iter().map(AlternativeOption::name).collect();
        let departure = RuleDivergence { explanation, ..departure };
        if is_charged_elsewhere(departed, &departure, &why) {
            Verdict::AttributedElsewhere(departure)
        } else {
            Verdict::Diverges(departure)
        }
    }

    /// Whether a pass would rest on nothing that the sentence is about: blocks are not told, or somebody wrote down
    /// what was seen, and all that could be judged of the assertions is that the program was accepted.
    fn shows_nothing_of(&self, case: &Case, found: &Outcome) -> bool {
        let observables = self.controller.observables(self.scenario);
        if observables.blocks && self.controller.exported_from().is_none() {
            return false;
        }
        let found = Observed::of(found);
        let claims = case.parsed().into_iter().filter(|claim| {
            applies(claim, &self.scenario.options, self.edition) && claim.claim != Claim::Accepted
        });
        let mut findings = claims.map(|claim| judge(&claim, &found, &observables)).peekable();
        findings.peek().is_some() && findings.all(|found| matches!(found, Finding::Masked(_)))
    }

    fn departed<'a>(
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
        }
    }

    fn departure(
        &self,
        case: &Case,
        expected: &Outcome,
        found: &Outcome,
        result: &mut CaseResult<'_>,
    ) -> Option<RuleDivergence> {
        let observables = self.controller.observables(self.scenario);
        let outcomes = (expected, found);
        let (expected, found) = (Observed::of(expected), Observed::of(found));
        let mut assertion = None;
        for claim in
            case.parsed().iter().filter(|a| applies(a, &self.scenario.options, self.edition))
        {
            match judge(claim, &found, &observables) {
                Finding::Holds => result.compared.add(Basis::Assertions, 1),
                Finding::Masked(what) => {
                    result.masked.insert(what);
                }
                Finding::Fails(what) => {
                    assertion.get_or_insert((claim.text.clone(), what));
                }
            }
        }
        let comparison = compare(&expected, &found, &observables);
        result.masked.extend(comparison.masked);
        result.compared.extend(&comparison.compared);
        let divergence = comparison.divergence.map(|divergence| divergence.to_string());
        let departs = assertion.is_some() || divergence.is_some();
        departs.then(|| {
            let traces = Some(Traces::of(outcomes.0, outcomes.1));
            let state = state(&expected, &found, &observables);
            RuleDivergence { assertion, divergence, traces, state, ..RuleDivergence::default() }
        })
    }
}

/// Whether all assertions hold and the difference is what other rules are about.
fn is_charged_elsewhere(
    departed: DivergenceContext<'_>,
    departure: &RuleDivergence,
    why: &[AlternativeOption<'_>],
) -> bool {
    let is_of_another_rule = |other: &AlternativeOption<'_>| {
        departed.suite.rules.iter().any(|rule| rule.options.contains(&other.choice.id))
    };
    departure.assertion.is_none()
        && !why.is_empty()
        && why.iter().all(|other| !departed.is_named(other) && is_of_another_rule(other))
}
