//! Requests that only check whether an adapter works.

use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::{Outcome, Scenario};

use super::session::{Session, request};
use super::{Exec, HarnessError};
use crate::Adapter as _;
use crate::protocol::{Extension, Operation, Reply, RunModes};

impl Exec {
    /// Requests an unknown operation, which has to be refused, and checks that the session goes on with a request that
    /// has an unknown member.
    ///
    /// # Errors
    /// Another answer.
    pub fn check_unknown_operation(&self) -> Result<(), HarnessError> {
        self.new_session()?.request_unknown_operation()
    }

    /// Runs a scenario in a new session that uses only these extensions.
    ///
    /// # Errors
    /// There is no outcome.
    pub fn run_with_extensions(
        &self,
        offers: &[Extension],
        scenario: &Scenario,
    ) -> Result<Outcome, HarnessError> {
        let mut session = self.new_session()?;
        session.restrict_extensions(offers);
        session.reset()?;
        session.run(scenario, None).map_err(|stopped| stopped.error)
    }

    /// The digest that it reports of a scenario's outcome. None if it sends the outcome itself.
    ///
    /// # Errors
    /// Another answer.
    #[expect(clippy::wildcard_enum_match_arm, reason = "whatever else is answered is amiss")]
    pub fn digest_of(&self, scenario: &Scenario) -> Result<Option<String>, HarnessError> {
        let mut session = self.new_session()?;
        session.reset()?;
        let modes = RunModes { digest: true, ..RunModes::default() };
        let run = Operation::Run { scenario: Box::new(scenario.clone()), modes };
        match session.request(&run)? {
            Reply::Digest(digest) => Ok(Some(digest)),
            Reply::Outcome(_) | Reply::File(_) => Ok(None),
            reply => Err(session.unexpected_reply(run.name(), &reply)),
        }
    }

    /// Cancels a run at once, then runs another scenario in the same session. None if `cancel` is not answered
    /// correctly.
    ///
    /// # Errors
    /// The second scenario has no outcome.
    pub fn run_after_cancel(
        &self,
        cancelled: &Scenario,
        then: &Scenario,
    ) -> Result<Option<Outcome>, HarnessError> {
        let mut session = self.new_session()?;
        session.reset()?;
        session.begin_request()?;
        let scenario = Box::new(cancelled.clone());
        let run = request(session.last, &Operation::Run { scenario, modes: RunModes::default() })?;
        if !session.cancel(run) {
            return Ok(None);
        }
        session.reset()?;
        session.run(then, None).map(Some).map_err(|stopped| stopped.error)
    }

    /// Runs a scenario after another one in the same session, without a reset in between.
    ///
    /// # Errors
    /// One of them has no outcome.
    pub fn run_after(
        &self,
        before: &Scenario,
        scenario: &Scenario,
    ) -> Result<Outcome, HarnessError> {
        let mut session = self.new_session()?;
        session.restrict_extensions(&[Extension::Fresh]);
        session.reset()?;
        session.run(before, None).map_err(|stopped| stopped.error)?;
        session.run(scenario, None).map_err(|stopped| stopped.error)
    }

    /// Queries what is observable of a scenario.
    ///
    /// # Errors
    /// No valid answer.
    pub fn query_observables_of(&self, scenario: &Scenario) -> Result<Capabilities, HarnessError> {
        let mut session = self.new_session()?;
        session.reset()?;
        session.query_observables(scenario, self.capabilities())
    }

    /// Runs a scenario and resets the session. The reported state has to equal that after the first reset.
    ///
    /// # Errors
    /// The state differs, or the controller returned no outcome.
    pub fn reset_after(&self, scenario: &Scenario) -> Result<(), HarnessError> {
        let mut session = self.new_session()?;
        session.reset()?;
        session.run(scenario, None).map_err(|stopped| stopped.error)?;
        session.reset()
    }
}

impl Session {
    /// Requests an unknown operation, then a reset with an unknown member.
    fn request_unknown_operation(&mut self) -> Result<(), HarnessError> {
        let line =
            format!("{{\"id\":{},\"op\":\"gaugeblock-unknown\",\"later\":[1]}}\n", self.last + 1);
        let reply = self.request_line(line.as_bytes(), "gaugeblock-unknown")?;
        if !matches!(reply, Reply::Refused(_)) {
            let what = format!("answered with `{}`", reply.name());
            return Err(HarnessError::Unreadable { what, line: String::new() });
        }
        let line = format!("{{\"id\":{},\"op\":\"reset\",\"later\":[1]}}\n", self.last + 1);
        let reply = self.request_line(line.as_bytes(), "reset")?;
        if matches!(reply, Reply::Done {}) {
            return Ok(());
        }
        Err(self.unexpected_reply("reset", &reply))
    }
}
