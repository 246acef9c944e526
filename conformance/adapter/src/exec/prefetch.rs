//! A run that is asked for before anybody waits for it: the controller works while what it did before is judged.
//!
//! One request is under way at a time, as ever. What comes of such a run is told to whoever asked for it, and to
//! nobody else. Where something else is run instead, it is let end, and nobody looks at what came of it.

use std::thread;

use gaugeblock_vocabulary::{Outcome, Scenario};

use super::Exec;
use super::pending_run::PrefetchedRun;
use super::run::Stopped;
use super::session::Session;
use crate::{Adapter as _, Expected, HarnessError};

impl Exec {
    /// Begins a run in an idle session. Where there is none, or it fails before, nothing is lost: it is begun when it
    /// is wanted.
    pub(super) fn begin_prefetch(&self, scenario: &Scenario) {
        self.discard_prefetched();
        // What is observed of it is asked first.
        if self.observables_vary() {
            return;
        }
        let Some(mut session) = self.idle_session() else { return };
        if let Ok(request) = session.encode_run(scenario, true) {
            let (by, asked) = (thread::current().id(), session.send_run(request));
            session.prefetched =
                Some(PrefetchedRun { thread: by, scenario: scenario.clone(), pending: asked });
        }
        self.sessions().push(session);
    }

    /// Runs a scenario, which this thread may have begun.
    pub(super) fn run_or_resume(
        &self,
        scenario: &Scenario,
        expected: Option<&Expected<'_>>,
    ) -> Result<Outcome, HarnessError> {
        let is_it = |begun: &PrefetchedRun| {
            begun.thread == thread::current().id() && begun.scenario == *scenario
        };
        let begun = self.take_session(|session| session.prefetched.as_ref().is_some_and(is_it));
        if let Some(mut session) = begun
            && let Some(PrefetchedRun { pending: asked, .. }) = session.prefetched.take()
        {
            return self.with_session(session, |session| {
                session.receive_outcome(asked, scenario, expected)
            });
        }
        self.discard_prefetched();
        self.with_new_session(|session| {
            self.query_observables(session, scenario)?;
            session.run(scenario, expected)
        })
    }

    /// The session that is missed least, where there may be no room for another one beside it.
    pub(super) fn take_least_useful(&self) -> Option<Session> {
        let idle = self.take_session(|session| session.prefetched.is_none());
        idle.or_else(|| self.take_prefetching()).or_else(|| self.take_session(|_| true))
    }

    /// The session of a run that this thread has begun.
    fn take_prefetching(&self) -> Option<Session> {
        let own = thread::current().id();
        self.take_session(|session| {
            session.prefetched.as_ref().is_some_and(|begun| begun.thread == own)
        })
    }

    /// Lets a run end that this thread has begun and does not want any more.
    fn discard_prefetched(&self) {
        if let Some(session) = self.take_prefetching() {
            // A session that fails in it is gone. That is no fault of what is run next.
            let _nobody_asks = self.with_session(session, Session::finish_prefetched);
        }
    }
}

impl Session {
    /// Lets a run end that nobody waits for.
    pub(super) fn finish_prefetched(&mut self) -> Result<(), Stopped> {
        let Some(PrefetchedRun { scenario, pending: asked, .. }) = self.prefetched.take() else {
            return Ok(());
        };
        self.receive_outcome(asked, &scenario, None).map(|_nobody_looks| ())
    }
}
