//! Prefetching: a run is requested before its result is needed, so that the controller works while the referee judges
//! the previous outcome.
//!
//! A session still has one open request at a time. The result goes only to the thread that requested the run. If that
//! thread runs something else, the prefetched run ends and its result is discarded.

use std::thread;

use gaugeblock_vocabulary::{Outcome, Scenario};

use super::Exec;
use super::pending_run::PrefetchedRun;
use super::run::Stopped;
use super::session::Session;
use crate::{Adapter as _, Expected, HarnessError};

impl Exec {
    /// Requests a run in an idle session. If there is none, or if it fails, the run is requested later.
    pub(super) fn begin_prefetch(&self, scenario: &Scenario) {
        self.discard_prefetched();
        // Observables have to be queried before the run.
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

    /// Runs a scenario, or takes its prefetched run.
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

    /// The session that is least useful, to make room for another one.
    pub(super) fn take_least_useful(&self) -> Option<Session> {
        let idle = self.take_session(|session| session.prefetched.is_none());
        idle.or_else(|| self.take_prefetching()).or_else(|| self.take_session(|_| true))
    }

    /// The session in which this thread has prefetched a run.
    fn take_prefetching(&self) -> Option<Session> {
        let own = thread::current().id();
        self.take_session(|session| {
            session.prefetched.as_ref().is_some_and(|begun| begun.thread == own)
        })
    }

    /// Waits for the end of a prefetched run of this thread and discards its result.
    fn discard_prefetched(&self) {
        if let Some(session) = self.take_prefetching() {
            // A failure ends that session. The next scenario is not to blame.
            let _nobody_asks = self.with_session(session, Session::finish_prefetched);
        }
    }
}

impl Session {
    /// Waits for the end of a prefetched run and discards its result.
    pub(super) fn finish_prefetched(&mut self) -> Result<(), Stopped> {
        let Some(PrefetchedRun { scenario, pending: asked, .. }) = self.prefetched.take() else {
            return Ok(());
        };
        self.receive_outcome(asked, &scenario, None).map(|_nobody_looks| ())
    }
}
