//! The task around an interpreter: what a controller does with a program, and what an operator does with the
//! controller.
//!
//! ```text
//!              operator's requests                        what happens outside
//!                      │                                          │
//!                      ▼                                          ▼
//! Source ─► Task: mode, pause, abort ─► Interpreter ─► TaskState ─► Machine     effects, pins, time
//!                                                      │  panel, outputs, held motion, M66, M19
//!                                                      └► pins as a function of all that is in force
//! ```
//!
//! A [`Task`] runs an [`Interpreter`] and answers for everything that its sink would have to know of the controller:
//! it pauses at M0, M1 and M60, holds motion, lets outputs switch with it, waits for inputs, tool changers, spindles
//! and user-defined codes, derives the pins, and keeps to the modes of the controller. A [`Machine`] supplies the
//! hardware and the time.
//!
//! **Invariants.**
//! * Time passes only in [`Machine::wait`], which the embedder implements; the task computes until when it waits.
//! * Pins are a function of the settings in force, of the panel and of the outputs: there is no second state that
//!   could differ.
//! * Nothing is allocated while a program runs.

mod choices;
mod effects;
mod items;
mod machine;
mod mdi;
mod motion_hold;
mod outputs;
mod panel;
mod pins;
mod requests;
mod state;
#[cfg(test)]
mod tests;
mod waits;

use alloc::boxed::Box;

use gaugeblock_vocabulary::{ControllerMode, End, FaultKind};

use crate::error::Error;
use crate::faults::{PlantedFault, planted};
use crate::interpret::{Interpreter, Progress};
use crate::limits::Limit;
use crate::source::Source;

use mdi::MdiSource;
use state::{RunKind, TaskState};

pub(crate) use choices::Choices;
pub use machine::{ExternalOperation, Input, Machine, OperationState, WaitEvent};
pub use state::Deadlock;

/// File name of MDI blocks.
pub const MDI_FILE: &str = "mdi";

/// The result of a step of a task.
#[derive(Clone, Debug, PartialEq)]
pub enum StepResult {
    /// There is more of the program, or of the MDI block.
    More,
    /// The MDI block has been executed, and did not end a program.
    MdiDone,
    /// The run has ended; the controller is idle.
    Ended(End),
    /// It waits for something that never happens, by [`WaitEvent::Never`].
    Deadlock(Deadlock),
}

/// A request to an idle controller.
#[derive(Clone, Debug, PartialEq)]
pub enum IdleRequest {
    /// Run the program: [`Task::start`] is next, with its text from the beginning.
    Start,
    /// Execute an MDI block: [`Task::execute_mdi`] is next.
    Mdi(alloc::string::String),
    /// No request will come any more, by [`WaitEvent::Never`].
    None,
}

/// A controller: an interpreter, the machine that it drives, and the state between both.
///
/// ```
/// use gaugeblock_interpreter::task::{StepResult, WaitEvent, Input, Machine, Task, ExternalOperation, OperationState};
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
///     fn wait(&mut self, until: Option<f64>) -> WaitEvent {
///         let Some(until) = until else { return WaitEvent::Requested(Action::Resume) };
///         self.now = until;
///         WaitEvent::Time
///     }
///     fn poll_request(&mut self) -> Option<Action> { None }
///     fn input(&self, _input: Input) -> f64 { 0.0 }
///     fn operation_state(&mut self, _operation: ExternalOperation) -> OperationState { OperationState::Done }
///     fn set_pin(&mut self, pin: Pin, value: f64) {
///         if pin == Pin::CoolantFlood { self.flood.push(value); }
///     }
/// }
///
/// let interpreter = Interpreter::new(Default::default(), Default::default(), Limits::default())?;
/// let mut task = Task::new(interpreter, Quick::default());
/// let mut source = Memory::new("m8\nm0\ng4 p2\nm2\n");
/// task.start();
/// let end = loop {
///     match task.step(&mut source)? { StepResult::More => {} other => break other }
/// };
/// assert_eq!(end, StepResult::Ended(End::ProgramEnd));
/// assert_eq!(task.machine().now, 2.0);
/// assert_eq!(task.machine().flood, [1.0, 0.0]);
/// # Ok::<(), gaugeblock_interpreter::Error>(())
/// ```
#[derive(Debug)]
pub struct Task<M> {
    /// It is large, and moves would copy it.
    interpreter: Box<Interpreter>,
    state: TaskState<M>,
}

impl<M: Machine> Task<M> {
    /// A controller that is idle, in auto mode, with everything off and every override at 100 %.
    pub fn new(interpreter: impl Into<Box<Interpreter>>, machine: M) -> Self {
        let mut interpreter = interpreter.into();
        let state = TaskState::new(&interpreter, machine);
        let names = items::names(interpreter.machine());
        interpreter.declare_items(names);
        Self { interpreter, state }
    }

    /// The interpreter.
    pub fn interpreter(&self) -> &Interpreter {
        &self.interpreter
    }

    /// The interpreter, for a caller's queries between steps.
    pub fn interpreter_mut(&mut self) -> &mut Interpreter {
        &mut self.interpreter
    }

    /// The machine.
    pub fn machine(&self) -> &M {
        &self.state.machine
    }

    /// The machine.
    pub fn machine_mut(&mut self) -> &mut M {
        &mut self.state.machine
    }

    /// Both parts, once the task is over.
    pub fn into_parts(self) -> (Box<Interpreter>, M) {
        (self.interpreter, self.state.machine)
    }

    /// Mode of the controller.
    pub fn mode(&self) -> ControllerMode {
        self.state.mode
    }

    /// Sets the mode of an idle controller, as after it is switched on.
    pub fn set_mode(&mut self, mode: ControllerMode) {
        self.state.mode = mode;
        self.interpreter.set_controller_mode(mode);
    }

    /// Begins the program at its first block, in auto mode; [`Self::step`] executes it.
    pub fn start(&mut self) {
        if !planted(PlantedFault::StartsInMode) {
            self.state.change_mode(ControllerMode::Auto);
        }
        self.interpreter.begin();
        self.interpreter.set_controller_mode(self.state.mode);
        self.state.begin(RunKind::Program);
        self.interpreter.set_items(&self.state.items);
    }

    /// Begins the program again without an end, as M99 in the main program does: nothing else changes.
    pub fn start_over(&mut self) {
        self.interpreter.restart();
        self.state.begin(RunKind::Program);
    }

    /// Whether a block has begun and is not over: the controller waits within it.
    pub fn is_within_block(&self) -> bool {
        self.state.within_block
    }

    /// The place of the next block, its file and its line; none where the next step continues a block or ends the
    /// run.
    pub fn next_block<S: Source>(&mut self, source: &mut S) -> Option<(&str, u32)> {
        self.interpreter.next_block(source)
    }

    /// Executes a block, or a part of one. It handles the operator's requests during the block, and before it those
    /// that came earlier.
    ///
    /// # Errors
    /// As for [`Interpreter::step`]. The run is over then.
    pub fn step<S: Source>(&mut self, source: &mut S) -> Result<StepResult, Error> {
        if self.state.wait_while_paused().is_err() {
            return self.finish_abort(source);
        }
        self.state.within_block = true;
        let progress = self.interpreter.step(source, &mut self.state);
        if self.state.is_aborted() {
            return self.finish_abort(source);
        }
        match progress {
            Ok(Progress::More | Progress::Stopped) => Ok(StepResult::More),
            Ok(Progress::Aborted) => self.finish_abort(source),
            Ok(Progress::Ended(end)) => {
                if matches!(end, End::ProgramEnd | End::PercentEnd) {
                    self.state.end_program();
                }
                self.interpreter.set_controller_mode(self.state.mode);
                Ok(StepResult::Ended(end))
            }
            Err(error) => Err(error),
        }
    }

    /// Executes an MDI block, the first line of a text, as line `number` of the file [`MDI_FILE`]; subs are found
    /// where `source` finds them. The mode is MDI mode then. It returns [`StepResult::MdiDone`] or an end.
    ///
    /// # Errors
    /// As for [`Interpreter::step`].
    pub fn execute_mdi<S: Source>(
        &mut self,
        text: &str,
        number: u32,
        source: &mut S,
    ) -> Result<StepResult, Error> {
        self.execute_mdi_while(text, number, source, |_| true)
    }

    /// The same, as long as `may_go_on` returns true. It is called between blocks, of which a call of a sub has many.
    /// If it returns false the result is [`StepResult::More`], and the rest is dropped by the next program or block.
    ///
    /// # Errors
    /// As for [`Interpreter::step`].
    pub fn execute_mdi_while<S: Source>(
        &mut self,
        text: &str,
        number: u32,
        source: &mut S,
        mut may_go_on: impl FnMut(&Self) -> bool,
    ) -> Result<StepResult, Error> {
        self.begin_mdi(number);
        let text = text.split(['\r', '\n']).next().unwrap_or_default();
        let mut line = MdiSource::new(text.as_bytes(), source);
        loop {
            match self.step_mdi(&mut line)? {
                StepResult::More if may_go_on(self) => {}
                StepResult::More => return Ok(StepResult::More),
                over @ (StepResult::MdiDone | StepResult::Ended(_) | StepResult::Deadlock(_)) => {
                    return Ok(over);
                }
            }
        }
    }

    /// Begins an MDI block.
    fn begin_mdi(&mut self, number: u32) {
        self.state.change_mode(ControllerMode::Mdi);
        self.interpreter.begin_mdi(MDI_FILE, number);
        self.state.begin(RunKind::Mdi);
        self.interpreter.set_items(&self.state.items);
    }

    fn step_mdi<S: Source>(&mut self, line: &mut MdiSource<'_, S>) -> Result<StepResult, Error> {
        let activity = self.step(line);
        let is_over = match &activity {
            Ok(StepResult::More) => self.interpreter.needs_text() && line.is_over(),
            // The line holds no block.
            Err(Error::Fault(fault)) => {
                let file_is_over =
                    fault.kind == Some(FaultKind::MissingEnd) && fault.block.is_none();
                file_is_over && line.is_over() && self.interpreter.call_level() == 0
            }
            Ok(_) | Err(_) => false,
        };
        if is_over {
            self.state.within_block = false;
            return Ok(StepResult::MdiDone);
        }
        activity
    }

    /// Lets time pass on an idle controller, until a request to execute something. It handles other requests.
    pub fn idle(&mut self) -> IdleRequest {
        loop {
            match self.state.machine.wait(None) {
                WaitEvent::Requested(action) => {
                    let idle = self.state.handle_idle_request(action);
                    self.interpreter.set_controller_mode(self.state.mode);
                    if self.state.take_abort() {
                        self.state.forget_waiting();
                        self.interpreter.abort_idle(&mut self.state);
                        self.interpreter.set_controller_mode(self.state.mode);
                    }
                    self.state.lock_oriented_spindles();
                    if let Some(idle) = idle {
                        return idle;
                    }
                }
                WaitEvent::Never => return IdleRequest::None,
                WaitEvent::Time | WaitEvent::Changed => self.state.lock_oriented_spindles(),
            }
        }
    }

    /// Finishes an aborted block, and with it the run.
    ///
    /// # Errors
    /// More blocks would be read ahead than the limit allows; the abort is still complete.
    fn finish_abort<S: Source>(&mut self, source: &mut S) -> Result<StepResult, Error> {
        if let Some(why) = self.state.take_unspecified() {
            self.state.machine.discard_block();
            let block = self.interpreter.block();
            return Ok(StepResult::Ended(End::Unspecified { block, why: why.into() }));
        }
        if let Some(deadlock) = self.state.deadlock() {
            return Ok(StepResult::Deadlock(deadlock));
        }
        self.state.machine.discard_block();
        let ahead = self.read_ahead(source);
        self.state.take_abort();
        self.state.forget_waiting();
        self.state.apply_read_ahead();
        self.interpreter.abort(&mut self.state);
        self.state.release_spindles();
        self.state.lock_oriented_spindles();
        self.state.update_pins();
        self.interpreter.set_controller_mode(self.state.mode);
        ahead.map(|()| StepResult::Ended(End::Aborted))
    }

    /// Where an abort keeps what was read ahead, the interpreter reads up to a block that waits for the machine, and
    /// executes nothing of it.
    ///
    /// # Errors
    /// It reaches neither such a block nor an end within the limit of blocks.
    fn read_ahead<S: Source>(&mut self, source: &mut S) -> Result<(), Error> {
        let read = if self.state.begin_read_ahead() {
            self.interpreter.begin_read_ahead();
            self.read_ahead_blocks(source)
        } else {
            Ok(())
        };
        // The block itself may have been read to where it waits for the machine.
        self.interpreter.end_read_ahead(&mut self.state);
        read
    }

    fn read_ahead_blocks<S: Source>(&mut self, source: &mut S) -> Result<(), Error> {
        for _ in 0..self.interpreter.limits.blocks_ahead {
            match self.interpreter.step(source, &mut self.state) {
                Ok(Progress::More | Progress::Stopped) => {}
                Ok(Progress::Aborted | Progress::Ended(_)) | Err(_) => return Ok(()),
            }
        }
        Err(Error::LimitExceeded { limit: Limit::BlocksAhead, block: self.interpreter.block() })
    }
}
