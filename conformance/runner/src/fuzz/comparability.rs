//! Which outcomes of rules two controllers cannot be compared on, by their declarations.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_reference::{RuleOutcome, run};
use gaugeblock_vocabulary::{Outcome, Scenario, Undetermined};

use super::Plan;
use super::statistics::name_of;

/// Outcomes of rules that no case reaches on both sides, and why.
pub type NotComparable = BTreeMap<String, String>;

/// The reason if no case reaches an outcome on any controller.
const NO_CASE: &str = "no case reaches them as these options read the documents";

impl Plan<'_> {
    /// Outcomes that no case reaches which both controllers run. The reason comes from the first case that would reach
    /// it: one side does not support it, or the model leaves it open.
    pub fn not_comparable<'r>(
        &self,
        outcomes: impl IntoIterator<Item = (&'r str, RuleOutcome)>,
        cases: impl IntoIterator<Item = Scenario>,
    ) -> NotComparable {
        let (mut shown, mut reasons) = (BTreeSet::new(), BTreeMap::new());
        for scenario in cases {
            let (outcome, coverage) = run(&scenario);
            let why = self.reason_not_compared(&scenario, &outcome);
            for reached in coverage.iter() {
                match &why {
                    None => {
                        shown.insert(reached);
                    }
                    Some(why) => {
                        reasons.entry(reached).or_insert_with(|| why.clone());
                    }
                }
            }
        }
        let not_shown = outcomes.into_iter().filter(|outcome| !shown.contains(outcome));
        let with_reason = not_shown.map(|outcome| {
            let why = reasons.get(&outcome).cloned();
            (name_of(outcome.0, outcome.1), why.unwrap_or_else(|| NO_CASE.to_owned()))
        });
        with_reason.collect()
    }

    /// Why a scenario is not compared, if the declarations or the model decide it.
    pub(super) fn reason_not_compared(
        &self,
        scenario: &Scenario,
        outcome: &Outcome,
    ) -> Option<String> {
        if let Some((name, why)) = self.reason_not_run(scenario) {
            return Some(format!("{name}: {why}"));
        }
        outcome.end.undetermined().map(|undetermined| match undetermined {
            Undetermined::Unsupported(what) => format!("reference: {what}"),
            Undetermined::Unspecified(why) => format!("left open: {why}"),
        })
    }
}
