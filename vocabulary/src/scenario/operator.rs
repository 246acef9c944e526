//! What a person or a panel does, and when.
//!
//! **When a block begins.** Each line that a run reaches is a block that begins, also if it does nothing: an `endif`
//! after a false condition, the end of a sub, a comment, a slash alone. Blank lines, lines that block delete skips,
//! percent signs and lines that are jumped over do not begin. A block begins when the one before it is over, also if
//! the program has been paused by then: it waits before it does anything.
//!
//! **In which order.** Events happen in the order of their times, events of one time as they are listed. Events that
//! are due when a block begins, or where the text ends, happen before anything else does; events that are due when a
//! dwell or a wait ends happen before it ends. What the environment does at the same time happens after them: an
//! encoder has not answered if its answer is due at the time of an abort.
//!
//! **A pause** delays what has not begun: the next move, the next block. What waits for a signal goes on waiting.
//!
//! **A block is executed move by move**, also if it is a canned cycle. Before a delayed move everything has been done
//! that precedes it in its block, the start of synchronisation with a spindle included, and is recorded although the
//! block is not over; nothing that follows it has been done, not even outputs that switch with a motion. An abort
//! leaves the controlled point where the last move ended. M19 waits for one spindle after the other, and each wait is
//! recorded when it begins.
//!
//! **MDI blocks** are lines of the file `mdi`. The line is the index of the event among those that enter a block, from
//! 1, as they are listed. So the name of a block does not depend on the others, and events can refer to it.
//!
//! **The end** of the run is that of the program or MDI block that ended last: by M2 or M30, by a percent sign, by an
//! abort. Other MDI blocks end nothing. A program whose lines are entered by hand ends as its last line does, and is
//! paused if that line ends nothing.

use alloc::string::String;

use crate::block::BlockLocation;
use crate::modes::ControllerMode;

/// An action of the operator at a point of the run.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct OperatorEvent {
    /// The point of the run.
    pub when: RunPoint,
    /// The action.
    pub action: Action,
}

/// A point of the run: an execution of a block, plus an offset on the interpreter's clock, which only dwells, waits and
/// pauses move, and the idle controller. At an offset of zero it comes before the block does anything. In the dynamics
/// layer the clock is the servo cycle.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RunPoint {
    /// The block.
    pub block: BlockLocation,
    /// Its k-th execution, from 1.
    #[cfg_attr(feature = "serde", serde(default = "first"))]
    pub execution: u32,
    /// Seconds after that execution began.
    #[cfg_attr(feature = "serde", serde(default))]
    pub offset: f64,
}

#[cfg(feature = "serde")]
fn first() -> u32 {
    1
}

/// An action of the operator.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Action {
    /// Start the program, or start it again.
    CycleStart,
    /// Pause.
    Pause,
    /// Resume.
    Resume,
    /// Abort.
    Abort,
    /// Request a mode of the controller.
    Mode(ControllerMode),
    /// Enter a block by hand.
    Mdi(String),
    /// Set the optional-stop switch.
    OptionalStop(bool),
    /// Set the feed override; 1 is 100 %.
    FeedOverride(f64),
    /// Set the rapid override; 1 is 100 %.
    RapidOverride(f64),
    /// Set a spindle's speed override; 1 is 100 %.
    SpindleOverride {
        /// Spindle number.
        spindle: u8,
        /// The factor; 1 is 100 %.
        factor: f64,
    },
    /// Press or release feed hold.
    FeedHold(bool),
}
