//! Why a program is not planned to its end.

use gaugeblock_vocabulary::{Axis, BlockLocation};

/// Why a program is not planned to its end, and at which block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stopped {
    /// Where.
    pub block: Option<BlockLocation>,
    /// The reason.
    pub why: String,
    /// Whether planning never ends.
    pub endless: bool,
    /// Whether the motion takes more than [`SERVO_CYCLES_MAX`](super::SERVO_CYCLES_MAX); it is endless, then.
    pub too_long: bool,
    /// The axis that moves and has no limits.
    pub unlimited: Option<Axis>,
}

impl Stopped {
    pub(super) fn new(why: impl Into<String>) -> Self {
        Self { block: None, why: why.into(), endless: false, too_long: false, unlimited: None }
    }

    pub(super) fn endless(why: impl Into<String>) -> Self {
        Self { endless: true, ..Self::new(why) }
    }
}
