//! Whether a motion is held where it begins: overrides (M48 to M51), adaptive feed (M52), the feed stop (M53).

use gaugeblock_vocabulary::Effect;

use crate::faults::{PlantedFault, planted};

use super::machine::{Input, Machine};
use super::state::TaskState;

/// The kind of motion of an effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Motion {
    /// At rapid speed.
    Rapid,
    /// At the programmed feed.
    Feed,
    /// At the feed that follows from a spindle: no override counts.
    Synchronised,
}

/// Which motion an effect is, if it is one.
#[inline]
#[expect(clippy::wildcard_enum_match_arm, reason = "the other effects move nothing")]
pub(super) fn motion_of(effect: &Effect, synchronised: bool) -> Option<Motion> {
    match effect {
        Effect::StraightTraverse { .. } => Some(Motion::Rapid),
        Effect::StraightFeed { .. } if synchronised => Some(Motion::Synchronised),
        Effect::StraightFeed { .. }
        | Effect::ArcFeed { .. }
        | Effect::NurbsFeed { .. }
        | Effect::StraightProbe { .. } => Some(Motion::Feed),
        Effect::RigidTap { .. } => Some(Motion::Synchronised),
        _ => None,
    }
}

impl<M: Machine> TaskState<M> {
    /// Whether something holds such a motion now.
    pub(super) fn holds(&self, motion: Motion) -> bool {
        let stop = self.panel.feed_hold || self.machine.input(Input::FeedHold) != 0.0;
        let stop = stop && (self.tracked.feed_stop || planted(PlantedFault::StopNeverDisabled));
        // "The commanded velocity is multiplied by this value" (5.6.1.2), of whatever motion.
        let adaptive = self.tracked.adaptive_feed && self.machine.input(Input::AdaptiveFeed) == 0.0;
        let factor = match motion {
            Motion::Rapid => self.panel.rapid_override,
            Motion::Feed if self.tracked.feed_override => self.panel.feed_override,
            Motion::Feed | Motion::Synchronised => 1.0,
        };
        stop || adaptive || factor <= 0.0
    }
}
