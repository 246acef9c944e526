//! Which rule is broken: the one that failing programs use and passing programs do not.
//!
//! This is spectrum-based fault localisation over rules instead of lines. The model says which rules a program uses. A
//! rule is suspicious if cases of its own fail, if many failing programs use it, and if few passing ones do.

use std::collections::BTreeSet;

/// A case, as far as it matters here.
#[derive(Clone, Debug)]
pub(super) struct SpectrumCase<'a> {
    /// The rule whose case it is.
    pub(super) rule: &'a str,
    /// The rules that its program uses, its own included.
    pub(super) reached: BTreeSet<&'a str>,
}

/// The cases of a run.
#[derive(Debug)]
pub(super) struct Spectrum<'a> {
    /// Cases of which an assertion fails.
    pub(super) failing: Vec<SpectrumCase<'a>>,
    /// Cases that pass.
    pub(super) passing: Vec<SpectrumCase<'a>>,
}

impl<'a> Spectrum<'a> {
    /// The broken rules, the most suspicious first, each with the places of its failing cases. Every failing case
    /// belongs to one rule.
    pub(super) fn attribute(&self) -> Vec<(&'a str, Vec<usize>)> {
        let mut left: Vec<usize> = (0..self.failing.len()).collect();
        let mut broken = Vec::new();
        while let Some(rule) = self.most_suspicious(&left) {
            let uses = |place: &usize| self.failing[*place].reached.contains(rule);
            let (own, others) = left.into_iter().partition(uses);
            left = others;
            broken.push((rule, own));
        }
        broken
    }

    /// The rule with the highest suspicion among those of failing cases; of equal ones the first by its id.
    fn most_suspicious(&self, left: &[usize]) -> Option<&'a str> {
        let rules: BTreeSet<&str> = left.iter().map(|place| self.failing[*place].rule).collect();
        let scored = rules.into_iter().map(|rule| (self.suspicion(rule, left), rule));
        let best = scored.reduce(|best, next| if next.0 > best.0 { next } else { best });
        best.map(|(_, rule)| rule)
    }

    /// How suspicious a rule is: the share of the failing programs that use it, and the share of its own cases that
    /// fail. The share of failing programs among all that use it decides between equals.
    #[expect(clippy::cast_precision_loss, reason = "cases are thousands")]
    fn suspicion(&self, rule: &str, left: &[usize]) -> f64 {
        let failing = || left.iter().map(|place| &self.failing[*place]);
        let uses = |case: &&SpectrumCase<'_>| case.reached.contains(rule);
        let own = |case: &&SpectrumCase<'_>| case.rule == rule;
        let (failed, passed) =
            (failing().filter(uses).count(), self.passing.iter().filter(uses).count());
        let (own_failed, own_passed) =
            (failing().filter(own).count(), self.passing.iter().filter(own).count());
        let of_failing = failed as f64 / left.len() as f64;
        let of_own = own_failed as f64 / (own_failed + own_passed) as f64;
        let of_users = failed as f64 / (failed + passed) as f64;
        of_failing + of_own + 0.01 * of_users
    }
}
