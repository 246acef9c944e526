//! Any controller: a command that speaks the [adapter protocol](crate::protocol) on its standard streams, or whoever
//! speaks it at an address.
//!
//! Nothing of what it says is trusted. It runs in a process group of its own, with limits of time, output and memory;
//! whoever breaks a limit, dies or answers something else than was asked is ended with all that it started, and the
//! next scenario gets a new one. What it declares before it runs anything bounds what is asked of it and what is
//! judged.

mod ahead;
mod begun;
mod limits;
mod lines;
mod peer;
mod process;
mod running;
mod session;
mod shown;
mod side;
mod told;
mod trial;

use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::motion::Samples;
use gaugeblock_vocabulary::{Options, Outcome, Scenario};

use crate::protocol::{Declaration, Offer, needed};
use crate::{Adapter, ControllerError, Expected, HarnessError, Motion, NotMoved};
pub use limits::Limits;
use peer::Door;
use running::Stopped;
use session::Session;
use shown::Shown;

/// A controller behind the protocol.
#[derive(Debug)]
pub struct Exec {
    door: Door,
    limits: Limits,
    /// Options that need not be told.
    assumed: Options,
    declaration: Declaration,
    capabilities: Capabilities,
    /// Sessions in which nothing runs, or a run that nobody waits for yet.
    idle: Mutex<Vec<Session>>,
    /// What was observed of the scenario that each thread ran last, where that is asked for.
    shown: Shown,
    /// Sessions that were of no use any more after a program had ended.
    spoilt: AtomicUsize,
}

impl Exec {
    /// Starts the command and asks what it is.
    ///
    /// # Errors
    /// It cannot be started, does not answer, or declares what is no declaration.
    pub fn start(command: &str, limits: Limits) -> Result<Self, ControllerError> {
        Self::behind(Door::Command(command.to_owned()), limits)
    }

    /// Connects to an adapter that listens at `HOST:PORT`, and asks what it is.
    ///
    /// # Errors
    /// Nobody listens there, it does not answer, or it declares what is no declaration.
    pub fn connect(address: &str, limits: Limits) -> Result<Self, ControllerError> {
        Self::behind(Door::Address(address.to_owned()), limits)
    }

    fn behind(door: Door, limits: Limits) -> Result<Self, ControllerError> {
        let (session, declaration) =
            Session::begin(&door, limits).map_err(ControllerError::Broken)?;
        let capabilities = declaration.capabilities().map_err(|error| {
            ControllerError::Broken(HarnessError::Unreadable {
                what: "hello".to_owned(),
                line: error,
            })
        })?;
        let idle = Mutex::new(vec![session]);
        let (assumed, shown, spoilt) = (Options::default(), Shown::default(), AtomicUsize::new(0));
        Ok(Self { door, limits, assumed, declaration, capabilities, idle, shown, spoilt })
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

    /// Lets a session that was reset do something.
    fn within<T>(
        &self,
        work: impl FnOnce(&mut Session) -> Result<T, Stopped>,
    ) -> Result<T, HarnessError> {
        self.with(self.session()?, work)
    }

    /// Lets a session do something, and keeps it where it can go on.
    fn with<T>(
        &self,
        mut session: Session,
        work: impl FnOnce(&mut Session) -> Result<T, Stopped>,
    ) -> Result<T, HarnessError> {
        session.has_a_next = true;
        let done = work(&mut session);
        if done.as_ref().map_or_else(|stopped| stopped.goes_on, |_| true) {
            session.reset_ahead();
            self.sessions().push(session);
        } else {
            session.has_failed = true;
        }
        // Another session that failed is gone, with all that it started.
        done.map_err(|stopped| stopped.error)
    }

    /// A session that was reset. Where one that was used cannot be, that is not to be charged to the next scenario.
    fn session(&self) -> Result<Session, HarnessError> {
        if let Some(session) = self.idle_session() {
            return Ok(session);
        }
        let mut session = self.new_session()?;
        session.reset()?;
        Ok(session)
    }

    /// A session in which nothing runs, that was used and was reset.
    fn idle_session(&self) -> Option<Session> {
        let mut session = self.taken(|session| session.begun.is_none())?;
        if session.reset().is_ok() {
            return Some(session);
        }
        if session.has_run() {
            self.spoilt.fetch_add(1, Ordering::Relaxed);
        }
        None
    }

    /// A session of its own. One that declares something else than the first is not the same controller.
    fn new_session(&self) -> Result<Session, HarnessError> {
        if self.declaration.sessions.is_some() {
            // There may be no room for one more beside it.
            drop(self.dispensable());
        }
        let (mut session, declaration) = Session::begin(&self.door, self.limits)?;
        session.assume(&self.assumed);
        if declaration != self.declaration {
            return Err(HarnessError::Unreadable {
                what: "it declares something else than before".to_owned(),
                line: format!("{} {}", declaration.name, declaration.version),
            });
        }
        Ok(session)
    }

    /// The session that was used last of those that are kept and are such.
    fn taken(&self, is_such: impl Fn(&Session) -> bool) -> Option<Session> {
        let mut sessions = self.sessions();
        let place = sessions.iter().rposition(is_such)?;
        Some(sessions.remove(place))
    }

    fn sessions(&self) -> std::sync::MutexGuard<'_, Vec<Session>> {
        self.idle.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Adapter for Exec {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn shows(&self, scenario: &Scenario) -> Capabilities {
        self.shown_of(scenario)
    }

    fn shows_less_of_some(&self) -> bool {
        self.declaration.offers.contains(&Offer::Shows)
    }

    fn options(&self) -> Options {
        self.declaration.options.clone()
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
        self.run_in_turn(scenario, None)
    }

    fn ahead(&self, scenario: &Scenario) {
        self.begin_ahead(scenario);
    }

    fn runs_beside(&self) -> bool {
        true
    }

    fn run_expecting(
        &self,
        scenario: &Scenario,
        expected: &Expected<'_>,
    ) -> Result<Outcome, HarnessError> {
        self.run_in_turn(scenario, Some(expected))
    }

    fn moves(&self, motion: &Motion<'_>) -> Result<Samples, NotMoved> {
        if !self.declaration.offers.contains(&Offer::Motion) {
            return Err(NotMoved::Unsupported("it shows no servo samples".to_owned()));
        }
        self.supports(motion.scenario).map_err(NotMoved::Unsupported)?;
        self.within(|session| session.moves(motion))
            .unwrap_or_else(|error| Err(NotMoved::Failed(error)))
    }

    fn run_anew(&self, scenario: &Scenario) -> Option<Result<Outcome, HarnessError>> {
        let anew = || {
            let mut session = self.new_session()?;
            session.reset()?;
            self.learn_what_is_shown(&mut session, scenario)?;
            session.run(scenario, None).map_err(|stopped| stopped.error)
        };
        Some(anew())
    }
}

impl Exec {
    /// What it shows of a scenario: never more than it has declared.
    fn shown_of(&self, scenario: &Scenario) -> Capabilities {
        if self.declaration.offers.contains(&Offer::Shows) && self.shown.of(scenario).is_none() {
            // Where it cannot tell, its whole declaration counts.
            let _told = self.within(|session| Ok(self.learn_what_is_shown(session, scenario)?));
        }
        self.shown.of(scenario).unwrap_or_else(|| self.capabilities().clone())
    }

    /// Asks what is observed of a scenario, where that is offered, and keeps the answer.
    fn learn_what_is_shown(
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
