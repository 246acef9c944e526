//! Running controllers, kept for the next scenario with the same setup.

use std::collections::BTreeSet;
use std::sync::{Condvar, Mutex, PoisonError};

use gaugeblock_adapter::HarnessError;

use super::session::Session;
use super::setup::Setup;

/// How many controllers may run at once. Most of its time a controller waits for its own clocks: two processors serve
/// four of them.
pub(super) const MOST: usize = 4;

/// The controllers of one adapter; they end with it.
#[derive(Debug, Default)]
pub(super) struct Pool {
    state: Mutex<State>,
    freed: Condvar,
}

#[derive(Debug, Default)]
struct State {
    /// Those that wait, the longest waiting first.
    idle: Vec<Session>,
    /// How many run, waiting or not.
    alive: usize,
}

impl Pool {
    /// A controller of this setup in which none of the names was ever given a value, or a `new` one; another waiting
    /// one makes room where there are too many.
    ///
    /// # Errors
    /// It does not start.
    pub(super) fn take(
        &self,
        setup: &Setup,
        names: &BTreeSet<String>,
        tools: &str,
        new: bool,
    ) -> Result<Session, HarnessError> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            let fits = |session: &Session| {
                !new && session.setup == *setup && session.names.is_disjoint(names)
            };
            if let Some(place) = state.idle.iter().rposition(fits) {
                return Ok(state.idle.remove(place));
            }
            if state.alive < MOST {
                state.alive += 1;
                break;
            }
            if !state.idle.is_empty() {
                drop(state.idle.remove(0));
                break;
            }
            state = self.freed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
        drop(state);
        Session::start(setup, tools).inspect_err(|_| self.discard())
    }

    /// Gives a controller back that is as good as new.
    pub(super) fn give(&self, session: Session) {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).idle.push(session);
        self.freed.notify_one();
    }

    /// Ends a controller.
    pub(super) fn end(&self, session: Session) {
        drop(session);
        self.discard();
    }

    fn discard(&self) {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).alive -= 1;
        self.freed.notify_one();
    }
}
