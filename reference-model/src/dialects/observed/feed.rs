//! Quirks of the feed.

use gaugeblock_vocabulary::{FeedMode, Motion};

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::feed::FeedRules;
use crate::rs274::execute::probe::is_probing;
use crate::rs274::execute::word;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl FeedRules for Observed {
    /// Quirk rs274.chosen-spindle. The codes of the feed mode select a spindle.
    /// Quirk rs274.feed-lost-at-same-mode. G94 and G95 set the feed rate to zero even if they are already active.
    fn select_feed_mode(&self, words: &Words, state: &mut State) -> Result<(), StepError> {
        let before = state.modes.feed_mode;
        Documented.select_feed_mode(words, state)?;
        choose_by_feed_mode(words, state)?;
        if state.modes.feed_mode == before && state.has_quirk(quirk::rs274::FEED_LOST_AT_SAME_MODE)
        {
            state.dialect().switch_feed_mode(before, state);
        }
        Ok(())
    }

    fn switch_feed_mode(&self, mode: FeedMode, state: &mut State) {
        Documented.switch_feed_mode(mode, state);
        if mode != FeedMode::InverseTime {
            state.modes.memory.get_mut().feed_number = 0.0;
        }
    }

    /// Quirk rs274.probe-inverse-time. In inverse time mode a probing block ignores its F.
    fn takes_feed_rate(&self, motion: Motion, state: &State) -> bool {
        let ignored = is_probing(motion) && state.has_quirk(quirk::rs274::PROBE_INVERSE_TIME);
        !ignored && Documented.takes_feed_rate(motion, state)
    }

    /// Quirk nist.inverse-time-at-least-a-tenth. A feed move under inverse time has a feed rate of at least 0.1 length
    /// units per minute; its F becomes the one of that rate.
    fn rate_of_move(&self, length: f64, state: &mut State) -> f64 {
        let rate = Documented.rate_of_move(length, state);
        if rate >= 0.1 || !state.has_quirk(quirk::nist::INVERSE_TIME_AT_LEAST_A_TENTH) {
            return rate;
        }
        if length > 0.0 {
            state.modes.feed_rate = 0.1 / length;
        }
        0.1
    }

    /// Quirk rs274.feed-name-inverse-time. In inverse time mode `_feed` becomes the feed rate that the move had, not F.
    fn use_feed_rate(&self, rate: f64, state: &mut State) {
        Documented.use_feed_rate(rate, state);
        let of_move = state.modes.feed_mode == FeedMode::InverseTime
            && state.has_quirk(quirk::rs274::FEED_NAME_INVERSE_TIME);
        if !of_move {
            state.modes.memory.get_mut().feed_number = rate;
        }
    }
}

/// Quirk rs274.chosen-spindle. The codes of the feed mode select a spindle, even if another code uses $. The machine
/// must have that spindle.
fn choose_by_feed_mode(words: &Words, state: &mut State) -> Result<(), StepError> {
    let rule = quirk::rs274::CHOSEN_SPINDLE;
    if state.has_quirk(rule) {
        let named = word(words, '$');
        let named = named.map(|number| state.dialect().named_spindle(number, state, rule.into()));
        state.memory.chosen_spindle = named.transpose()?.unwrap_or(0);
    }
    Ok(())
}
