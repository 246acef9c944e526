//! Rule coverage: which rules a run reached, and with which outcome. It is never part of what is compared.

use std::collections::BTreeSet;

use crate::ids::Rule;

/// What a rule said about a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RuleOutcome {
    /// The block is allowed, and the rule decided what it does.
    Accepted,
    /// The block is refused.
    Refused,
}

/// Words of a set of rules.
const WORDS: usize = Rule::COUNT.div_ceil(64);

/// The rules that a run has reached so far.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RuleCoverage {
    /// Those that decided what an accepted block does, a bit for each.
    accepted: Bits,
    /// Those that refused a block.
    refused: Bits,
    /// Whether nothing is recorded: the state is a copy, and what is done to it does not count.
    muted: bool,
}

/// A set of rules.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Bits([u64; WORDS]);

impl Default for Bits {
    fn default() -> Self {
        Self([0; WORDS])
    }
}

impl Bits {
    #[inline]
    fn insert(&mut self, rule: Rule) {
        self.0[rule.number() / 64] |= 1 << (rule.number() % 64);
    }

    /// The rules of the set, in the order of their numbers.
    fn iter(&self) -> impl Iterator<Item = Rule> {
        (0..).zip(self.0).flat_map(|(word, mut bits)| {
            std::iter::from_fn(move || {
                let bit = bits.trailing_zeros();
                bits &= bits.checked_sub(1)?;
                Some(Rule::numbered(word * 64 + bit))
            })
        })
    }
}

impl RuleCoverage {
    /// A coverage that records nothing, for a state that is only looked at.
    pub(crate) fn muted() -> Self {
        Self { muted: true, ..Self::default() }
    }

    /// Stops or resumes recording; returns whether it was stopped before.
    pub(crate) fn set_muted(&mut self, muted: bool) -> bool {
        std::mem::replace(&mut self.muted, muted)
    }

    /// The rule decided what an accepted block does.
    #[inline]
    pub(crate) fn accepted(&mut self, rule: impl Into<Rule>) {
        if !self.muted {
            self.accepted.insert(rule.into());
        }
    }

    /// The rule refused a block.
    #[inline]
    pub(crate) fn refused(&mut self, rule: impl Into<Rule>) {
        if !self.muted {
            self.refused.insert(rule.into());
        }
    }

    /// All that was reached, ordered by the ids of the rules.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, RuleOutcome)> {
        let all: BTreeSet<_> = self.reached().map(|(rule, outcome)| (rule.id(), outcome)).collect();
        all.into_iter()
    }

    /// All that was reached, the accepting rules first.
    fn reached(&self) -> impl Iterator<Item = (Rule, RuleOutcome)> {
        let accepted = self.accepted.iter().map(|rule| (rule, RuleOutcome::Accepted));
        accepted.chain(self.refused.iter().map(|rule| (rule, RuleOutcome::Refused)))
    }
}

/// In how many runs each outcome of a rule was reached.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// By the number of the rule; empty before anything was counted.
    runs: Vec<Runs>,
}

/// How many runs reached each outcome of a rule.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Runs {
    accepted: u64,
    refused: u64,
}

impl Tally {
    /// Counts what a run reached.
    pub fn add(&mut self, coverage: &RuleCoverage) {
        self.runs.resize(Rule::COUNT, Runs::default());
        for (rule, outcome) in coverage.reached() {
            let runs = &mut self.runs[rule.number()];
            match outcome {
                RuleOutcome::Accepted => runs.accepted += 1,
                RuleOutcome::Refused => runs.refused += 1,
            }
        }
    }

    /// Counts what other runs reached.
    pub fn merge(&mut self, other: &Self) {
        if self.runs.is_empty() {
            self.runs.clone_from(&other.runs);
            return;
        }
        for (all, runs) in self.runs.iter_mut().zip(&other.runs) {
            all.accepted += runs.accepted;
            all.refused += runs.refused;
        }
    }

    /// How many runs reached an outcome.
    pub fn runs_with(&self, rule: &str, outcome: RuleOutcome) -> u64 {
        let runs = Rule::of(rule).and_then(|rule| self.runs.get(rule.number()));
        let runs = runs.copied().unwrap_or_default();
        match outcome {
            RuleOutcome::Accepted => runs.accepted,
            RuleOutcome::Refused => runs.refused,
        }
    }

    /// Every outcome that was reached, and in how many runs; in no order that means anything.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, RuleOutcome, u64)> {
        let outcomes = Rule::all().zip(&self.runs).flat_map(|(rule, runs)| {
            let id = rule.id();
            [(id, RuleOutcome::Accepted, runs.accepted), (id, RuleOutcome::Refused, runs.refused)]
        });
        outcomes.filter(|(_, _, runs)| *runs > 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::rule;

    #[test]
    fn each_rule_is_recorded_as_itself() {
        for rule in Rule::all() {
            let mut coverage = RuleCoverage::default();
            coverage.refused(rule);
            coverage.refused(rule);
            let all: Vec<_> = coverage.iter().collect();
            assert_eq!(all, [(rule.id(), RuleOutcome::Refused)]);
        }
    }

    #[test]
    fn nothing_is_recorded_while_it_is_muted() {
        let mut coverage = RuleCoverage::muted();
        coverage.accepted(rule::text::BLANKS);
        assert_eq!(coverage.iter().count(), 0);
        assert!(coverage.set_muted(false));
        coverage.accepted(rule::text::BLANKS);
        assert_eq!(coverage.iter().count(), 1);
    }

    #[test]
    fn a_tally_counts_runs_by_rule_and_outcome() {
        let mut coverage = RuleCoverage::default();
        coverage.accepted(rule::text::BLANKS);
        let mut tally = Tally::default();
        tally.add(&coverage);
        tally.add(&coverage);
        assert_eq!(tally.runs_with("text.blanks", RuleOutcome::Accepted), 2);
        assert_eq!(tally.runs_with("text.blanks", RuleOutcome::Refused), 0);
        assert_eq!(tally.iter().collect::<Vec<_>>(), [("text.blanks", RuleOutcome::Accepted, 2)]);
    }
}
