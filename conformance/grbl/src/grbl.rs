//! The controller as an adapter.

use std::num::NonZero;
use std::sync::{Mutex, MutexGuard, PoisonError};

use gaugeblock_adapter::{Adapter, ControllerError, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::{Outcome, Program, Scenario};

use crate::case::Case;
use crate::dialect::Dialect;
use crate::identity::{Identity, LanguageCheck};
use crate::interrupt::Interrupt;
use crate::port::{Traffic, Transcript};
use crate::session::{Limits, Session};
use crate::setup::{Motion, Setup};
use crate::stored::Written;
use crate::supports::{
    supports, supports_kept_offsets, supports_named_codes, supports_negative_codes,
};
use crate::words::Words;

/// A controller of the family.
#[derive(Debug)]
pub struct Grbl {
    setup: Setup,
    limits: Limits,
    identity: Identity,
    capabilities: Capabilities,
    language_check: Option<LanguageCheck>,
    interrupt: Interrupt,
    transcript: Option<Transcript>,
    link: Mutex<Link>,
}

/// The session, if there is one, and the traffic of those before.
#[derive(Debug)]
struct Link {
    session: Option<Session>,
    before: Traffic,
}

impl Grbl {
    /// The edition that describes Grbl 1.1.
    pub const EDITION: &str = "grbl-1.1";

    /// The edition that describes grblHAL.
    pub const HAL_EDITION: &str = "grblhal";

    /// The edition that describes what Grbl 1.1h really does.
    pub const OBSERVED: &str = "grbl-1.1-observed";

    /// The edition that describes what grblHAL really does.
    pub const HAL_OBSERVED: &str = "grblhal-observed";

    /// Connects to a controller, resets it and queries what it is. The first Ctrl-C then ends runs instead of the
    /// process, so that a machine is stopped and restored.
    ///
    /// # Errors
    /// Nothing answers, it does not belong to the family, or it is locked and may not be unlocked.
    pub fn open(setup: Setup, limits: Limits) -> Result<Self, ControllerError> {
        let interrupt = Interrupt::install();
        let transcript = setup.transcript.as_deref().map(Transcript::create).transpose();
        let transcript = transcript.map_err(ControllerError::Broken)?;
        let (mut session, welcome) = going_on(transcript.as_ref())
            .and_then(|transcript| Session::open(&setup, limits, interrupt.clone(), transcript))
            .map_err(ControllerError::Broken)?;
        let identity = Identity::query(&mut session, &welcome, &setup)?;
        let capabilities = identity.capabilities(setup.motion);
        let link = Mutex::new(Link { session: Some(session), before: Traffic::default() });
        let language_check = None;
        Ok(Self {
            setup,
            limits,
            identity,
            capabilities,
            language_check,
            interrupt,
            transcript,
            link,
        })
    }

    /// Leaves out programs that need a part of the language that the documents of the dialect do not list.
    #[must_use]
    pub fn check_language_by(mut self, check: LanguageCheck) -> Self {
        self.language_check = Some(check);
        self
    }

    /// Bytes that went over the link so far.
    pub fn traffic(&self) -> Traffic {
        let link = self.link();
        let now = link.session.as_ref().map(Session::traffic).unwrap_or_default();
        sum(link.before, now)
    }

    fn link(&self) -> MutexGuard<'_, Link> {
        self.link.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether the program may be sent to this controller.
    fn may_run(&self, scenario: &Scenario) -> Result<(), String> {
        supports(scenario, &self.setup)?;
        if self.identity.dialect == Dialect::GrblHal {
            supports_kept_offsets(&scenario.program, &self.setup, &self.identity.stored)?;
            supports_negative_codes(&scenario.program, &self.setup)?;
            supports_named_codes(&scenario.program)?;
        }
        Ok(())
    }

    /// Runs the program in a session that is reset, and closes a session whose connection has ended.
    fn run_in(&self, link: &mut Link, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        let mut session = match link.session.take() {
            Some(session) => session,
            None => self.reopen()?,
        };
        let run = self.run_guarded(&mut session, scenario);
        if run.is_err() {
            session.fail();
        }
        if session.is_closed() {
            link.before = sum(link.before, session.traffic());
        } else {
            link.session = Some(session);
        }
        run
    }

    fn reopen(&self) -> Result<Session, HarnessError> {
        let transcript = going_on(self.transcript.as_ref())?;
        let interrupt = self.interrupt.clone();
        let (mut session, _) = Session::open(&self.setup, self.limits, interrupt, transcript)?;
        session.unit = self.identity.unit;
        Ok(session)
    }

    /// Runs the program, stops a machine whose run failed, and restores what the program may have written.
    fn run_guarded(
        &self,
        session: &mut Session,
        scenario: &Scenario,
    ) -> Result<Outcome, HarnessError> {
        session.reset()?;
        session.make_ready(self.setup.unlock)?;
        let (identity, setup) = (&self.identity, &self.setup);
        let run = Case { session, identity, setup, scenario }.run();
        if run.is_err() && self.setup.motion == Motion::Real {
            // The run's own error says more.
            let _halted = session.halt();
        }
        if !changes_kept_offsets(&scenario.program, self.identity.dialect) {
            return run;
        }
        // The Ctrl-C that ended the run does not end this.
        let interrupted = self.interrupt.suspend();
        let restored = self.restore(session, &scenario.program);
        self.interrupt.resume(interrupted);
        match restored {
            Ok(()) => run,
            Err(error) => Err(HarnessError::NotRun(format!(
                "the offsets could not be restored ({error}); they were {:?}",
                self.identity.stored
            ))),
        }
    }

    /// Writes back the offsets that differ from those at the start, or may do so in digits that `$#` does not have.
    fn restore(&self, session: &mut Session, program: &Program) -> Result<(), HarnessError> {
        session.fail();
        session.reset()?;
        session.make_ready(self.setup.unlock)?;
        let refused = || HarnessError::NotRun("`$#` is refused".to_owned());
        let axes = self.identity.axes();
        let before = &self.identity.stored;
        let unit = self.identity.unit;
        let any = |test: fn(&Words) -> bool| blocks_of(program).any(|words| test(&words));
        let keeps = self.identity.dialect == Dialect::GrblHal;
        let written = Written {
            systems: any(Words::writes_coordinate_system),
            local: keeps && any(Words::changes_local_offset),
            tool: keeps && any(Words::changes_tool_offset),
        };
        let now = session.stored()?.ok_or_else(refused)?;
        for block in before.blocks_from(&now, &axes, unit, written) {
            session.accepted(&block)?;
        }
        let now = session.stored()?.ok_or_else(refused)?;
        match before.blocks_from(&now, &axes, unit, Written::default()).first() {
            None => Ok(()),
            Some(block) => Err(HarnessError::NotRun(format!("{block} has no effect"))),
        }
    }
}

impl Adapter for Grbl {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn observables(&self, scenario: &Scenario) -> Capabilities {
        self.identity.observables(&self.capabilities, &scenario.program)
    }

    fn observables_vary(&self) -> bool {
        true
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        self.may_run(scenario)?;
        match self.language_check {
            Some(check) => {
                check(&self.identity.dialect.language(&self.identity.features), scenario)
            }
            None => Ok(()),
        }
    }

    fn own_edition(&self) -> Option<&str> {
        Some(match self.identity.dialect {
            Dialect::Grbl => Self::EDITION,
            Dialect::GrblHal => Self::HAL_EDITION,
        })
    }

    fn observed_edition(&self) -> Option<&str> {
        Some(match self.identity.dialect {
            Dialect::Grbl => Self::OBSERVED,
            Dialect::GrblHal => Self::HAL_OBSERVED,
        })
    }

    fn best_jobs(&self) -> Option<NonZero<usize>> {
        Some(NonZero::<usize>::MIN)
    }

    fn is_out_of_process(&self) -> bool {
        true
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.setup.motion == Motion::Checked {
            notes.push(
                "programs run in check mode: no axis moves, and no position is observable"
                    .to_owned(),
            );
        }
        if !self.identity.stored.has_zero_systems() {
            notes.push(
                "a stored coordinate system is not zero, so that offsets of coordinate systems are not compared"
                    .to_owned(),
            );
        }
        if !self.identity.stored.has_zero_tool_offset() {
            notes.push(
                "a tool length offset is set, so that tool length offsets are not compared"
                    .to_owned(),
            );
        }
        notes
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        // What is refused here could move or change the machine.
        self.may_run(scenario).map_err(HarnessError::NotRun)?;
        self.interrupt.check()?;
        self.run_in(&mut self.link(), scenario)
    }
}

impl Drop for Grbl {
    /// Leaves check mode.
    fn drop(&mut self) {
        let _interrupted = self.interrupt.suspend();
        let link = self.link.get_mut().unwrap_or_else(PoisonError::into_inner);
        if let Some(session) = &mut link.session {
            let _reset = session.halt();
        }
    }
}

/// Whether a program can change offsets that a reset does not restore.
fn changes_kept_offsets(program: &Program, dialect: Dialect) -> bool {
    blocks_of(program).any(|words| {
        words.writes_coordinate_system()
            || words.changes_local_offset()
            || dialect == Dialect::GrblHal && words.changes_tool_offset()
    })
}

/// The transcript for another connection.
fn going_on(transcript: Option<&Transcript>) -> Result<Option<Transcript>, HarnessError> {
    transcript.map(Transcript::go_on).transpose()
}

/// The blocks of the main program.
fn blocks_of(program: &Program) -> impl Iterator<Item = Words> {
    program.language.lines(&program.main).map(Words::of)
}

fn sum(one: Traffic, other: Traffic) -> Traffic {
    Traffic { sent: one.sent + other.sent, received: one.received + other.received }
}
