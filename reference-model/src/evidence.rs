//! Evidence: which rules a run reached, and with which outcome. It is never part of what is compared.

use std::collections::BTreeSet;

/// What a rule said about a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RuleOutcome {
    /// The block is allowed, and the rule decided what it does.
    Accepted,
    /// The block is refused.
    Refused,
}

/// The rules that a run reached.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Evidence(BTreeSet<(&'static str, RuleOutcome)>);

impl Evidence {
    /// The rule decided what an accepted block does.
    pub fn accepted(&mut self, rule: &'static str) {
        self.0.insert((rule, RuleOutcome::Accepted));
    }

    /// The rule refused a block.
    pub fn refused(&mut self, rule: &'static str) {
        self.0.insert((rule, RuleOutcome::Refused));
    }

    /// All that was reached, ordered by rule.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, RuleOutcome)> {
        self.0.iter().copied()
    }
}
