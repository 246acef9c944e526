//! Cases of the suite, run by the model.

use std::collections::BTreeSet;

use gaugeblock_suite::{Case, Edition, Rule, RuleOutcome, Suite, scenario_of};
use gaugeblock_vocabulary::Outcome;

/// The editions in which a case runs, the default edition first.
pub fn editions_of<'a>(suite: &'a Suite, rule: &Rule, case: &Case) -> Vec<&'a Edition> {
    let runs = |edition: &&Edition| rule.exists_in(edition) && case.runs_in(edition);
    let mut editions: Vec<_> = suite.editions.iter().filter(runs).collect();
    editions.sort_by_key(|edition| edition.id != gaugeblock_suite::DEFAULT_EDITION);
    editions
}

/// The model's outcome in a case under an edition, and the rules that it reached.
pub fn model_run(
    suite: &Suite,
    case: &Case,
    edition: &Edition,
) -> (Outcome, BTreeSet<(String, RuleOutcome)>) {
    let scenario = scenario_of(case, &suite.options(edition), edition);
    let (outcome, coverage) = gaugeblock_reference::run(&scenario);
    let reached = coverage.iter().map(|(rule, reached)| {
        let outcome = match reached {
            gaugeblock_reference::RuleOutcome::Accepted => RuleOutcome::Accepted,
            gaugeblock_reference::RuleOutcome::Refused => RuleOutcome::Refused,
        };
        (rule.to_owned(), outcome)
    });
    (outcome, reached.collect())
}
