//! Which rule is broken: the one that failing programs use and passing programs do not.
//!
//! This is spectrum-based fault localisation over rules instead of lines. The model says which rules a program uses,
//! and with which outcome: that a rule refuses may be broken while what it accepts is not. A rule is suspicious if
//! cases of its own fail, if many failing programs use it, and if few passing ones do.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use gaugeblock_suite::RuleOutcome;

/// A rule, and the outcome with which a program uses it; none where its own case does not reach it.
pub(super) type RuleUse<'a> = (&'a str, Option<RuleOutcome>);

/// A case, as far as it matters here.
#[derive(Clone, Debug)]
pub(super) struct SpectrumCase<'a> {
    /// The rule whose case it is.
    rule: &'a str,
    /// What its program uses, its own rule included.
    uses: BTreeSet<RuleUse<'a>>,
}

/// The cases of a run.
#[derive(Debug)]
pub(super) struct Spectrum<'a> {
    /// Cases of which an assertion fails.
    pub(super) failing: Vec<Rc<SpectrumCase<'a>>>,
    /// Cases that pass.
    pub(super) passing: Vec<Rc<SpectrumCase<'a>>>,
}

/// How many cases use a rule.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    /// All cases.
    all: usize,
    /// Cases of the rule itself.
    own: usize,
}

impl<'a> SpectrumCase<'a> {
    /// A case of a rule whose program reaches these rules.
    pub(super) fn new(
        rule: &'a str,
        reached: impl IntoIterator<Item = (&'a str, RuleOutcome)>,
    ) -> Self {
        let mut case = Self { rule, uses: BTreeSet::new() };
        case.uses.extend(reached.into_iter().map(|(rule, outcome)| (rule, Some(outcome))));
        if !case.uses(rule) {
            case.uses.insert((rule, None));
        }
        case
    }

    /// Whether its program uses a rule, with whatever outcome.
    pub(super) fn uses(&self, rule: &str) -> bool {
        self.uses.iter().any(|(used, _)| *used == rule)
    }
}

impl<'a> Spectrum<'a> {
    /// The broken rules, the most suspicious first, each with the places of its failing cases. Every failing case
    /// belongs to one rule.
    pub(super) fn attribute(&self) -> Vec<(&'a str, Vec<usize>)> {
        let passed = counts(&self.passing);
        let mut left: Vec<usize> = (0..self.failing.len()).collect();
        let mut broken = Vec::new();
        while let Some(rule) = self.most_suspicious(&left, &passed) {
            let uses = |place: &usize| self.failing[*place].uses(rule);
            let (own, others) = left.into_iter().partition(uses);
            left = others;
            broken.push((rule, own));
        }
        broken
    }

    /// The rule with the highest suspicion among those of failing cases; of equal ones the first by its id.
    fn most_suspicious(
        &self,
        left: &[usize],
        passed: &BTreeMap<RuleUse<'a>, Count>,
    ) -> Option<&'a str> {
        let failed = counts(left.iter().map(|place| &self.failing[*place]));
        let candidates = failed.iter().filter(|(_, count)| count.own > 0);
        let scored = candidates.map(|(used, failed)| {
            let passed = passed.get(used).copied().unwrap_or_default();
            (suspicion(*failed, passed, left.len()), used.0)
        });
        let best = scored.reduce(|best, next| if next.0 > best.0 { next } else { best });
        best.map(|(_, rule)| rule)
    }
}

/// How many of these cases use each rule.
fn counts<'a: 'c, 'c>(
    cases: impl IntoIterator<Item = &'c Rc<SpectrumCase<'a>>>,
) -> BTreeMap<RuleUse<'a>, Count> {
    let mut counts: BTreeMap<RuleUse<'a>, Count> = BTreeMap::new();
    for case in cases {
        for used in &case.uses {
            let count = counts.entry(*used).or_default();
            count.all += 1;
            count.own += usize::from(used.0 == case.rule);
        }
    }
    counts
}

/// How suspicious a rule is, from the failing and the passing cases that use it: the share of the failing cases, the
/// share of its own cases that fail, and the share of its users that fail. One more passing case is assumed, so that a
/// rule with one case is not certain. Its share of the failing cases as their own rule decides what is nearly equal.
#[expect(clippy::cast_precision_loss, reason = "cases are thousands")]
fn suspicion(failed: Count, passed: Count, failing: usize) -> f64 {
    let of_failing = failed.all as f64 / failing as f64;
    let of_own = failed.own as f64 / (failed.own + passed.own + 1) as f64;
    let own_of_failing = failed.own as f64 / failing as f64;
    let of_users = failed.all as f64 / (failed.all + passed.all) as f64;
    of_failing + of_own + 0.3 * own_of_failing + 0.5 * of_users
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A case `rule: rule+ other-`, where `+` is a use that is accepted and `-` one that is refused.
    fn case(text: &'static str) -> Rc<SpectrumCase<'static>> {
        let (rule, uses) = text.split_once(':').unwrap();
        let reached = uses.split_whitespace().map(|used| match used.strip_suffix('+') {
            Some(rule) => (rule, RuleOutcome::Accepted),
            None => (used.trim_end_matches('-'), RuleOutcome::Refused),
        });
        Rc::new(SpectrumCase::new(rule, reached))
    }

    #[track_caller]
    fn check(failing: &[&'static str], passing: &[&'static str], broken: &[&str]) {
        let cases = |texts: &[&'static str]| texts.iter().map(|text| case(text)).collect();
        let spectrum = Spectrum { failing: cases(failing), passing: cases(passing) };
        let found: Vec<_> = spectrum.attribute().into_iter().map(|(rule, _)| rule).collect();
        assert_eq!(found, broken);
    }

    #[test]
    fn rule_that_failing_programs_share_is_broken() {
        let failing = ["feed: feed+ move+", "feed: feed+ move+", "move: feed+ move+"];
        check(&failing, &["move: move+", "move: move+", "move: move+"], &["feed"]);
    }

    #[test]
    fn refusals_are_apart_from_what_a_rule_accepts() {
        let failing = ["range: range-", "range: range-", "call: range- call-"];
        let passing = ["range: range+", "range: range+", "range: range+", "range: range+"];
        check(&failing, &passing, &["range"]);
    }

    #[test]
    fn one_failing_case_is_less_than_several_of_many() {
        let failing = ["abort: abort+ stop+", "abort: abort+ stop+", "stop: abort+ stop+"];
        check(&failing, &["abort: abort+ stop+", "stop: abort+ stop+"], &["abort"]);
    }

    #[test]
    fn rule_that_its_own_case_does_not_reach_can_be_broken() {
        check(&["text: word+"], &["word: word+", "word: word+"], &["text"]);
    }

    #[test]
    fn causes_without_common_rule_are_several() {
        check(&["feed: feed+", "text: text-"], &[], &["feed", "text"]);
    }
}
