//! A share of the cases, to run them again: which ones, and whether their verdicts are the same.

use std::collections::BTreeMap;

use gaugeblock_runner::certify::CaseResult;
use sha2::{Digest as _, Sha256};

use super::case::CertifiedCase;
use super::statement::Statement;

/// A case whose verdict is another one when it runs again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// Id of the rule.
    pub rule: String,
    /// Name of its case.
    pub case: String,
    /// What the certificate says.
    pub certified: String,
    /// What the other run found.
    pub found: String,
}

/// Rule and name of a share of all cases, at least one: the same seed selects the same cases, and another seed others.
pub fn sample(statements: &[&Statement], percent: usize, seed: u64) -> Vec<(String, String)> {
    let rules = statements.iter().flat_map(|statement| &statement.predicate.rules);
    let names = rules.flat_map(|rule| rule.cases.iter().map(|case| (&rule.rule, &case.case)));
    let rank = |(rule, case): (&String, &String)| {
        let digest = Sha256::digest(format!("{seed} {rule} / {case}")).to_vec();
        (digest, rule.clone(), case.clone())
    };
    let mut ranked: Vec<_> = names.map(rank).collect();
    ranked.sort();
    let count = (ranked.len() * percent).div_ceil(100);
    ranked.truncate(count);
    let mut chosen: Vec<_> = ranked.into_iter().map(|(_, rule, case)| (rule, case)).collect();
    chosen.sort();
    chosen
}

/// The cases that another run judges differently than the certificates. Whether a list accepts a divergence makes none.
pub fn changes(statements: &[&Statement], again: &[CaseResult<'_>]) -> Vec<Change> {
    let rules = statements.iter().flat_map(|statement| &statement.predicate.rules);
    let certified: BTreeMap<(&str, &str), &CertifiedCase> = rules
        .flat_map(|rule| {
            rule.cases.iter().map(|case| ((rule.rule.as_str(), case.case.as_str()), case))
        })
        .collect();
    let change = |result: &CaseResult<'_>| {
        let (rule, case) = (result.rule.id.as_str(), result.name);
        let certified = certified
            .get(&(rule, case))
            .map_or_else(|| "not certified".to_owned(), |certified| certified.repeatable());
        let found = CertifiedCase::of(result).repeatable();
        let (rule, case) = (rule.to_owned(), case.to_owned());
        (certified != found).then_some(Change { rule, case, certified, found })
    };
    again.iter().filter_map(change).collect()
}
