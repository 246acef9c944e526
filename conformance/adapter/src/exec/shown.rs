//! What is observed of one scenario, asked of a controller that offers to tell: in the same session, before it is run.

use std::sync::{Mutex, PoisonError};
use std::thread::{self, ThreadId};

use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::Scenario;

use super::Exec;
use super::session::{Session, unreadable};
use crate::protocol::{Offer, Operation, Reply};
use crate::{Adapter as _, HarnessError};

/// What was told of the scenario that each thread asked about last.
#[derive(Debug, Default)]
pub(super) struct Shown(Mutex<Vec<(ThreadId, Scenario, Capabilities)>>);

impl Shown {
    /// What this thread was told of the scenario.
    fn of(&self, scenario: &Scenario) -> Option<Capabilities> {
        let own = thread::current().id();
        let all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (.., shows) = all.iter().find(|(by, of, _)| *by == own && of == scenario)?;
        Some(shows.clone())
    }

    fn keep(&self, scenario: &Scenario, shows: Capabilities) {
        let own = thread::current().id();
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.retain(|(by, ..)| *by != own);
        all.push((own, scenario.clone(), shows));
    }
}

impl Exec {
    /// What it shows of a scenario: never more than it has declared.
    pub(super) fn shown_of(&self, scenario: &Scenario) -> Capabilities {
        if self.declaration.offers.contains(&Offer::Shows) && self.shown.of(scenario).is_none() {
            // Where it cannot tell, its whole declaration counts.
            let _told = self.within(|session| Ok(self.learn_what_is_shown(session, scenario)?));
        }
        self.shown.of(scenario).unwrap_or_else(|| self.capabilities().clone())
    }

    /// Asks what is observed of a scenario, where that is offered, and keeps the answer.
    pub(super) fn learn_what_is_shown(
        &self,
        session: &mut Session,
        scenario: &Scenario,
    ) -> Result<(), HarnessError> {
        if session.offers(Offer::Shows) {
            let own = self.capabilities();
            let told = session.shown(scenario, own)?;
            self.shown.keep(scenario, own.and(&told));
        }
        Ok(())
    }
}

impl Session {
    /// What it tells to show of a scenario, as a controller of which this is known.
    ///
    /// # Errors
    /// It does not tell, or has another word than the vocabulary.
    #[expect(clippy::wildcard_enum_match_arm, reason = "whatever else is answered is amiss")]
    pub(super) fn shown(
        &mut self,
        scenario: &Scenario,
        own: &Capabilities,
    ) -> Result<Capabilities, HarnessError> {
        let asked = Operation::Shows { scenario: Box::new(scenario.clone()) };
        match self.ask(&asked)? {
            Reply::Shows(shows) => {
                let told = shows.capabilities(own.clone());
                told.map_err(|error| unreadable("answer to `shows`", error.as_bytes()))
            }
            // It says so when it is to run it, too.
            Reply::Unsupported(_) => Ok(own.clone()),
            reply => Err(self.amiss(asked.name(), &reply)),
        }
    }
}
