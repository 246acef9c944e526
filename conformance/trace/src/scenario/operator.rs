//! What a person or a panel does, and when.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::fault::Block;
use crate::modes::ControllerMode;

/// An action of the operator at a point of the run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OperatorEvent {
    /// When.
    pub when: When,
    /// What.
    pub action: Action,
}

/// A point of the run: an execution of a block, plus an offset on the interpreter's clock, which only dwells, waits and
/// pauses move, and the idle controller. At an offset of zero it comes before the block does anything. In the dynamics
/// layer the clock is the servo cycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct When {
    /// The block.
    pub block: Block,
    /// Its k-th execution, from 1.
    #[serde(default = "first")]
    pub execution: u32,
    /// Seconds after that execution began.
    #[serde(default)]
    pub offset: f64,
}

fn first() -> u32 {
    1
}

/// What the operator does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
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
