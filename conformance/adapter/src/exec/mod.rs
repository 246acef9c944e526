//! Controllers outside of this process: a command that speaks the [adapter protocol](crate::protocol) on its standard
//! streams, or a server at an address.
//!
//! No answer is trusted. A command runs in a process group of its own, with limits of time, output and memory. If it
//! breaks a limit, dies or gives an unexpected answer, all of its processes are killed, and the next scenario gets a
//! new session. Its declaration comes before any run. Nothing beyond it is requested or judged.

mod command_files;
mod connection;
mod exchange_folder;
mod limits;
mod lines;
mod observables_cache;
mod pending_run;
mod prefetch;
mod process;
mod run;
mod scenario_encoder;
mod self_check;
mod session;

use std::num::NonZero;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use gaugeblock_compare::Capabilities;
pub use gaugeblock_vocabulary::LanguageCheck;
use gaugeblock_vocabulary::motion::Samples;
use gaugeblock_vocabulary::{Options, Outcome, Scenario};

use crate::protocol::{Declaration, Extension, needed};
use crate::{Adapter, ControllerError, Expected, HarnessError, MotionRequest, NoSamples};
use command_files::command_files;
use connection::Endpoint;
pub use limits::Limits;
use observables_cache::ObservablesCache;
pub use process::kill_sessions;
use run::Stopped;
use session::Session;

/// Sessions that are opened at once, if a controller declares more.
const MOST_SESSIONS: usize = 64;

/// A controller that speaks the protocol.
#[derive(Debug)]
pub struct Exec {
    endpoint: Endpoint,
    limits: Limits,
    /// Options that requests leave out, because the adapter assumes them.
    assumed_options: Options,
    declaration: Declaration,
    capabilities: Capabilities,
    /// How programs are checked against the declared language.
    language_check: Option<LanguageCheck>,
    /// Sessions without a run, or with a prefetched one.
    idle_sessions: Mutex<Vec<Session>>,
    /// The observables of the scenario that each thread ran last, if the adapter declares `shows`.
    observables_cache: ObservablesCache,
    /// How many sessions were lost after a program had ended.
    lost_sessions: AtomicUsize,
}

impl Exec {
    /// Starts the command and reads its declaration.
    ///
    /// # Errors
    /// It cannot be started, does not answer, or its declaration is not valid.
    pub fn start(command: &str, limits: Limits) -> Result<Self, ControllerError> {
        Self::from_endpoint(Endpoint::Command(command.to_owned()), limits)
    }

    /// Connects to an adapter that listens at `HOST:PORT`, and reads its declaration.
    ///
    /// # Errors
    /// No connection, no answer, or a declaration that is not valid.
    pub fn connect(address: &str, limits: Limits) -> Result<Self, ControllerError> {
        Self::from_endpoint(Endpoint::Address(address.to_owned()), limits)
    }

    fn from_endpoint(endpoint: Endpoint, limits: Limits) -> Result<Self, ControllerError> {
        let (session, declaration) =
            Session::open(&endpoint, limits).map_err(ControllerError::Broken)?;
        let capabilities = declaration.capabilities().map_err(|error| {
            ControllerError::Broken(HarnessError::Unreadable {
                what: "hello".to_owned(),
                line: error,
            })
        })?;
        let idle = Mutex::new(vec![session]);
        let (assumed, shown, spoilt) =
            (Options::default(), ObservablesCache::default(), AtomicUsize::new(0));
        Ok(Self {
            endpoint,
            limits,
            assumed_options: assumed,
            declaration,
            capabilities,
            language_check: None,
            idle_sessions: idle,
            observables_cache: shown,
            lost_sessions: spoilt,
        })
    }

    /// Leaves these options out of requests, because the adapter assumes them.
    #[must_use]
    pub fn assume_options(self, assumed: Options) -> Self {
        self.sessions().iter_mut().for_each(|session| session.assume_options(&assumed));
        Self { assumed_options: assumed, ..self }
    }

    /// Leaves out programs that are not in the declared language.
    #[must_use]
    pub fn check_language_by(self, check: LanguageCheck) -> Self {
        Self { language_check: Some(check), ..self }
    }

    /// Its declaration.
    pub fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    /// Runs `work` in a session that was reset.
    fn with_new_session<T>(
        &self,
        work: impl FnOnce(&mut Session) -> Result<T, Stopped>,
    ) -> Result<T, HarnessError> {
        self.with_session(self.session()?, work)
    }

    /// Runs `work` in a session, and keeps the session if it is still usable.
    fn with_session<T>(
        &self,
        mut session: Session,
        work: impl FnOnce(&mut Session) -> Result<T, Stopped>,
    ) -> Result<T, HarnessError> {
        session.expects_another_run = true;
        let done = work(&mut session);
        if done.as_ref().map_or_else(|stopped| stopped.session_usable, |_| true) {
            session.send_reset();
            self.sessions().push(session);
        } else {
            session.has_failed = true;
        }
        // A session that failed is dropped, with all of its processes.
        done.map_err(|stopped| stopped.error)
    }

    /// A session that was reset. If a used one cannot be reset, a new one takes its place: the next scenario is not to
    /// blame.
    fn session(&self) -> Result<Session, HarnessError> {
        if let Some(session) = self.idle_session() {
            return Ok(session);
        }
        let mut session = self.new_session()?;
        session.reset()?;
        Ok(session)
    }

    /// A used session without a run, after a reset.
    fn idle_session(&self) -> Option<Session> {
        let mut session = self.take_session(|session| session.prefetched.is_none())?;
        if session.reset().is_ok() {
            return Some(session);
        }
        if session.has_run() {
            self.lost_sessions.fetch_add(1, Ordering::Relaxed);
        }
        None
    }

    /// A new session. An adapter that declares something else than at first is not the same controller.
    fn new_session(&self) -> Result<Session, HarnessError> {
        if self.declaration.sessions.is_some() {
            // The adapter may not allow one more session.
            drop(self.take_least_useful());
        }
        let (mut session, declaration) = Session::open(&self.endpoint, self.limits)?;
        session.assume_options(&self.assumed_options);
        if declaration != self.declaration {
            return Err(HarnessError::Unreadable {
                what: "it declares something else than before".to_owned(),
                line: format!("{} {}", declaration.name, declaration.version),
            });
        }
        Ok(session)
    }

    /// The most recently used session that satisfies a condition.
    fn take_session(&self, is_such: impl Fn(&Session) -> bool) -> Option<Session> {
        let mut sessions = self.sessions();
        let place = sessions.iter().rposition(is_such)?;
        Some(sessions.remove(place))
    }

    fn sessions(&self) -> std::sync::MutexGuard<'_, Vec<Session>> {
        self.idle_sessions.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Adapter for Exec {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn observables(&self, scenario: &Scenario) -> Capabilities {
        self.observables_of(scenario)
    }

    fn observables_vary(&self) -> bool {
        self.declaration.offers.contains(&Extension::Shows)
    }

    fn options(&self) -> Options {
        self.declaration.options.clone()
    }

    fn files(&self) -> Vec<PathBuf> {
        match &self.endpoint {
            Endpoint::Command(command) => command_files(command),
            Endpoint::Address(_) => Vec::new(),
        }
    }

    fn observed_edition(&self) -> Option<&str> {
        self.declaration.observed.as_deref()
    }

    fn own_edition(&self) -> Option<&str> {
        self.declaration.edition.as_deref()
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        let Declaration { languages, units, features, .. } = &self.declaration;
        let language = scenario.program.language;
        if !languages.contains(&language) {
            return Err(format!("the language {language} is not supported"));
        }
        let unit = scenario.machine.length_unit;
        if !units.contains(&unit) {
            return Err(format!("its machine has no unit {unit}"));
        }
        if let Some(feature) =
            needed(scenario).into_iter().find(|feature| !features.contains(*feature))
        {
            return Err(format!("it declares no feature `{feature}`"));
        }
        match (&self.declaration.language, self.language_check) {
            (None, _) => Ok(()),
            (Some(declared), Some(check)) => check(declared, scenario),
            (Some(_), None) => Err("it declares a language, which is not checked here".to_owned()),
        }
    }

    fn best_jobs(&self) -> Option<NonZero<usize>> {
        self.declaration
            .sessions
            .and_then(|jobs| NonZero::new(usize::from(jobs).min(MOST_SESSIONS)))
    }

    fn notes(&self) -> Vec<String> {
        match self.lost_sessions.load(Ordering::Relaxed) {
            0 => Vec::new(),
            spoilt => vec![format!(
                "{spoilt} sessions wrote a line without a request, ended or could not be reset after a program; new sessions replaced them"
            )],
        }
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        self.run_or_resume(scenario, None)
    }

    fn prefetch(&self, scenario: &Scenario) {
        self.begin_prefetch(scenario);
    }

    fn is_out_of_process(&self) -> bool {
        true
    }

    fn run_expecting(
        &self,
        scenario: &Scenario,
        expected: &Expected<'_>,
    ) -> Result<Outcome, HarnessError> {
        self.run_or_resume(scenario, Some(expected))
    }

    fn record_motion(&self, motion: &MotionRequest<'_>) -> Result<Samples, NoSamples> {
        if !self.declaration.offers.contains(&Extension::Motion) {
            return Err(NoSamples::Unsupported("it reports no servo samples".to_owned()));
        }
        self.supports(motion.scenario).map_err(NoSamples::Unsupported)?;
        self.with_new_session(|session| session.record_motion(motion))
            .unwrap_or_else(|error| Err(NoSamples::Failed(error)))
    }

    fn run_fresh(&self, scenario: &Scenario) -> Option<Result<Outcome, HarnessError>> {
        let anew = || {
            let mut session = self.new_session()?;
            session.reset()?;
            self.query_observables(&mut session, scenario)?;
            session.run(scenario, None).map_err(|stopped| stopped.error)
        };
        Some(anew())
    }
}

impl Exec {
    /// What is observable of a scenario: never more than the declaration.
    fn observables_of(&self, scenario: &Scenario) -> Capabilities {
        if self.declaration.offers.contains(&Extension::Shows)
            && self.observables_cache.get(scenario).is_none()
        {
            // If the query fails, the whole declaration counts.
            let _told =
                self.with_new_session(|session| Ok(self.query_observables(session, scenario)?));
        }
        self.observables_cache.get(scenario).unwrap_or_else(|| self.capabilities().clone())
    }

    /// Queries the observables of a scenario, if the adapter can report them, and keeps the answer.
    fn query_observables(
        &self,
        session: &mut Session,
        scenario: &Scenario,
    ) -> Result<(), HarnessError> {
        if session.has_extension(Extension::Shows) {
            let own = self.capabilities();
            let reported = session.query_observables(scenario, own)?;
            self.observables_cache.insert(scenario, own.and(&reported));
        }
        Ok(())
    }
}
