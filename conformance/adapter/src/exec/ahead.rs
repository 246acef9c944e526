//! A run that is asked for before anybody waits for it: the controller works while what it did before is judged.
//!
//! One request is under way at a time, as ever. What comes of such a run is told to whoever asked for it, and to
//! nobody else. Where something else is run instead, it is let end, and nobody looks at what came of it.

use std::thread;

use gaugeblock_vocabulary::{Outcome, Scenario};

use super::Exec;
use super::begun::Begun;
use super::running::Stopped;
use super::session::Session;
use crate::{Adapter as _, Expected, HarnessError};

impl Exec {
    /// Begins a run in an idle session. Where there is none, or it fails before, nothing is lost: it is begun when it
    /// is wanted.
    pub(super) fn begin_ahead(&self, scenario: &Scenario) {
        self.let_begun_end();
        // What is observed of it is asked first.
        if self.shows_less_of_some() {
            return;
        }
        let Some(mut session) = self.idle_session() else { return };
        if let Ok(request) = session.request_to_run(scenario, true) {
            let (by, asked) = (thread::current().id(), session.ask_to_run(request));
            session.begun = Some(Begun { by, scenario: scenario.clone(), asked });
        }
        self.sessions().push(session);
    }

    /// Runs a scenario, which this thread may have begun.
    pub(super) fn run_in_turn(
        &self,
        scenario: &Scenario,
        expected: Option<&Expected<'_>>,
    ) -> Result<Outcome, HarnessError> {
        let is_it =
            |begun: &Begun| begun.by == thread::current().id() && begun.scenario == *scenario;
        let begun = self.taken(|session| session.begun.as_ref().is_some_and(is_it));
        if let Some(mut session) = begun
            && let Some(Begun { asked, .. }) = session.begun.take()
        {
            return self.with(session, |session| session.outcome_of(asked, scenario, expected));
        }
        self.let_begun_end();
        self.within(|session| {
            self.learn_what_is_shown(session, scenario)?;
            session.run(scenario, expected)
        })
    }

    /// The session that is missed least, where there may be no room for another one beside it.
    pub(super) fn dispensable(&self) -> Option<Session> {
        let idle = self.taken(|session| session.begun.is_none());
        idle.or_else(|| self.begun()).or_else(|| self.taken(|_| true))
    }

    /// The session of a run that this thread has begun.
    fn begun(&self) -> Option<Session> {
        let own = thread::current().id();
        self.taken(|session| session.begun.as_ref().is_some_and(|begun| begun.by == own))
    }

    /// Lets a run end that this thread has begun and does not want any more.
    fn let_begun_end(&self) {
        if let Some(session) = self.begun() {
            // A session that fails in it is gone. That is no fault of what is run next.
            let _nobody_asks = self.with(session, Session::let_run_end);
        }
    }
}

impl Session {
    /// Lets a run end that nobody waits for.
    pub(super) fn let_run_end(&mut self) -> Result<(), Stopped> {
        let Some(Begun { scenario, asked, .. }) = self.begun.take() else { return Ok(()) };
        self.outcome_of(asked, &scenario, None).map(|_nobody_looks| ())
    }
}
