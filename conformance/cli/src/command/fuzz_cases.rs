//! What `gaugeblock fuzz` takes from the suite: cases to make programs of, and outcomes of rules to reach.

use std::collections::BTreeSet;

use gaugeblock_reference::RuleOutcome as Reached;
use gaugeblock_runner::fuzz::Plan;
use gaugeblock_runner::fuzz::comparability::NotComparable;
use gaugeblock_runner::fuzz::statistics::Statistics;
use gaugeblock_runner::suite_check::editions_of;
use gaugeblock_suite::{Edition, RuleOutcome, Suite, scenario_of};
use gaugeblock_vocabulary::{Options, Scenario};

/// The suite's cases under an edition, as seeds of splices.
pub(crate) fn seeds(suite: &Suite, edition: &Edition, options: &Options) -> Vec<Scenario> {
    cases(suite, edition, options)
        .filter(|scenario| scenario.operator.is_empty() && scenario.program.main.len() < 2000)
        .collect()
}

/// The suite's cases under an edition.
fn cases(suite: &Suite, edition: &Edition, options: &Options) -> impl Iterator<Item = Scenario> {
    let runs = |rule, case| editions_of(suite, rule, case).iter().any(|e| e.id == edition.id);
    let cases = suite.rules.iter().flat_map(|rule| rule.cases.iter().map(move |case| (rule, case)));
    cases
        .filter(move |(rule, case)| runs(rule, case))
        .map(|(_, case)| scenario_of(case, options, edition))
}

/// The rules that the documents of an edition do not have.
pub(crate) fn void(suite: &Suite, edition: &Edition) -> BTreeSet<String> {
    let rules = suite.rules.iter().filter(|rule| !rule.exists_in(edition));
    rules.map(|rule| rule.id.clone()).collect()
}

/// The outcomes that the suite's rules may have under an edition.
pub(crate) fn outcomes<'a>(
    suite: &'a Suite,
    edition: &'a Edition,
) -> impl Iterator<Item = (&'a str, Reached)> {
    let rules = suite.rules.iter().filter(|rule| rule.exists_in(edition));
    rules.flat_map(|rule| {
        rule.outcomes.iter().map(move |outcome| {
            let reached = match outcome {
                RuleOutcome::Accepted => Reached::Accepted,
                RuleOutcome::Refused => Reached::Refused,
            };
            (rule.id.as_str(), reached)
        })
    })
}

/// What a run says little of: outcomes that few programs reached, and how many; and those that none did, and no case
/// does that can be compared on these two. Empty if only some statements are written.
pub(crate) fn rarely_reached(
    suite: &Suite,
    edition: &Edition,
    plan: &Plan<'_>,
    statistics: &Statistics,
) -> (Vec<(String, u64)>, NotComparable) {
    if !plan.config.only.is_empty() {
        return Default::default();
    }
    let mut rare = statistics.rarely_reached(outcomes(suite, edition));
    if rare.iter().all(|(_, programs)| *programs > 0) {
        return (rare, NotComparable::new());
    }
    let mut not_shown =
        plan.not_comparable(outcomes(suite, edition), cases(suite, edition, &plan.options));
    not_shown.retain(|name, _| rare.iter().any(|(rare, programs)| rare == name && *programs == 0));
    rare.retain(|(name, _)| !not_shown.contains_key(name));
    (rare, not_shown)
}
