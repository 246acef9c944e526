//! What an operator and the inputs of a machine do while it moves.

use alloc::vec::Vec;

/// What happens at a servo cycle. It counts for that cycle's sample and those after it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum MotionAction {
    /// The feed override; 1 is 100 %.
    FeedOverride(f64),
    /// The rapid override; 1 is 100 %.
    RapidOverride(f64),
    /// The adaptive feed input, -1 to 1; below zero the path is run backwards.
    AdaptiveFeed(f64),
    /// The feed stop input, which M53 lets act.
    FeedStop(bool),
    /// The operator holds the motion (`true`) or lets it go on (`false`), whatever the program says.
    Hold(bool),
    /// The operator aborts.
    Abort,
    /// A spindle turns so fast: turns per second.
    SpindleSpeed {
        /// Spindle number.
        spindle: u8,
        /// Turns per second.
        turns: f64,
    },
}

/// An action and its servo cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MotionEvent {
    /// The servo cycle, from 0 for the first sample.
    pub cycle: u32,
    /// What happens.
    pub action: MotionAction,
}

/// Actions in the order of their cycles. Before the first one overrides are at 1, nothing is held and no spindle's
/// speed is known.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MotionScript {
    /// What happens.
    pub events: Vec<MotionEvent>,
}
