//! The suite run against a controller: a verdict for each case, in any order and in parallel with the same result.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use gaugeblock_trace::motion::Samples;
use gaugeblock_trace::scenario::Bench;
use gaugeblock_trace::{End, Options, Outcome, Scenario};

use crate::adapters::{Adapter, Motion, NotMoved};
use crate::compare::{Basis, Tally, compare};
use crate::explain::{Departed, Other};
use crate::judge::{Finding, judge};
use crate::motion;
use crate::observe::Observed;
use crate::shard::Shard;
use crate::suite::{Assertion, Case, Edition, MotionCase, Rule, Suite};

/// What came of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Everything that could be compared is as the documents say.
    Pass,
    /// The controller does something else.
    Diverges(Departure),
    /// The case's own assertions hold, and the one difference is a quirk that this rule is not about: it is charged to
    /// the rules that name the quirk. Everything else is as the documents say.
    ChargedElsewhere(Departure),
    /// Not run: the controller declared not to have this, or not to show it.
    Unsupported(String),
    /// Nothing can be said, and why. Never a pass.
    Inconclusive(String),
    /// The controller crashed, hung or was not understood. Never a pass.
    NotJudged(String),
}

/// What a controller does otherwise, in words that stay the same from run to run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Departure {
    /// The first assertion that does not hold, as it is written, with what was found.
    pub assertion: Option<(String, String)>,
    /// The first divergence from the model's outcome.
    pub divergence: Option<String>,
    /// The quirks and other options of choices that explain it, as few as possible; none where nothing does.
    pub explanation: Vec<String>,
}

impl Departure {
    /// In one line, as expectations name it.
    pub fn line(&self) -> String {
        match (&self.assertion, &self.divergence) {
            (Some((assertion, found)), _) => format!("{assertion} | found {found}"),
            (None, Some(divergence)) => divergence.clone(),
            (None, None) => String::new(),
        }
    }
}

/// A case, run.
#[derive(Clone, Debug)]
pub struct CaseResult<'a> {
    /// The rule.
    pub rule: &'a Rule,
    /// The name of its case.
    pub name: &'a str,
    /// The main program of the case.
    pub program: &'a str,
    /// What came of it.
    pub verdict: Verdict,
    /// Fields, effects and assertions that the controller does not show.
    pub masked: BTreeSet<String>,
    /// What was compared.
    pub compared: Tally,
    /// Whether it was run again on a new controller, since the used one departed from the documents. What the new one did
    /// is judged.
    pub repeated: bool,
}

/// The suite, run.
#[derive(Clone, Debug)]
pub struct Run<'a> {
    /// The edition that the controller was held to.
    pub edition: &'a Edition,
    /// Cases in the order of rules and pages.
    pub cases: Vec<CaseResult<'a>>,
    /// Rules that do not exist in the edition, and why.
    pub void: Vec<(&'a Rule, &'a str)>,
}

/// What is run, and how.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// The suite.
    pub suite: &'a Suite,
    /// The edition that the controller is held to.
    pub edition: &'a Edition,
    /// Only rules whose id begins with one of these; all when empty.
    pub only: &'a [String],
    /// How many cases run at once.
    pub jobs: NonZero<usize>,
}

/// What of a plan is run.
pub struct Course<'a, 'c> {
    /// The part of the cases.
    pub shard: Shard,
    /// What was run before, which is not run again.
    pub done: Vec<CaseResult<'a>>,
    /// Told of each case that is run, one at a time.
    pub each: &'c mut (dyn FnMut(&CaseResult<'a>) + Send),
}

impl fmt::Debug for Course<'_, '_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "shard {}, {} done before", self.shard, self.done.len())
    }
}

/// Runs the suite; `done` is told of each finished case.
pub fn certify<'a>(plan: Plan<'a>, controller: &dyn Adapter, done: &(dyn Fn() + Sync)) -> Run<'a> {
    let mut each = |_: &CaseResult<'a>| done();
    certify_in(plan, controller, Course { shard: Shard::WHOLE, done: Vec::new(), each: &mut each })
}

/// Runs as much of the suite as is to be run.
pub fn certify_in<'a>(plan: Plan<'a>, controller: &dyn Adapter, course: Course<'a, '_>) -> Run<'a> {
    let options = options_of(plan.suite, plan.edition, controller);
    let Selected { void, cases } = select(plan, controller.has_laws_of_motion()).of(course.shard);
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
                loop {
                    let turn = next.fetch_add(1, Ordering::Relaxed);
                    let Some((_, place)) = order.get(turn) else { break };
                    let (rule, subject) = cases[*place];
                    let result = match subject {
                        Subject::Run(case) => run_case(plan, &options, controller, rule, case),
                        Subject::Motion(case) => run_motion(plan, &options, controller, rule, case),
                    };
                    let mut guard = results.lock().unwrap_or_else(PoisonError::into_inner);
                    let (results, each) = &mut *guard;
                    each(&result);
                    results[*place] = Some(result);
                }
            });
        }
    });
    let (results, _) = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    Run { edition: plan.edition, cases: results.into_iter().flatten().collect(), void }
}

/// The options that a controller is held to: the edition's, and on top of them those that it declares to read the documents by.
pub fn options_of(suite: &Suite, edition: &Edition, controller: &dyn Adapter) -> Options {
    let mut options = suite.options(edition);
    for (id, option) in controller.options().0.iter() {
        options.0.insert(id.clone(), option.clone());
    }
    options
}

/// Rule and name of each case that a plan runs, in order, on a controller that has laws of motion, or that moves.
pub fn cases<'a>(plan: Plan<'a>, laws: bool, shard: Shard) -> Vec<(&'a str, &'a str)> {
    let cases = select(plan, laws).of(shard).cases.into_iter();
    cases.map(|(rule, subject)| (rule.id.as_str(), subject.name())).collect()
}

/// Rules that do not exist in the edition of a plan, and why.
pub fn void(plan: Plan<'_>) -> Vec<(&Rule, &str)> {
    select(plan, false).void
}

/// A case of either kind.
#[derive(Clone, Copy, Debug)]
enum Subject<'a> {
    Run(&'a Case),
    Motion(&'a MotionCase),
}

impl<'a> Subject<'a> {
    fn name(self) -> &'a str {
        match self {
            Self::Run(case) => &case.name,
            Self::Motion(case) => &case.name,
        }
    }
}

#[derive(Clone, Debug)]
struct Selected<'a> {
    void: Vec<(&'a Rule, &'a str)>,
    cases: Vec<(&'a Rule, Subject<'a>)>,
}

impl Selected<'_> {
    /// A part of the cases.
    fn of(mut self, shard: Shard) -> Self {
        let mut places = 0..;
        self.cases.retain(|_| places.next().is_some_and(|place| shard.has(place)));
        self
    }
}

/// What is run. Samples of a case are for who has laws, its program alone is for who moves.
fn select<'a>(plan: Plan<'a>, laws: bool) -> Selected<'a> {
    let edition = &plan.edition.id;
    let mut void = Vec::new();
    let mut cases = Vec::new();
    let wanted = |rule: &&Rule| {
        plan.only.is_empty() || plan.only.iter().any(|p| rule.id.starts_with(p.as_str()))
    };
    let speaks = |rule: &&Rule| rule.language == plan.edition.language;
    for rule in plan.suite.rules.iter().filter(wanted).filter(speaks) {
        if let Some(why) = rule.void.get(edition) {
            void.push((rule, why.as_str()));
            continue;
        }
        let runs = |case: &&Case| case.editions.is_empty() || case.editions.contains(edition);
        cases.extend(rule.cases.iter().filter(runs).map(|case| (rule, Subject::Run(case))));
        let concerns = |case: &&MotionCase| case.is_recorded() == laws;
        let motion = rule.motion.iter().filter(concerns);
        cases.extend(motion.map(|case| (rule, Subject::Motion(case))));
    }
    Selected { void, cases }
}

fn run_case<'a>(
    plan: Plan<'_>,
    options: &Options,
    controller: &dyn Adapter,
    rule: &'a Rule,
    case: &'a Case,
) -> CaseResult<'a> {
    let scenario = scenario_of(case, options, plan.edition);
    let mut result = CaseResult::begun(rule, &case.name, &case.program);
    if let Err(reason) = controller.supports(&scenario) {
        result.verdict = Verdict::Unsupported(reason);
        return result;
    }
    let expected = gaugeblock_reference::run(&scenario).0;
    match &expected.end {
        End::Unsupported { what, .. } => {
            result.verdict =
                Verdict::Inconclusive(format!("the model does not specify it yet: {what}"));
            return result;
        }
        End::Unspecified { why, .. } => {
            result.verdict = Verdict::Inconclusive(format!("the documents leave it open: {why}"));
            return result;
        }
        End::ProgramEnd
        | End::PercentEnd
        | End::Endless
        | End::Paused
        | End::Aborted
        | End::Fault(_)
        | End::BudgetExhausted { .. } => {}
    }
    let found = match controller.run(&scenario) {
        Ok(found) => found,
        Err(error) => {
            result.verdict = Verdict::NotJudged(error.to_string());
            return result;
        }
    };
    if let End::Unsupported { what, .. } = &found.end {
        result.verdict = Verdict::Unsupported(what.clone());
        return result;
    }
    let against =
        Against { suite: plan.suite, scenario: &scenario, edition: &plan.edition.id, controller };
    if let Some((departure, found)) = against.lasting(case, &expected, found, &mut result) {
        let departed = against.departed(rule, case, &found);
        let why = departure.divergence.as_ref().map(|_| departed.explanation()).unwrap_or_default();
        let explanation = why.iter().map(Other::name).collect();
        let departure = Departure { explanation, ..departure };
        result.verdict = if is_charged_elsewhere(departed, &departure, &why) {
            Verdict::ChargedElsewhere(departure)
        } else {
            Verdict::Diverges(departure)
        };
    }
    result
}

impl<'a> CaseResult<'a> {
    fn begun(rule: &'a Rule, name: &'a str, program: &'a str) -> Self {
        Self {
            rule,
            name,
            program,
            verdict: Verdict::Pass,
            masked: BTreeSet::new(),
            compared: Tally::default(),
            repeated: false,
        }
    }
}

/// A case of motion: its own samples, or what the controller makes of its program at each feed of segments.
fn run_motion<'a>(
    plan: Plan<'_>,
    options: &Options,
    controller: &dyn Adapter,
    rule: &'a Rule,
    case: &'a MotionCase,
) -> CaseResult<'a> {
    let mut result = CaseResult::begun(rule, &case.name, &case.program);
    let bench = plan.edition.bench.as_ref();
    let (scenario, path) = match motion::asked(case, options, bench) {
        Ok(asked) => asked,
        Err(why) => {
            result.verdict = Verdict::Inconclusive(why);
            return result;
        }
    };
    let readings = plan.suite.motion_options(plan.edition);
    let feeds: &[Option<u32>] = if case.is_recorded() { &[None] } else { &motion::FEEDS };
    for every in feeds {
        let held = samples_of(controller, &scenario, case, *every)
            .map(|samples| motion::held(case, &rule.id, &readings, (&samples, &path)));
        match held {
            Ok(Ok(())) => result.compared.add(Basis::Laws, case.says.len()),
            Ok(Err((saying, found))) => {
                let fed = every
                    .map_or(String::new(), |every| format!("with a segment in {every} cycles: "));
                let assertion = Some((saying, format!("{fed}{found}")));
                result.verdict = Verdict::Diverges(Departure {
                    assertion,
                    divergence: None,
                    explanation: Vec::new(),
                });
                break;
            }
            Err(NotMoved::Unsupported(why)) => {
                result.verdict = Verdict::Unsupported(why);
                break;
            }
            Err(NotMoved::Failed(why)) => {
                result.verdict = Verdict::NotJudged(why);
                break;
            }
        }
    }
    result
}

fn samples_of(
    controller: &dyn Adapter,
    scenario: &Scenario,
    case: &MotionCase,
    every: Option<u32>,
) -> Result<Samples, NotMoved> {
    if case.is_recorded() {
        return motion::made(case).map_err(NotMoved::Failed);
    }
    let limits = case.limits().map_err(NotMoved::Failed)?;
    let script = case.script();
    controller.moves(&Motion { scenario, limits: &limits, script: &script, every })
}

/// The scenario of a case under an edition. The edition's bench answers where the case has none of its own.
pub fn scenario_of(case: &Case, options: &Options, edition: &Edition) -> Scenario {
    let mut scenario = case.setup.scenario(&case.program, options);
    scenario.program.language = edition.language;
    if scenario.bench == Bench::default() {
        scenario.bench.name.clone_from(&edition.bench);
    }
    scenario
}

/// Whether an assertion is made under these options.
pub fn applies(assertion: &Assertion, options: &Options, edition: &str) -> bool {
    assertion.guard.as_ref().is_none_or(|(id, option)| match id.as_str() {
        "edition" => option == edition,
        _ => options.is(id, option),
    })
}

struct Against<'a> {
    suite: &'a Suite,
    scenario: &'a Scenario,
    edition: &'a str,
    controller: &'a dyn Adapter,
}

impl Against<'_> {
    /// The departure that a controller shows on which nothing ran before, and what it did; another one may only have kept
    /// something of an earlier program. What it is known to do needs no second run.
    fn lasting(
        &self,
        case: &Case,
        expected: &Outcome,
        found: Outcome,
        result: &mut CaseResult<'_>,
    ) -> Option<(Departure, Outcome)> {
        let unjudged = result.clone();
        let departure = self.departure(case, expected, &found, result)?;
        if self.departed(result.rule, case, &found).is_known(self.edition) {
            return Some((departure, found));
        }
        let Some(Ok(anew)) = self.controller.run_anew(self.scenario) else {
            return Some((departure, found));
        };
        if anew == found {
            return Some((departure, found));
        }
        *result = CaseResult { repeated: true, ..unjudged };
        let departure = self.departure(case, expected, &anew, result)?;
        Some((departure, anew))
    }

    fn departed<'a>(&'a self, rule: &'a Rule, case: &'a Case, found: &'a Outcome) -> Departed<'a> {
        Departed {
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
    ) -> Option<Departure> {
        let shows = self.controller.shows(self.scenario);
        let (expected, found) = (Observed::of(expected), Observed::of(found));
        let mut assertion = None;
        for claim in
            case.parsed().iter().filter(|a| applies(a, &self.scenario.options, self.edition))
        {
            match judge(claim, &found, &shows) {
                Finding::Holds => result.compared.add(Basis::Assertions, 1),
                Finding::Masked(what) => {
                    result.masked.insert(what);
                }
                Finding::Fails(what) => {
                    assertion.get_or_insert((claim.text.clone(), what));
                }
            }
        }
        let comparison = compare(&expected, &found, &shows);
        result.masked.extend(comparison.masked);
        result.compared.extend(&comparison.compared);
        let divergence = comparison.divergence.map(|divergence| divergence.to_string());
        let departs = assertion.is_some() || divergence.is_some();
        departs.then_some(Departure { assertion, divergence, explanation: Vec::new() })
    }
}

/// Whether all assertions hold and the difference is what other rules are about.
fn is_charged_elsewhere(departed: Departed<'_>, departure: &Departure, why: &[Other<'_>]) -> bool {
    let is_of_another_rule = |other: &Other<'_>| {
        departed.suite.rules.iter().any(|rule| rule.options.contains(&other.choice.id))
    };
    departure.assertion.is_none()
        && !why.is_empty()
        && why.iter().all(|other| !departed.is_named(other) && is_of_another_rule(other))
}
