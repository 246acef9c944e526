//! Evidence: which rules a run reached, and with which outcome. It is never part of what is compared.

use crate::coverage;

/// What a rule said about a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RuleOutcome {
    /// The block is allowed, and the rule decided what it does.
    Accepted,
    /// The block is refused.
    Refused,
}

/// The rules that a run reached.
#[derive(Clone, Debug, Default)]
pub struct Evidence {
    /// Each of them once, in the order in which they were reached first.
    reached: Vec<Reached>,
}

/// A rule that was reached, and with which outcomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Reached {
    /// Its place in the list of all rules.
    pub(crate) rule: u16,
    pub(crate) accepted: bool,
    pub(crate) refused: bool,
}

impl Evidence {
    pub(crate) fn new(reached: Vec<Reached>) -> Self {
        Self { reached }
    }

    /// All that was reached, ordered by rule.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, RuleOutcome)> {
        let outcomes = self.reached.iter().flat_map(|reached| {
            let rule = coverage::id(reached.rule);
            let accepted = reached.accepted.then_some((rule, RuleOutcome::Accepted));
            let refused = reached.refused.then_some((rule, RuleOutcome::Refused));
            [accepted, refused].into_iter().flatten()
        });
        let mut all: Vec<_> = outcomes.collect();
        all.sort_unstable();
        all.into_iter()
    }
}

impl PartialEq for Evidence {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

impl Eq for Evidence {}

/// In how many runs each outcome of a rule was reached.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// By the place of the rule in the list of all rules; empty before anything was counted.
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
    pub fn add(&mut self, evidence: &Evidence) {
        if self.runs.is_empty() && !evidence.reached.is_empty() {
            self.runs.resize(coverage::count(), Runs::default());
        }
        for reached in &evidence.reached {
            let runs = &mut self.runs[usize::from(reached.rule)];
            runs.accepted += u64::from(reached.accepted);
            runs.refused += u64::from(reached.refused);
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
        let place = coverage::place(rule);
        let runs = place.and_then(|place| self.runs.get(place)).copied().unwrap_or_default();
        match outcome {
            RuleOutcome::Accepted => runs.accepted,
            RuleOutcome::Refused => runs.refused,
        }
    }

    /// Every outcome that was reached, and in how many runs; in no order that means anything.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, RuleOutcome, u64)> {
        let outcomes = (0..).zip(&self.runs).flat_map(|(rule, runs)| {
            let id = coverage::id(rule);
            [(id, RuleOutcome::Accepted, runs.accepted), (id, RuleOutcome::Refused, runs.refused)]
        });
        outcomes.filter(|(_, _, runs)| *runs > 0)
    }
}
