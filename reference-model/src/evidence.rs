//! Evidence: which rules a run reached, and with which outcome. It is never part of what is compared.

use crate::by_name::ByName;

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
    rules: ByName<Reached>,
    /// Whether nothing is put down: what is only looked at reaches no rule.
    deaf: bool,
}

/// The outcomes with which a rule was reached.
#[derive(Clone, Copy, Debug, Default)]
struct Reached {
    accepted: bool,
    refused: bool,
}

impl Evidence {
    /// Evidence of what is only looked at: nothing that is reached counts.
    pub fn deaf() -> Self {
        Self { deaf: true, ..Self::default() }
    }

    /// The rule decided what an accepted block does.
    #[inline]
    pub fn accepted(&mut self, rule: &'static str) {
        if !self.deaf {
            self.rules.value(rule).accepted = true;
        }
    }

    /// The rule refused a block.
    #[inline]
    pub fn refused(&mut self, rule: &'static str) {
        if !self.deaf {
            self.rules.value(rule).refused = true;
        }
    }

    /// All that was reached, ordered by rule.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, RuleOutcome)> {
        let mut all: Vec<_> = self.reached().collect();
        all.sort_unstable();
        all.into_iter()
    }

    fn reached(&self) -> impl Iterator<Item = (&'static str, RuleOutcome)> {
        self.rules.iter().flat_map(|(rule, reached)| {
            let accepted = reached.accepted.then_some((rule, RuleOutcome::Accepted));
            let refused = reached.refused.then_some((rule, RuleOutcome::Refused));
            [accepted, refused].into_iter().flatten()
        })
    }
}

impl PartialEq for Evidence {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

impl Eq for Evidence {}

/// In how many runs each outcome of a rule was reached.
#[derive(Clone, Debug, Default)]
pub struct Tally(ByName<Runs>);

/// How many runs reached each outcome of a rule.
#[derive(Clone, Copy, Debug, Default)]
struct Runs {
    accepted: u64,
    refused: u64,
}

impl Tally {
    /// Counts what a run reached.
    pub fn add(&mut self, evidence: &Evidence) {
        for (rule, reached) in evidence.rules.iter() {
            let runs = self.0.value(rule);
            runs.accepted += u64::from(reached.accepted);
            runs.refused += u64::from(reached.refused);
        }
    }

    /// Counts what other runs reached.
    pub fn merge(&mut self, other: &Self) {
        for (rule, runs) in other.0.iter() {
            let all = self.0.value(rule);
            all.accepted += runs.accepted;
            all.refused += runs.refused;
        }
    }

    /// How many runs reached an outcome.
    pub fn runs_with(&self, rule: &str, outcome: RuleOutcome) -> u64 {
        let runs = self.0.get(rule).copied().unwrap_or_default();
        match outcome {
            RuleOutcome::Accepted => runs.accepted,
            RuleOutcome::Refused => runs.refused,
        }
    }

    /// Every outcome that was reached, and in how many runs; in no order that means anything.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, RuleOutcome, u64)> {
        let outcomes = self.0.iter().flat_map(|(rule, runs)| {
            [
                (rule, RuleOutcome::Accepted, runs.accepted),
                (rule, RuleOutcome::Refused, runs.refused),
            ]
        });
        outcomes.filter(|(_, _, runs)| *runs > 0)
    }
}

impl PartialEq for Tally {
    fn eq(&self, other: &Self) -> bool {
        let sorted = |tally: &Self| {
            let mut all: Vec<_> = tally.iter().collect();
            all.sort_unstable();
            all
        };
        sorted(self) == sorted(other)
    }
}

impl Eq for Tally {}
