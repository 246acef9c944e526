//! What a person or a panel does, and when.
//!
//! **When a block begins.** Each line that a run comes to is a block that begins, also where nothing of it is done:
//! an `endif` to which a condition that is false leads, the end of a sub, a comment, a slash alone. Blank lines,
//! those that block delete skips, percent signs and what is jumped over are none. A block begins when the one before
//! is over, also where the program has been paused by then: it stands before it does anything.
//!
//! **In which order.** Events happen in the order of their times, those at one time as they are listed. All that is
//! due when a block begins, or where the text ends, happens before anything else does; what is due when a dwell or a
//! wait ends comes before its end. What the environment does at the same time comes after it: an encoder at whose
//! answer somebody aborts has not answered.
//!
//! **A pause** holds what has not begun: the next move, the next block. What waits for something outside goes on
//! waiting.
//!
//! **A block is done move by move**, also where it is a canned cycle. Before a move that is held everything has been
//! done that comes before it in its block, the start of synchronisation with a spindle too, and is recorded although
//! the block is not over; nothing that comes after it has, not even that outputs switch which wait for a motion. An
//! abort leaves the controlled point where the last move has led. M19 waits for one spindle after the other, each
//! wait being told of where it begins.
//!
//! **Blocks by hand** are lines of the file `mdi`, the line being the place of the event among those that enter one,
//! from 1, as they are listed. So a block has a name whatever becomes of the others, and events can stand at it.
//!
//! **The end** of the run is that of the program or block by hand that ended last: by M2 or M30, by a percent sign,
//! by an abort. Other blocks by hand end nothing. A program whose lines are entered by hand ends as its last line
//! does, paused if that ends nothing.

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
    /// When.
    pub when: RunPoint,
    /// What.
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

/// What the operator does.
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
    /// Ask for a mode of the controller.
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
        /// 1 is 100 %.
        factor: f64,
    },
    /// Press or release feed hold.
    FeedHold(bool),
}
