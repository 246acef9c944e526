//! Explanations that other cases of the run contradict.
//!
//! Another option of a choice can explain a divergence by chance: a controller that refuses an arc resembles an option
//! that refuses some arcs. The option changes other programs too. If more of these pass than it explains, the
//! controller does not have it.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_adapter::Adapter;
use gaugeblock_compare::compare;
use gaugeblock_compare::observe::Observed;
use gaugeblock_suite::scenario_of;
use gaugeblock_vocabulary::Options;

use super::verdict::{CaseResult, Verdict};
use super::{Plan, Scope};
use crate::observables::judged_observables;

/// A case; the cells of a grid, which are the same program under several conditions, count as one.
type CaseOrGrid<'a> = (&'a str, Result<usize, &'a str>);

/// Removes the explanations by one option that more cases contradict than have it.
pub(super) fn withdraw(
    plan: Plan<'_>,
    options: &Options,
    controller: &dyn Adapter,
    results: &mut [CaseResult<'_>],
) {
    if plan.scope == Scope::AssertionsOnly {
        return;
    }
    let mut explained: BTreeMap<String, BTreeSet<CaseOrGrid<'_>>> = BTreeMap::new();
    for result in results.iter() {
        if let Some(option) = option_of(result) {
            explained.entry(option.to_owned()).or_default().insert(case_or_grid(result));
        }
    }
    let mut passing: BTreeMap<String, BTreeSet<CaseOrGrid<'_>>> = BTreeMap::new();
    for result in results.iter().filter(|result| result.verdict == Verdict::Pass) {
        if explained.is_empty() {
            break;
        }
        for option in contradicted_by(result, plan, options, controller, explained.keys()) {
            let against = passing.entry(option).or_default();
            against.insert(case_or_grid(result));
        }
        explained.retain(|option, cases| {
            passing.get(option).is_none_or(|against| against.len() <= cases.len())
        });
    }
    for result in results {
        if option_of(result).is_some_and(|option| !explained.contains_key(option))
            && let Verdict::Diverges(it) | Verdict::SideDifference(it) = &mut result.verdict
        {
            it.explanation.clear();
        }
    }
}

fn case_or_grid<'a>(result: &CaseResult<'a>) -> CaseOrGrid<'a> {
    let grid = result.case().and_then(|case| case.grid);
    (&result.rule.id, grid.ok_or(result.name))
}

/// The option of a choice that alone explains a divergence, as `choice = option`.
fn option_of<'r>(result: &'r CaseResult<'_>) -> Option<&'r str> {
    match result.verdict.divergence()?.explanation.as_slice() {
        [one] if one.contains(IS) => Some(one),
        _ => None,
    }
}

/// Between a choice and its option.
const IS: &str = " = ";

/// The options under which a passing case would have another outcome.
fn contradicted_by<'o>(
    result: &CaseResult<'_>,
    plan: Plan<'_>,
    options: &Options,
    controller: &dyn Adapter,
    open: impl Iterator<Item = &'o String>,
) -> Vec<String> {
    let Some(case) = result.case() else { return Vec::new() };
    let scenario = scenario_of(case, options, plan.edition);
    let (specified, consulted) = gaugeblock_reference::run_consulting(&scenario);
    let found = Observed::of(&specified);
    let observables = judged_observables(controller, &scenario, plan.edition);
    let contradicts = |name: &&String| {
        let Some((choice, option)) = name.split_once(IS) else { return false };
        if consulted.as_ref().is_some_and(|consulted| !consulted.contains(choice)) {
            return false;
        }
        let mut other = scenario.clone();
        other.options.0.insert(choice.to_owned(), option.to_owned());
        let expected = gaugeblock_reference::run(&other).0;
        !compare(&Observed::of(&expected), &found, &observables).is_equal()
    };
    open.filter(contradicts).cloned().collect()
}
