//! Any controller: a command that speaks the [adapter protocol](crate::protocol) on its standard streams.
//!
//! Nothing of what it says is trusted. It runs in a process group of its own, with limits of time, output and memory; whoever breaks a limit, dies or
//! answers something else than was asked is ended with all that it started, and the next scenario gets a new one. What it declares before it runs
//! anything bounds what is asked of it and what is judged.

mod lines;
mod process;
mod session;
mod told;

use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use gaugeblock_trace::{Options, Outcome, Scenario};

use super::{Adapter, Capabilities, ControllerError, HarnessError};
use crate::protocol::{Declaration, needed};
pub(crate) use process::now;
use session::Session;

/// What a controller may cost.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Wall time of an answer.
    pub time: Duration,
    /// Bytes of an answer.
    pub bytes: usize,
    /// Bytes of memory of each of its processes.
    pub memory: u64,
    /// Bytes of each file that it writes.
    pub file: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { time: Duration::from_secs(10), bytes: 64 << 20, memory: 4 << 30, file: 1 << 30 }
    }
}

/// A controller behind the protocol.
#[derive(Debug)]
pub struct Exec {
    command: String,
    limits: Limits,
    /// Options that need not be told.
    assumed: Options,
    declaration: Declaration,
    capabilities: Capabilities,
    /// Sessions in which nothing runs.
    idle: Mutex<Vec<Session>>,
    /// Sessions that were of no use any more after a program had ended.
    spoilt: AtomicUsize,
}

impl Exec {
    /// Starts the command and asks what it is.
    ///
    /// # Errors
    /// It cannot be started, does not answer, or declares what is no declaration.
    pub fn start(command: &str, limits: Limits) -> Result<Self, ControllerError> {
        let (session, declaration) =
            Session::begin(command, limits).map_err(ControllerError::Broken)?;
        let capabilities = declaration.capabilities().map_err(|error| {
            ControllerError::Broken(HarnessError::Unreadable {
                what: "hello".to_owned(),
                line: error,
            })
        })?;
        let idle = Mutex::new(vec![session]);
        let (command, assumed) = (command.to_owned(), Options::default());
        let spoilt = AtomicUsize::new(0);
        Ok(Self { command, limits, assumed, declaration, capabilities, idle, spoilt })
    }

    /// Takes these options for the defaults of their choices: a scenario is told without them.
    #[must_use]
    pub fn assuming(self, assumed: Options) -> Self {
        self.sessions().iter_mut().for_each(|session| session.assume(&assumed));
        Self { assumed, ..self }
    }

    /// What it declared.
    pub fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    /// Asks for an operation that there is not, which has to be refused, and whether the session goes on after it.
    ///
    /// # Errors
    /// It is answered otherwise.
    pub fn asked_the_unknown(&self) -> Result<(), HarnessError> {
        self.new_session()?.ask_the_unknown()
    }

    /// A session that was reset. Where one that was used cannot be, that is not to be charged to the next scenario.
    fn session(&self) -> Result<Session, HarnessError> {
        let idle = self.sessions().pop();
        if let Some(mut session) = idle {
            if session.reset().is_ok() {
                return Ok(session);
            }
            if session.has_run() {
                self.spoilt.fetch_add(1, Ordering::Relaxed);
            }
        }
        let mut session = self.new_session()?;
        session.reset()?;
        Ok(session)
    }

    /// A session of its own. One that declares something else than the first is not the same controller.
    fn new_session(&self) -> Result<Session, HarnessError> {
        let (mut session, declaration) = Session::begin(&self.command, self.limits)?;
        session.assume(&self.assumed);
        if declaration != self.declaration {
            return Err(HarnessError::Unreadable {
                what: "it declares something else than before".to_owned(),
                line: format!("{} {}", declaration.name, declaration.version),
            });
        }
        Ok(session)
    }

    fn sessions(&self) -> std::sync::MutexGuard<'_, Vec<Session>> {
        self.idle.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Adapter for Exec {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn options(&self) -> Options {
        self.declaration.options.clone()
    }

    fn own_edition(&self) -> Option<&str> {
        self.declaration.edition.as_deref()
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        let Declaration { languages, units, features, .. } = &self.declaration;
        let language = scenario.program.language;
        if !languages.contains(&language) {
            return Err(format!("it does not speak {language}"));
        }
        let unit = scenario.machine.length_unit;
        if !units.contains(&unit) {
            return Err(format!("its machine has no unit {unit}"));
        }
        match needed(scenario).into_iter().find(|feature| !features.contains(*feature)) {
            Some(feature) => Err(format!("it declares no feature `{feature}`")),
            None => Ok(()),
        }
    }

    fn best_jobs(&self) -> Option<NonZero<usize>> {
        self.declaration.sessions.and_then(|jobs| NonZero::new(usize::from(jobs)))
    }

    fn notes(&self) -> Vec<String> {
        match self.spoilt.load(Ordering::Relaxed) {
            0 => Vec::new(),
            spoilt => vec![format!(
                "{spoilt} sessions spoke without being asked, died or could not be reset after a program had ended; new ones went on"
            )],
        }
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        let mut session = self.session()?;
        let outcome = session.run(scenario)?;
        // A session that failed is gone, with all that it started.
        self.sessions().push(session);
        Ok(outcome)
    }

    fn run_anew(&self, scenario: &Scenario) -> Option<Result<Outcome, HarnessError>> {
        let anew = || {
            let mut session = self.new_session()?;
            session.reset()?;
            session.run(scenario)
        };
        Some(anew())
    }
}
