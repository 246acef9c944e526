//! Which rule is broken: the one that failing programs use and passing programs do not.
//!
//! This is spectrum-based fault localisation over rules instead of lines. The model says which rules a program uses,
//! and with which outcome: that a rule refuses may be broken while what it accepts is not. A rule is suspicious if
//! cases of its own fail, if many failing programs use it, and if few passing ones do. A grid counts as one case: its
//! cells are the same program under several conditions.

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
    /// Its share of a grid, of [`WHOLE`].
    share: u64,
}

/// The share of a case that is in no grid. Shares are whole numbers, so that their sums do not depend on the order.
pub(super) const WHOLE: u64 = 1 << 32;

/// The cases of a run.
#[derive(Debug)]
pub(super) struct Spectrum<'a> {
    /// Cases of which an assertion fails.
    pub(super) failing: Vec<Rc<SpectrumCase<'a>>>,
    /// Cases that pass.
    pub(super) passing: Vec<Rc<SpectrumCase<'a>>>,
}

/// How many cases use a rule, each as its share of a grid.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    /// All cases.
    all: u64,
    /// Cases of the rule itself.
    own: u64,
}

impl<'a> SpectrumCase<'a> {
    /// A case of a rule whose program reaches these rules, and its share of a grid.
    pub(super) fn new(
        rule: &'a str,
        reached: impl IntoIterator<Item = (&'a str, RuleOutcome)>,
        share: u64,
    ) -> Self {
        let mut case = Self { rule, uses: BTreeSet::new(), share };
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
        let mut passed = Counts::default();
        self.passing.iter().for_each(|case| passed.add(case));
        let mut failed = Counts::default();
        self.failing.iter().for_each(|case| failed.add(case));
        let mut left: Vec<usize> = (0..self.failing.len()).collect();
        let mut broken = Vec::new();
        while let Some(rule) = most_suspicious(&failed, &passed) {
            let uses = |place: &usize| self.failing[*place].uses(rule);
            let (own, others): (Vec<usize>, Vec<usize>) = left.into_iter().partition(uses);
            own.iter().for_each(|place| failed.remove(&self.failing[*place]));
            left = others;
            broken.push((rule, own));
        }
        broken
    }
}

/// The rule with the highest suspicion among those of failing cases; of equal ones the first by its id.
fn most_suspicious<'a>(failed: &Counts<'a>, passed: &Counts<'a>) -> Option<&'a str> {
    let candidates = failed.of_use.iter().filter(|(_, count)| count.own > 0);
    let scored = candidates.map(|(used, count)| {
        let passed = passed.of_use.get(used).copied().unwrap_or_default();
        (suspicion(*count, passed, failed.cases), used.0)
    });
    let best = scored.reduce(|best, next| if next.0 > best.0 { next } else { best });
    best.map(|(_, rule)| rule)
}

/// How many of some cases use each rule.
#[derive(Debug, Default)]
struct Counts<'a> {
    /// All cases.
    cases: u64,
    of_use: BTreeMap<RuleUse<'a>, Count>,
}

impl<'a> Counts<'a> {
    fn add(&mut self, case: &SpectrumCase<'a>) {
        self.cases += case.share;
        for used in &case.uses {
            let count = self.of_use.entry(*used).or_default();
            count.all += case.share;
            count.own += if used.0 == case.rule { case.share } else { 0 };
        }
    }

    fn remove(&mut self, case: &SpectrumCase<'a>) {
        self.cases -= case.share;
        for used in &case.uses {
            let Some(count) = self.of_use.get_mut(used) else { continue };
            count.all -= case.share;
            count.own -= if used.0 == case.rule { case.share } else { 0 };
        }
    }
}

/// How suspicious a rule is, from the failing and the passing cases that use it: the share of the failing cases, the
/// share of its own cases that fail, and the share of its users that fail. One more passing case is assumed, so that a
/// rule with one case is not certain. Its share of the failing cases as their own rule decides what is nearly equal.
#[expect(clippy::cast_precision_loss, reason = "shares of cases, compared with each other")]
fn suspicion(failed: Count, passed: Count, failing: u64) -> f64 {
    let share = |part: u64, all: u64| part as f64 / all as f64;
    let of_failing = share(failed.all, failing);
    let of_own = share(failed.own, failed.own + passed.own + WHOLE);
    let own_of_failing = share(failed.own, failing);
    let of_users = share(failed.all, failed.all + passed.all);
    of_failing + of_own + 0.1 * own_of_failing + 0.25 * of_users
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
        Rc::new(SpectrumCase::new(rule, reached, WHOLE))
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
    fn cells_of_a_grid_count_as_one_case() {
        let cells = |count: usize, text| {
            let cell = Rc::unwrap_or_clone(case(text));
            let share = WHOLE / u64::try_from(count).unwrap();
            std::iter::repeat_n(Rc::new(SpectrumCase { share, ..cell }), count)
        };
        let mut failing: Vec<_> = cells(100, "axes: axes+ unit+").collect();
        failing.extend([case("unit: axes+ unit+"), case("unit: axes+ unit+")]);
        let spectrum = Spectrum { failing, passing: vec![case("axes: axes+")] };
        assert_eq!(spectrum.attribute()[0].0, "unit");
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
