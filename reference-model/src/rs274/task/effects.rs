//! Kinds of effects: moves, and what waits with a compensated move.

use gaugeblock_vocabulary::{Effect, LengthUnit};

/// The place of an effect that waits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting {
    /// The place of its block.
    pub(super) step: usize,
    /// Its place among the events of the block.
    pub(super) event: usize,
    /// The length unit of its block.
    pub(super) units: LengthUnit,
}

/// Whether an effect waits if a compensated move before it does.
///
/// docs/compensation.md, "What waits": moves, G4 and M19; messages and T do not. The others are settings, which stay.
pub(super) fn may_wait(effect: &Effect) -> bool {
    is_move(effect)
        || matches!(
            effect,
            Effect::Dwell { .. } | Effect::OrientSpindle { .. } | Effect::WaitOrient { .. }
        )
}

/// Whether an effect leads the controlled point somewhere.
pub(super) fn is_move(effect: &Effect) -> bool {
    matches!(
        effect,
        Effect::StraightTraverse { .. }
            | Effect::StraightFeed { .. }
            | Effect::ArcFeed { .. }
            | Effect::NurbsFeed { .. }
            | Effect::RigidTap { .. }
            | Effect::StraightProbe { .. }
    )
}
