//! The task around an interpreter: what a controller does with a program, and what a person does with the controller.
//!
//! ```text
//!              operator's requests                        what happens outside
//!                      │                                          │
//!                      ▼                                          ▼
//! Source ─► Task: mode, pause, abort ─► Interpreter ─► Desk ─► Machine     effects, pins, time
//!                                                      │  panel, outputs, held motion, M66, M19
//!                                                      └► pins as a function of all that is in force
//! ```
//!
//! A [`Task`] runs an [`Interpreter`] and answers for everything that its sink would have to know of the controller:
//! it pauses at M0, M1 and M60, holds motion, lets outputs switch with it, waits for inputs, tool changers, spindles
//! and user-defined codes, derives the pins, and keeps to the modes of the controller. What a machine is, and what
//! time it is there, says a [`Machine`].
//!
//! **Invariants.**
//! * Time goes by in [`Machine::wait`] alone, which is the embedder's; the task computes when it wants to be called
//!   again.
//! * Pins are a function of the settings in force, of the panel and of the outputs: there is no second state to go
//!   astray.
//! * Nothing is allocated while a program runs.

mod by_hand;
mod choices;
mod desk;
mod effects;
mod held;
mod items;
mod machine;
mod outputs;
mod panel;
mod pins;
mod requests;
#[cfg(test)]
mod tests;
mod waits;

use alloc::boxed::Box;

use gaugeblock_vocabulary::{ControllerMode, End, FaultKind};

use crate::error::Error;
use crate::faults::{Fault, planted};
use crate::interpret::{Interpreter, Progress};
use crate::limits::Limit;
use crate::source::Source;

use by_hand::OneLine;
use desk::{Desk, Doing};

pub(crate) use choices::Choices;
pub use desk::Stuck;
pub use machine::{Happening, Input, Machine, Work, WorkState};

/// File name of blocks that are entered by hand.
pub const BY_HAND: &str = "mdi";

/// What a step of a task came to.
#[derive(Clone, Debug, PartialEq)]
pub enum Activity {
    /// There is more of the program, or of the block by hand.
    More,
    /// The block that was entered by hand has been executed, and did not end a program.
    Entered,
    /// The run has ended; the controller is idle.
    Ended(End),
    /// It waits for what will never come, by [`Happening::Never`].
    Stuck(Stuck),
}

/// What an idle controller is asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Idle {
    /// To run the program: [`Task::start`] is next, with its text from the beginning.
    Start,
    /// To execute a block that is entered by hand: [`Task::enter`] is next.
    Enter(alloc::string::String),
    /// For nothing any more, by [`Happening::Never`].
    Nothing,
}

/// A controller: an interpreter, the machine that it drives, and the state between both.
///
/// ```
/// use gaugeblock_interpreter::task::{Activity, Happening, Input, Machine, Task, Work, WorkState};
/// use gaugeblock_interpreter::{Interpreter, Limits, Memory, Reply, Sink};
/// use gaugeblock_vocabulary::scenario::Action;
/// use gaugeblock_vocabulary::{Effect, End, Pin, Settings};
///
/// /// A machine on which everything is done at once, and somebody resumes every pause.
/// #[derive(Default)]
/// struct Quick { now: f64, flood: Vec<f64> }
/// impl Sink for Quick {
///     fn set(&mut self, _line: u32, _changed: &Settings) {}
///     fn perform(&mut self, _line: u32, _effect: &Effect) -> Reply { Reply::Done }
/// }
/// impl Machine for Quick {
///     fn time(&self) -> f64 { self.now }
///     fn wait(&mut self, until: Option<f64>) -> Happening {
///         let Some(until) = until else { return Happening::Asked(Action::Resume) };
///         self.now = until;
///         Happening::Time
///     }
///     fn asked(&mut self) -> Option<Action> { None }
///     fn input(&self, _input: Input) -> f64 { 0.0 }
///     fn state_of(&mut self, _work: Work) -> WorkState { WorkState::Done }
///     fn pin(&mut self, pin: Pin, value: f64) {
///         if pin == Pin::CoolantFlood { self.flood.push(value); }
///     }
/// }
///
/// let interpreter = Interpreter::new(Default::default(), Default::default(), Limits::default())?;
/// let mut task = Task::new(interpreter, Quick::default());
/// let mut source = Memory::new("m8\nm0\ng4 p2\nm2\n");
/// task.start();
/// let end = loop {
///     match task.step(&mut source)? { Activity::More => {} other => break other }
/// };
/// assert_eq!(end, Activity::Ended(End::ProgramEnd));
/// assert_eq!(task.machine().now, 2.0);
/// assert_eq!(task.machine().flood, [1.0, 0.0]);
/// # Ok::<(), gaugeblock_interpreter::Error>(())
/// ```
#[derive(Debug)]
pub struct Task<M> {
    /// It is large, and would be carried from place to place.
    interpreter: Box<Interpreter>,
    desk: Desk<M>,
}

impl<M: Machine> Task<M> {
    /// A controller that is idle, in auto mode, with everything off and every override at 100 %.
    pub fn new(interpreter: impl Into<Box<Interpreter>>, machine: M) -> Self {
        let mut interpreter = interpreter.into();
        let desk = Desk::new(&interpreter, machine);
        let names = items::names(interpreter.machine());
        interpreter.declare_items(names);
        Self { interpreter, desk }
    }

    /// The interpreter.
    pub fn interpreter(&self) -> &Interpreter {
        &self.interpreter
    }

    /// The interpreter, for what a caller asks of it between steps.
    pub fn interpreter_mut(&mut self) -> &mut Interpreter {
        &mut self.interpreter
    }

    /// The machine.
    pub fn machine(&self) -> &M {
        &self.desk.machine
    }

    /// The machine.
    pub fn machine_mut(&mut self) -> &mut M {
        &mut self.desk.machine
    }

    /// Both parts, once the task is over.
    pub fn into_parts(self) -> (Box<Interpreter>, M) {
        (self.interpreter, self.desk.machine)
    }

    /// Mode of the controller.
    pub fn mode(&self) -> ControllerMode {
        self.desk.mode
    }

    /// Puts an idle controller into a mode, as it stands when it is switched on.
    pub fn set_mode(&mut self, mode: ControllerMode) {
        self.desk.mode = mode;
        self.interpreter.set_controller_mode(mode);
    }

    /// Begins the program at its first block, in auto mode; [`Self::step`] executes it.
    pub fn start(&mut self) {
        if !planted(Fault::StartsInMode) {
            self.desk.change_mode(ControllerMode::Auto);
        }
        self.interpreter.begin();
        self.interpreter.set_controller_mode(self.desk.mode);
        self.desk.begin(Doing::Program);
        self.interpreter.set_items(&self.desk.items);
    }

    /// The program begins again without an end, as M99 in the main program says: nothing is asked, and nothing changes.
    pub fn start_over(&mut self) {
        self.interpreter.begin_over();
        self.desk.begin(Doing::Program);
    }

    /// Whether a block has begun that is not over: it waits in between then.
    pub fn is_within_block(&self) -> bool {
        self.desk.within
    }

    /// Where the next block stands, its file and its line; none where the next step goes on within a block or ends
    /// the run.
    pub fn next_block<S: Source>(&mut self, source: &mut S) -> Option<(&str, u32)> {
        self.interpreter.next_block(source)
    }

    /// Executes a block, or a part of one. What the operator asks meanwhile is answered, and before the block what
    /// was asked before.
    ///
    /// # Errors
    /// As for [`Interpreter::step`]. The run is over then.
    pub fn step<S: Source>(&mut self, source: &mut S) -> Result<Activity, Error> {
        if self.desk.may_go_on().is_err() {
            return self.broken(source);
        }
        self.desk.within = true;
        let progress = self.interpreter.step(source, &mut self.desk);
        if self.desk.is_broken() {
            return self.broken(source);
        }
        match progress {
            Ok(Progress::More | Progress::Stopped) => Ok(Activity::More),
            Ok(Progress::Broken) => self.broken(source),
            Ok(Progress::Ended(end)) => {
                if matches!(end, End::ProgramEnd | End::PercentEnd) {
                    self.desk.ended();
                }
                self.interpreter.set_controller_mode(self.desk.mode);
                Ok(Activity::Ended(end))
            }
            Err(error) => Err(error),
        }
    }

    /// Executes a block that is entered by hand, the first line of a text, as line `number` of the file [`BY_HAND`];
    /// subs are found where `source` finds them. The mode is MDI mode then. It comes back with [`Activity::Entered`]
    /// or with an end.
    ///
    /// # Errors
    /// As for [`Interpreter::step`].
    pub fn enter<S: Source>(
        &mut self,
        text: &str,
        number: u32,
        source: &mut S,
    ) -> Result<Activity, Error> {
        self.enter_while(text, number, source, |_| true)
    }

    /// The same, as long as it may go on: that is asked between blocks, of which a call of a sub has many. It comes
    /// back with [`Activity::More`] where it may not; what begins next forgets the rest.
    ///
    /// # Errors
    /// As for [`Interpreter::step`].
    pub fn enter_while<S: Source>(
        &mut self,
        text: &str,
        number: u32,
        source: &mut S,
        mut may_go_on: impl FnMut(&Self) -> bool,
    ) -> Result<Activity, Error> {
        self.begin_entry(number);
        let text = text.split(['\r', '\n']).next().unwrap_or_default();
        let mut line = OneLine::new(text.as_bytes(), source);
        loop {
            match self.step_entry(&mut line)? {
                Activity::More if may_go_on(self) => {}
                Activity::More => return Ok(Activity::More),
                over @ (Activity::Entered | Activity::Ended(_) | Activity::Stuck(_)) => {
                    return Ok(over);
                }
            }
        }
    }

    /// Begins a block by hand.
    fn begin_entry(&mut self, number: u32) {
        self.desk.change_mode(ControllerMode::Mdi);
        self.interpreter.begin_by_hand(BY_HAND, number);
        self.desk.begin(Doing::ByHand);
        self.interpreter.set_items(&self.desk.items);
    }

    fn step_entry<S: Source>(&mut self, line: &mut OneLine<'_, S>) -> Result<Activity, Error> {
        let activity = self.step(line);
        let is_over = match &activity {
            Ok(Activity::More) => self.interpreter.needs_text() && line.is_over(),
            // A line without a block in it.
            Err(Error::Fault(fault)) => {
                let file_is_over =
                    fault.kind == Some(FaultKind::MissingEnd) && fault.block.is_none();
                file_is_over && line.is_over() && self.interpreter.call_level() == 0
            }
            Ok(_) | Err(_) => false,
        };
        if is_over {
            self.desk.within = false;
            return Ok(Activity::Entered);
        }
        activity
    }

    /// Lets time go by on an idle controller, until it is asked to execute something. Other requests are answered.
    pub fn idle(&mut self) -> Idle {
        loop {
            match self.desk.machine.wait(None) {
                Happening::Asked(action) => {
                    let idle = self.desk.asked_idle(action);
                    self.interpreter.set_controller_mode(self.desk.mode);
                    if self.desk.take_abort() {
                        self.desk.forget_waiting();
                        self.interpreter.abort_idle(&mut self.desk);
                        self.interpreter.set_controller_mode(self.desk.mode);
                    }
                    self.desk.look_at_spindles();
                    if let Some(idle) = idle {
                        return idle;
                    }
                }
                Happening::Never => return Idle::Nothing,
                Happening::Time | Happening::Changed => self.desk.look_at_spindles(),
            }
        }
    }

    /// What comes of a block that was broken off.
    ///
    /// # Errors
    /// More was to be read ahead than may be; the abort is done all the same.
    fn broken<S: Source>(&mut self, source: &mut S) -> Result<Activity, Error> {
        if let Some(why) = self.desk.take_open() {
            self.desk.machine.broken_off();
            let block = self.interpreter.block();
            return Ok(Activity::Ended(End::Unspecified { block, why: why.into() }));
        }
        if let Some(stuck) = self.desk.stuck() {
            return Ok(Activity::Stuck(stuck));
        }
        self.desk.machine.broken_off();
        let ahead = self.read_ahead(source);
        self.desk.take_abort();
        self.desk.forget_waiting();
        self.desk.take_over();
        self.interpreter.abort(&mut self.desk);
        self.desk.release_spindles();
        self.desk.look_at_spindles();
        self.desk.renew_pins();
        self.interpreter.set_controller_mode(self.desk.mode);
        ahead.map(|()| Activity::Ended(End::Aborted))
    }

    /// Where an abort leaves what was read ahead, the interpreter goes on up to a block that waits for the machine,
    /// and nothing of that is done.
    ///
    /// # Errors
    /// It comes to no such block, nor to an end, within as many blocks as may be read.
    fn read_ahead<S: Source>(&mut self, source: &mut S) -> Result<(), Error> {
        let read = if self.desk.reads_ahead() {
            self.interpreter.read_ahead();
            self.read_on(source)
        } else {
            Ok(())
        };
        // The block itself may have been read to where it waits for the machine.
        self.interpreter.stand();
        read
    }

    fn read_on<S: Source>(&mut self, source: &mut S) -> Result<(), Error> {
        for _ in 0..self.interpreter.limits.blocks_ahead {
            match self.interpreter.step(source, &mut self.desk) {
                Ok(Progress::More | Progress::Stopped) => {}
                Ok(Progress::Broken | Progress::Ended(_)) | Err(_) => return Ok(()),
            }
        }
        Err(Error::LimitExceeded { limit: Limit::BlocksAhead, block: self.interpreter.block() })
    }
}
