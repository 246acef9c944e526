//! Findings: what a controller does otherwise, one for each cause, over all cases of a run.
//!
//! A verdict says of one case whether its rule is kept. One mistake of a controller shows in many cases, of rules that
//! are kept, too. A finding collects them, names the one rule that is broken, and lists what else it touches:
//!
//! 1. Divergences with the same explanation, by quirks or other options, are one finding. It belongs to the rule that
//!    depends on that option and of which most cases fail.
//! 2. The others are attributed to the [rule that the failing programs use, with the same outcome, and the passing
//!    ones do not](self::spectrum).
//! 3. Side differences follow the finding whose rule their program uses. What is left has no known cause; it is a
//!    finding without a rule, by what differs.
//!
//! A run that judges assertions only has a finding for each rule that fails an assertion.

mod coverage;
mod severity;
mod spectrum;

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_suite::{Rule, Suite};

use crate::certify::{CaseResult, RuleDivergence, Run, Scope};
pub use coverage::Coverage;
pub use severity::Severity;
use spectrum::Spectrum;

/// A divergent case.
pub type Divergent<'a, 'r> = (&'r CaseResult<'a>, &'r RuleDivergence);

/// What a controller does otherwise, by one cause.
#[derive(Clone, Debug)]
pub struct Finding<'a, 'r> {
    /// The cause.
    pub cause: FindingCause,
    /// The rule that is broken; none if the cause is unknown.
    pub rule: Option<&'a Rule>,
    /// How bad its worst divergence is.
    pub severity: Severity,
    /// Whether expectations, a baseline or a waiver accept all of it.
    pub is_known: bool,
    /// The cases of the rule of which an assertion fails, the smallest program first; without a rule, all cases.
    pub cases: Vec<Divergent<'a, 'r>>,
    /// Cases of other rules of which an assertion fails by the same cause.
    pub touched: Vec<Divergent<'a, 'r>>,
    /// Cases of which every assertion holds, and that differ by the same cause.
    pub side_differences: Vec<Divergent<'a, 'r>>,
}

/// Why a controller differs.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FindingCause {
    /// These quirks, or other options of choices, explain every case.
    Options(Vec<String>),
    /// No option explains it; the rule of the finding is what its programs have in common.
    Rule,
    /// Not known. What differs, in words.
    Unknown(String),
}

impl<'a, 'r> Finding<'a, 'r> {
    /// All its cases: those of its rule first.
    pub fn divergent(&self) -> impl Iterator<Item = Divergent<'a, 'r>> {
        self.cases.iter().chain(&self.touched).chain(&self.side_differences).copied()
    }

    /// The other rules of which an assertion fails.
    pub fn touched_rules(&self) -> BTreeSet<&str> {
        self.touched.iter().map(|(result, _)| result.rule.id.as_str()).collect()
    }
}

/// The findings of a run, the worst first: unknown ones before accepted ones, then by severity and by the number of
/// cases.
///
/// `explains` says whether the explanation of a divergence applies to this controller: a quirk of another controller
/// does not. `words` says what differs, without lines and numbers.
pub fn findings<'a, 'r>(
    suite: &'a Suite,
    run: &'r Run<'a>,
    explains: &dyn Fn(&RuleDivergence) -> bool,
    words: &dyn Fn(&RuleDivergence) -> String,
) -> Vec<Finding<'a, 'r>> {
    findings_by(&mut Coverage::new(suite, run.edition), suite, run, explains, words)
}

/// The [findings](findings()) of one of several runs of an edition, of which the coverage is kept.
pub fn findings_by<'a, 'r>(
    coverage: &mut Coverage<'a>,
    suite: &'a Suite,
    run: &'r Run<'a>,
    explains: &dyn Fn(&RuleDivergence) -> bool,
    words: &dyn Fn(&RuleDivergence) -> String,
) -> Vec<Finding<'a, 'r>> {
    let divergent =
        run.cases.iter().filter_map(|result| Some((result, result.verdict.divergence()?)));
    let (known, new): (Vec<Divergent<'a, 'r>>, Vec<_>) =
        divergent.partition(|(result, _)| result.verdict.accepted_by().is_some());
    let mut findings = Vec::new();
    for (is_known, divergent) in [(false, new), (true, known)] {
        let (explained, others): (Vec<_>, Vec<_>) =
            divergent.into_iter().partition(|(_, divergence)| explains(divergence));
        let both = by_options(suite, explained).into_iter();
        let both = both.chain(by_rules(coverage, suite, run, others, words));
        findings.extend(both.map(|finding| Finding { is_known, ..finding }));
    }
    for finding in &mut findings {
        // What it touches may be worse by accident; the cases of its rule show what it does.
        let own = finding.cases.len().max(1);
        let severities = finding.divergent().take(own).map(|(_, it)| Severity::of(it));
        finding.severity = severities.min().unwrap_or(Severity::Words);
    }
    findings.sort_by_key(|finding| {
        (
            finding.is_known,
            finding.severity,
            finding.rule.is_none(),
            Reverse(finding.divergent().count()),
        )
    });
    findings
}

/// Findings of divergences that quirks or other options explain.
///
/// If several explain a divergence together, the first of them breaks its assertion. Where every assertion holds, the
/// first that is the cause of another divergence counts.
fn by_options<'a, 'r>(suite: &'a Suite, explained: Vec<Divergent<'a, 'r>>) -> Vec<Finding<'a, 'r>> {
    let causes: BTreeSet<&String> = explained
        .iter()
        .filter_map(|(_, divergence)| match divergence.explanation.as_slice() {
            [first, ..] if divergence.assertion.is_some() => Some(first),
            [one] => Some(one),
            _ => None,
        })
        .collect();
    let mut by_cause: BTreeMap<Vec<String>, Vec<Divergent<'a, 'r>>> = BTreeMap::new();
    for (result, divergence) in &explained {
        let parts = &divergence.explanation;
        let first = parts.iter().find(|part| causes.contains(part));
        let cause = first.map_or_else(|| parts.clone(), |part| vec![part.clone()]);
        by_cause.entry(cause).or_default().push((*result, *divergence));
    }
    let findings = by_cause.into_iter().map(|(parts, cases)| {
        let rule = owner(suite, &parts, &cases);
        finding(FindingCause::Options(parts), rule, cases)
    });
    findings.collect()
}

/// The rule that depends on what explains these cases, and of which most of them fail; another one of which some fail
/// if none of them does.
fn owner<'a>(suite: &'a Suite, parts: &[String], cases: &[Divergent<'a, '_>]) -> Option<&'a Rule> {
    let ids: Vec<&str> =
        parts.iter().map(|part| part.split(" = ").next().unwrap_or_default()).collect();
    let owns = |rule: &&Rule| rule.options.iter().any(|id| ids.contains(&id.as_str()));
    let failing = |rule: &Rule| {
        let own = cases.iter().filter(|(result, divergence)| {
            result.rule.id == rule.id && divergence.assertion.is_some()
        });
        own.count()
    };
    let owners = suite.rules.iter().filter(owns);
    let owner = owners.max_by_key(|rule| (failing(rule), Reverse(rule.id.as_str())));
    if owner.is_some_and(|owner| failing(owner) > 0) {
        return owner;
    }
    // The run has no case of an owner. A rule of which an assertion fails is broken, too.
    let broken = suite.rules.iter().filter(|rule| failing(rule) > 0);
    broken.max_by_key(|rule| (failing(rule), Reverse(rule.id.as_str()))).or(owner)
}

/// Findings of divergences that no option explains.
fn by_rules<'a, 'r>(
    coverage: &mut Coverage<'a>,
    suite: &'a Suite,
    run: &'r Run<'a>,
    divergent: Vec<Divergent<'a, 'r>>,
    words: &dyn Fn(&RuleDivergence) -> String,
) -> Vec<Finding<'a, 'r>> {
    if divergent.is_empty() {
        return Vec::new();
    }
    let failing: Vec<_> = divergent
        .iter()
        .copied()
        .filter(|(_, divergence)| divergence.assertion.is_some())
        .collect();
    if run.scope == Scope::AssertionsOnly {
        return by_own_rules(failing);
    }
    let passing = run.cases.iter().filter(|result| result.verdict.divergence().is_none());
    let passing = passing.filter(|result| result.verdict.reason().is_none());
    let spectrum = Spectrum {
        failing: failing.iter().map(|(result, _)| coverage.case(result)).collect(),
        passing: passing.map(|result| coverage.case(result)).collect(),
    };
    let mut by_rule: Vec<(&'a Rule, Vec<Divergent<'a, 'r>>)> = Vec::new();
    for (rule, places) in spectrum.attribute() {
        let Some(rule) = suite.rule(rule) else { continue };
        by_rule.push((rule, places.into_iter().map(|place| failing[place]).collect()));
    }
    let mut unknown: BTreeMap<String, Vec<Divergent<'a, 'r>>> = BTreeMap::new();
    for (result, divergence) in divergent {
        if divergence.assertion.is_some() {
            continue;
        }
        let case = coverage.case(result);
        match by_rule.iter_mut().find(|(rule, _)| case.uses(&rule.id)) {
            Some((_, cases)) => cases.push((result, divergence)),
            None => unknown.entry(words(divergence)).or_default().push((result, divergence)),
        }
    }
    let known =
        by_rule.into_iter().map(|(rule, cases)| finding(FindingCause::Rule, Some(rule), cases));
    let unknown =
        unknown.into_iter().map(|(what, cases)| finding(FindingCause::Unknown(what), None, cases));
    known.chain(unknown).collect()
}

/// Returns a finding for each rule that fails an assertion. The rules that a program uses are unknown here.
fn by_own_rules<'a, 'r>(failing: Vec<Divergent<'a, 'r>>) -> Vec<Finding<'a, 'r>> {
    let mut by_rule: BTreeMap<&str, Vec<Divergent<'a, 'r>>> = BTreeMap::new();
    for (result, divergence) in failing {
        by_rule.entry(&result.rule.id).or_default().push((result, divergence));
    }
    let findings = by_rule.into_values().map(|cases| {
        let rule = cases.first().map(|(result, _)| result.rule);
        finding(FindingCause::Rule, rule, cases)
    });
    findings.collect()
}

/// A finding with its cases in their places.
fn finding<'a, 'r>(
    cause: FindingCause,
    rule: Option<&'a Rule>,
    all: Vec<Divergent<'a, 'r>>,
) -> Finding<'a, 'r> {
    let mut finding = Finding {
        cause,
        rule,
        severity: Severity::Words,
        is_known: false,
        cases: Vec::new(),
        touched: Vec::new(),
        side_differences: Vec::new(),
    };
    for (result, divergence) in all {
        let is_own = rule.is_none_or(|rule| rule.id == result.rule.id);
        let list = match divergence.assertion {
            _ if rule.is_none() => &mut finding.cases,
            None => &mut finding.side_differences,
            Some(_) if is_own => &mut finding.cases,
            Some(_) => &mut finding.touched,
        };
        list.push((result, divergence));
    }
    for list in [&mut finding.cases, &mut finding.touched, &mut finding.side_differences] {
        list.sort_by_key(|(result, divergence)| divergence.program(result).len());
    }
    finding
}
