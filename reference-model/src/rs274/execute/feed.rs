//! G93, G94, G95 and F.

use gaugeblock_vocabulary::{FaultKind, FeedMode, Motion, Switch};

use super::motion::{is_feed, is_spline, motion_of};
use super::probe::is_probing;
use super::word;
use crate::ids::rule;
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// What a controller may do otherwise with the feed.
pub(crate) trait FeedRules {
    /// Selects the feed mode.
    ///
    /// Rules feed.inverse-time, feed.per-minute, feed.per-revolution. Rule feed.per-revolution-spindle. The $ of G95
    /// names a spindle of the machine.
    fn select_feed_mode(&self, words: &Words, state: &mut State) -> Result<(), StepError> {
        let (mode, rule) = if words.g.contains(&930) {
            (FeedMode::InverseTime, rule::feed::INVERSE_TIME)
        } else if words.g.contains(&940) {
            (FeedMode::PerMinute, rule::feed::PER_MINUTE)
        } else {
            (FeedMode::PerRevolution, rule::feed::PER_REVOLUTION)
        };
        if mode == FeedMode::PerRevolution
            && let Some(spindle) = word(words, '$')
        {
            state.dialect().named_spindle(spindle, state, rule::feed::PER_REVOLUTION_SPINDLE)?;
            state.coverage.accepted(rule::feed::PER_REVOLUTION_SPINDLE);
        }
        state.coverage.accepted(rule);
        if mode != state.modes.feed_mode {
            state.dialect().switch_feed_mode(mode, state);
        }
        Ok(())
    }

    /// Rule feed.rate-after-mode-change. After a switch to G94 or G95 no feed rate is set until a new one is given.
    fn switch_feed_mode(&self, mode: FeedMode, state: &mut State) {
        if mode != FeedMode::InverseTime {
            state.modes.feed_rate = 0.0;
            state.modes.feed_awaited = true;
        }
        state.modes.feed_mode = mode;
    }

    /// Whether a motion takes the F of its block: under inverse time any other motion ignores it
    /// (feed.inverse-time-stray-rate).
    fn takes_feed_rate(&self, motion: Motion, _state: &State) -> bool {
        is_probing(motion) || is_spline(motion) || is_feed(motion)
    }

    /// Rule feed.rate. F holds until another F.
    fn use_feed_rate(&self, rate: f64, state: &mut State) {
        state.modes.feed_rate = rate;
        state.modes.feed_awaited = false;
    }
}

/// Sets the feed rate.
///
/// Rule feed.rate. F holds until another F, except under inverse time, where it counts for the feed move of its own
/// block and is ignored in any other block (feed.inverse-time-stray-rate).
///
/// # Errors
/// Rule feed.negative-rate.
pub fn set_rate(words: &Words, state: &mut State) -> Result<(), StepError> {
    let Some(rate) = word(words, 'f') else { return Ok(()) };
    if rate < 0.0 {
        let message = format!("a feed rate of {rate}");
        return Err(refuse(rule::feed::NEGATIVE_RATE, FaultKind::WordOutOfRange, message));
    }
    let motion = motion_of(words, state);
    let feeds = motion.is_some_and(|motion| state.dialect().takes_feed_rate(motion, state));
    if state.modes.feed_mode == FeedMode::InverseTime && !feeds {
        state.coverage.accepted(rule::feed::INVERSE_TIME_STRAY_RATE);
        return Ok(());
    }
    state.coverage.accepted(rule::feed::RATE);
    if motion.is_none() {
        state.coverage.accepted(rule::feed::RATE_MOVES_NOTHING);
    }
    state.dialect().use_feed_rate(rate, state);
    Ok(())
}

/// Whether anything asks for a hold, be it that no control lets it: a move that nothing asks to hold begins.
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
    let mut is_held = speed == Speed::Rapid && panel.rapid_override <= 0.0;
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
