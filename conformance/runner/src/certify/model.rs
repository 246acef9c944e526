//! The model's outcome of a case: computed where it is looked at, and once for all runs that share it.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::fmt;
use std::ops::Deref;
use std::sync::{Arc, Mutex, PoisonError};

use gaugeblock_vocabulary::{Outcome, Scenario};

/// Outcomes of the model that several runs share. Runs under other editions or options replace each other's.
#[derive(Default)]
pub struct ModelOutcomes(Mutex<BTreeMap<CaseKey, SharedOutcome>>);

/// Id of a rule, and name of its case.
type CaseKey = (String, String);
/// The scenario of the case, and its outcome.
type SharedOutcome = (Scenario, Arc<Outcome>);

impl fmt::Debug for ModelOutcomes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("ModelOutcomes")
    }
}

impl ModelOutcomes {
    /// The outcome of the scenario of a case.
    fn of(&self, rule: &str, case: &str, scenario: &Scenario) -> Arc<Outcome> {
        let key = (rule.to_owned(), case.to_owned());
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner).get(&key).cloned();
        if let Some((_, outcome)) = known.filter(|(other, _)| other == scenario) {
            return outcome;
        }
        let outcome = Arc::new(gaugeblock_reference::run(scenario).0);
        let entry = (scenario.clone(), Arc::clone(&outcome));
        self.0.lock().unwrap_or_else(PoisonError::into_inner).insert(key, entry);
        outcome
    }
}

/// The model's outcome of one case; the model runs when it is first looked at.
#[derive(Debug)]
pub(super) struct SpecifiedOutcome<'a> {
    pub(super) rule: &'a str,
    pub(super) case: &'a str,
    pub(super) scenario: &'a Scenario,
    pub(super) shared: Option<&'a ModelOutcomes>,
    pub(super) outcome: OnceCell<Arc<Outcome>>,
}

impl Deref for SpecifiedOutcome<'_> {
    type Target = Outcome;

    fn deref(&self) -> &Outcome {
        self.outcome.get_or_init(|| match self.shared {
            Some(shared) => shared.of(self.rule, self.case, self.scenario),
            None => Arc::new(gaugeblock_reference::run(self.scenario).0),
        })
    }
}
