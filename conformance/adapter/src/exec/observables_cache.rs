//! What is observed of one scenario, asked of a controller that offers to tell: in the same session, before it is run.

use std::sync::{Mutex, PoisonError};
use std::thread::{self, ThreadId};

use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::Scenario;

use super::session::{Session, unreadable};
use crate::HarnessError;
use crate::protocol::{Operation, Reply};

/// What was told of the scenario that each thread asked about last.
#[derive(Debug, Default)]
pub(super) struct ObservablesCache(Mutex<Vec<(ThreadId, Scenario, Capabilities)>>);

impl ObservablesCache {
    /// What this thread was told of the scenario.
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
    /// What it tells to show of a scenario, as a controller of which this is known.
    ///
    /// # Errors
    /// It does not tell, or has another word than the vocabulary.
    #[expect(clippy::wildcard_enum_match_arm, reason = "whatever else is answered is amiss")]
    pub(super) fn query_observables(
        &mut self,
        scenario: &Scenario,
        own: &Capabilities,
    ) -> Result<Capabilities, HarnessError> {
        let asked = Operation::Shows { scenario: Box::new(scenario.clone()) };
        match self.request(&asked)? {
            Reply::Shows(observables) => {
                let told = observables.capabilities(own.clone());
                told.map_err(|error| unreadable("answer to `shows`", error.as_bytes()))
            }
            // It says so when it is to run it, too.
            Reply::Unsupported(_) => Ok(own.clone()),
            reply => Err(self.unexpected_reply(asked.name(), &reply)),
        }
    }
}
