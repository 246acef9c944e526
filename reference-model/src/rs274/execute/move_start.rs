//! Where a move begins: what holds it there, and which outputs switch with it.

use gaugeblock_vocabulary::{Effect, Switch};

use crate::ids::rule;
use crate::rs274::state::State;

/// Whether anything requests a hold, also where its control is disabled: without a request each move begins.
pub(crate) fn may_be_held(state: &State) -> bool {
    let panel = &state.panel;
    panel.feed_hold
        || panel.feed_override <= 0.0
        || panel.rapid_override <= 0.0
        || state.environment.adaptive_feed() <= 0.0
        || state.environment.feed_stop()
}

/// By what the speed of a move goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Speed {
    /// As fast as the axes can.
    Rapid,
    /// The feed.
    Feed,
    /// A spindle, whatever the feed is.
    Spindle,
}

/// Whether a move is held where it begins: it goes on once nothing holds it any more.
///
/// Rule overrides.feed-influence. A feed override of zero holds a feed move while the control is enabled; while it is
/// disabled it has no influence (overrides.feed-no-influence). Of rapid moves, which have an override of their own,
/// and of those in step with a spindle these controls do not speak. Rule overrides.adaptive-feed-zero. With adaptive
/// feed an input of zero is as good as a feed hold, whatever the feed override does (overrides.adaptive-feed-alone);
/// without it the input has no influence (overrides.adaptive-feed-no-influence). Rule overrides.feed-stop-holds.
/// While the feed stop is enabled its input holds every move; while it is disabled it has no effect
/// (overrides.feed-stop-no-effect).
pub(crate) fn is_held(speed: Speed, state: &mut State) -> bool {
    let panel = &state.panel;
    let feed_override = speed == Speed::Feed && panel.feed_override <= 0.0;
    let (adaptive, stop) = (state.environment.adaptive_feed(), state.environment.feed_stop());
    let controls = [
        (
            state.modes.feed_override,
            feed_override,
            [rule::overrides::FEED_INFLUENCE, rule::overrides::FEED_NO_INFLUENCE],
        ),
        (
            state.modes.adaptive_feed,
            adaptive <= 0.0,
            [rule::overrides::ADAPTIVE_FEED_ZERO, rule::overrides::ADAPTIVE_FEED_NO_INFLUENCE],
        ),
        (
            state.modes.feed_stop,
            stop || panel.feed_hold,
            [rule::overrides::FEED_STOP_HOLDS, rule::overrides::FEED_STOP_NO_EFFECT],
        ),
    ];
    let rapid_override = speed == Speed::Rapid && panel.rapid_override <= 0.0;
    let mut is_held = rapid_override && state.dialect().rapid_override_counts(state);
    for (control, asks, [counts, does_not_count]) in controls {
        let enabled = control == Switch::On;
        if asks {
            state.coverage.accepted(if enabled { counts } else { does_not_count });
        }
        is_held |= enabled && asks;
    }
    if is_held && state.modes.feed_override == Switch::Off {
        state.coverage.accepted(rule::overrides::ADAPTIVE_FEED_ALONE);
    }
    is_held
}

/// Whether an effect that moves is a motion, which may be held and for which outputs wait.
pub(crate) fn is_motion(effect: &Effect, state: &State) -> bool {
    if let Effect::StraightTraverse { end } | Effect::StraightFeed { end } = effect {
        return state.dialect().is_motion_to(*end, state);
    }
    true
}

/// Records where a move leads the axes: to its end, or to the contact of a probing move. A rigid tap returns to its
/// start.
pub(crate) fn moves_axes(effect: &Effect, state: &mut State) {
    if let Effect::StraightTraverse { end }
    | Effect::StraightFeed { end }
    | Effect::ArcFeed { end, .. }
    | Effect::NurbsFeed { end, .. } = effect
    {
        state.dialect().axes_are_at(*end, state);
    } else if let Effect::StraightProbe { end, contact } = effect {
        state.dialect().axes_are_at(contact.unwrap_or(*end), state);
    }
}

/// Rule outputs.at-next-motion. What waits for a motion switches when the next one begins.
pub(crate) fn motion_begins(state: &mut State) {
    if state.environment.motion_begins() {
        state.coverage.accepted(rule::outputs::AT_NEXT_MOTION);
    }
}
