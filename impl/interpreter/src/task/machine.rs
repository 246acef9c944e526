//! What a task needs of a machine besides what an interpreter does: time, inputs, pins, and who operates it.

use gaugeblock_vocabulary::scenario::Action;
use gaugeblock_vocabulary::{FaultKind, Pin};

use crate::canon::Sink;

/// A machine that a [`Task`](super::Task) drives.
///
/// As a [`Sink`] it is given settings and effects when they happen: a move when it may begin, a dwell or a wait when
/// it begins. The reply to an effect says whether it can be done at all; how long it takes the task finds out by
/// [`Self::wait`] and [`Self::operation_state`].
pub trait Machine: Sink {
    /// Seconds since some beginning.
    fn time(&self) -> f64;

    /// Lets time go by until then, or until something happens. It comes back at the first happening, and once for each.
    fn wait(&mut self, until: Option<f64>) -> WaitEvent;

    /// What the operator has asked since the last time this was called, without letting time go by; the task asks
    /// between blocks.
    fn poll_request(&mut self) -> Option<Action>;

    /// The value of an input now; 0 and 1 for digital ones.
    fn input(&self, input: Input) -> f64;

    /// How far something is that the last effect of its kind has begun.
    fn operation_state(&mut self, operation: ExternalOperation) -> OperationState;

    /// Puts a value on a pin, which had another one.
    fn set_pin(&mut self, pin: Pin, value: f64);

    /// The last wait for an input ([`Effect::WaitInput`](gaugeblock_vocabulary::Effect::WaitInput)) is over, and this
    /// was read: -1 where nothing came in time.
    fn record_input(&mut self, _value: f64) {}

    /// The block that is being executed was broken off: what it has begun is not done, and [`Sink::end_block`] is
    /// not called for it.
    fn discard_block(&mut self) {}

    /// Whether there is a program of a user-defined code: where the interpreter reads ahead, it executes none, but
    /// misses one.
    fn has_user_program(&self, _code: u32) -> bool {
        true
    }

    /// Whether a person changes tools, and is to be asked for each.
    fn prompts_for_tools(&self) -> bool {
        false
    }
}

/// What has happened.
#[derive(Clone, Debug, PartialEq)]
pub enum WaitEvent {
    /// The time has come that was waited for.
    Time,
    /// An input has changed, or a work is over.
    Changed,
    /// The operator asks for something.
    Requested(Action),
    /// Nothing will ever happen: there is no time to wait for, and no one there. No real machine says so.
    Never,
}

/// An input of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// A digital input.
    Digital(u16),
    /// An analog input.
    Analog(u16),
    /// Adaptive feed: 0 holds motion, 1 is full speed (M52).
    AdaptiveFeed,
    /// The feed stop (M53).
    FeedHold,
}

/// What takes time outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExternalOperation {
    /// The tool change of M6.
    ToolChange,
    /// A spindle that turns to its angle.
    Orientation(u32),
    /// The program of a user-defined code.
    UserProgram,
}

/// How far a work is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OperationState {
    /// It goes on.
    InProgress,
    /// It is done.
    Done,
    /// It has failed: the block is refused with this kind.
    Failed(FaultKind),
}
