//! Observables of one scenario. The referee queries them in the same session before the run.

use std::sync::{Mutex, PoisonError};
use std::thread::{self, ThreadId};

use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::Scenario;

use super::session::{Session, unreadable};
use crate::HarnessError;
use crate::protocol::{Operation, Reply};

/// The observables of the scenario that each thread queried last.
#[derive(Debug, Default)]
pub(super) struct ObservablesCache(Mutex<Vec<(ThreadId, Scenario, Capabilities)>>);

impl ObservablesCache {
    /// The observables that this thread got for the scenario.
    pub(super) fn get(&self, scenario: &Scenario) -> Option<Capabilities> {
        let own = thread::current().id();
        let all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (.., observables) = all.iter().find(|(by, of, _)| *by == own && of == scenario)?;
        Some(observables.clone())
    }

    pub(super) fn insert(&self, scenario: &Scenario, observables: Capabilities) {
        let own = thread::current().id();
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.retain(|(by, ..)| *by != own);
        all.push((own, scenario.clone(), observables));
    }
}

impl Session {
    /// Queries what is observable of a scenario.
    ///
    /// # Errors
    /// No answer, or a word that is not in the vocabulary.
    #[expect(clippy::wildcard_enum_match_arm, reason = "whatever else is answered is amiss")]
    pub(super) fn query_observables(
        &mut self,
        scenario: &Scenario,
        own: &Capabilities,
    ) -> Result<Capabilities, HarnessError> {
        let asked = Operation::Shows { scenario: Box::new(scenario.clone()) };
        match self.request(&asked)? {
            Reply::Shows(observables) => {
                let reported = observables.capabilities(own.clone());
                reported.map_err(|error| unreadable("answer to `shows`", error.as_bytes()))
            }
            // It gives the same answer to `run`.
            Reply::Unsupported(_) => Ok(own.clone()),
            reply => Err(self.unexpected_reply(asked.name(), &reply)),
        }
    }
}
