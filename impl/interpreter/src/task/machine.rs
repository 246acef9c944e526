//! The machine of a task: a sink with time, inputs, pins, and an operator.

use gaugeblock_vocabulary::scenario::Action;
use gaugeblock_vocabulary::{FaultKind, Pin};

use crate::canon::Sink;

/// A machine that a [`Task`](super::Task) drives.
///
/// As a [`Sink`] it is given settings and effects when they happen: a move when it may begin, a dwell or a wait when
/// it begins. The reply to an effect says whether it can be done at all; the task finds out by [`Self::wait`] and
/// [`Self::operation_state`] how long it takes.
pub trait Machine: Sink {
    /// Seconds since some beginning.
    fn time(&self) -> f64;

    /// Lets time pass until then, or until something happens. It returns at the first event, and once for each.
    fn wait(&mut self, until: Option<f64>) -> WaitEvent;

    /// Takes a request of the operator since the last call, without letting time pass. The task calls it between
    /// blocks.
    fn poll_request(&mut self) -> Option<Action>;

    /// The value of an input now; 0 and 1 for digital ones.
    fn input(&self, input: Input) -> f64;

    /// The state of the external operation that the last effect of its kind has begun.
    fn operation_state(&mut self, operation: ExternalOperation) -> OperationState;

    /// Sets a pin, which had another value.
    fn set_pin(&mut self, pin: Pin, value: f64);

    /// The last wait for an input ([`Effect::WaitInput`](gaugeblock_vocabulary::Effect::WaitInput)) is over, and this
    /// was read: -1 after a time-out.
    fn record_input(&mut self, _value: f64) {}

    /// Discards the block that is being executed, which was aborted: what it has begun is not done, and
    /// [`Sink::end_block`] is not called for it.
    fn discard_block(&mut self) {}

    /// Whether there is a program of a user-defined code. While the interpreter reads ahead it executes none, but
    /// refuses a code without one.
    fn has_user_program(&self, _code: u32) -> bool {
        true
    }

    /// Whether a person changes tools and needs a prompt for each.
    fn prompts_for_tools(&self) -> bool {
        false
    }
}

/// Why a wait is over.
#[derive(Clone, Debug, PartialEq)]
pub enum WaitEvent {
    /// The time that was waited for.
    Time,
    /// An input has changed, or an external operation is over.
    Changed,
    /// A request of the operator.
    Requested(Action),
    /// Nothing will ever happen: there is no time to wait for, and no operator. Only for simulated machines.
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

/// An operation that takes time outside of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExternalOperation {
    /// The tool change of M6.
    ToolChange,
    /// A spindle that turns to its angle.
    Orientation(u32),
    /// The program of a user-defined code.
    UserProgram,
}

/// The state of an external operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OperationState {
    /// It goes on.
    InProgress,
    /// It is done.
    Done,
    /// It has failed: the block is refused with this kind.
    Failed(FaultKind),
}
