//! M48 to M53.

use gaugeblock_vocabulary::{Compensation, FaultKind, Switch};

use super::{whole, word};
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Enables and disables the controls, M48 and M49 before the single ones, as the document lists them.
///
/// Rule overrides.under-compensation. Whether that is allowed while cutter compensation is on is a choice.
///
/// # Errors
/// Rules overrides.other-p and overrides.out-of-range.
pub fn perform(words: &Words, state: &mut State) -> Result<(), StepError> {
    let rule = rule::overrides::UNDER_COMPENSATION;
    if state.modes.compensation != Compensation::Off
        && state.choices.is(choice::overrides::UnderCompensation::Refused)
    {
        let message = "overrides are switched while cutter compensation is on";
        return Err(refuse(rule, FaultKind::CompensationActive, message));
    }
    state.coverage.accepted(rule);
    for code in [48, 49, 50, 51, 52, 53] {
        if words.m.contains(&code) {
            match code {
                48 => both(Switch::On, words, state)?,
                49 => both(Switch::Off, words, state)?,
                _ => single(code, words, state)?,
            }
        }
    }
    Ok(())
}

/// Whose overrides are switched, and by which numbers.
pub(crate) trait OverrideRules {
    /// Rules overrides.both-selected and overrides.speed-selected. $ says which spindle is meant.
    fn spindle_word(&self, words: &Words, _state: &State) -> Option<f64> {
        word(words, '$')
    }

    /// Rule overrides.out-of-range. The spindle of a $, one that the machine has.
    fn overridden_spindle(&self, value: f64, state: &mut State) -> Result<usize, StepError> {
        state.dialect().named_spindle(value, state, rule::overrides::OUT_OF_RANGE)
    }

    /// Rule overrides.feed-no-influence. The rapid override always counts: codes enable and disable that of the feed.
    fn rapid_override_counts(&self, _state: &State) -> bool {
        true
    }

    /// A code has set the feed override, or the program end.
    fn feed_override_is_set(&self, _state: &mut State) {}

    /// Rule overrides.other-p. P is 1 or 0.
    fn switch(&self, value: f64, _state: &State) -> Result<Switch, StepError> {
        match whole(value) {
            Some(0) => Ok(Switch::Off),
            Some(1) => Ok(Switch::On),
            _ => {
                let message = format!("P{value} is neither 0 nor 1");
                Err(refuse(rule::overrides::OTHER_P, FaultKind::WordOutOfRange, message))
            }
        }
    }
}

/// Rules overrides.enable-both and overrides.disable-both: the feed override and the speed override.
///
/// Rule overrides.both-selected. $ says which spindle's speed override is meant; whether the feed override is meant too
/// is a choice (overrides.selected-feed).
fn both(switch: Switch, words: &Words, state: &mut State) -> Result<(), StepError> {
    let spindles = speed_overrides(words, state)?;
    state.coverage.accepted(match switch {
        Switch::On => rule::overrides::ENABLE_BOTH,
        Switch::Off => rule::overrides::DISABLE_BOTH,
    });
    let selected = state.dialect().spindle_word(words, state).is_some();
    if selected {
        state.coverage.accepted(rule::overrides::BOTH_SELECTED);
    }
    if state.modes.feed_override == switch {
        state.coverage.accepted(rule::overrides::REPEATED);
    }
    if !selected || state.choices.is(choice::overrides::SelectedFeed::Switched) {
        state.modes.feed_override = switch;
        state.dialect().feed_override_is_set(state);
    }
    for place in spindles {
        state.modes.spindles[place].speed_override = switch;
    }
    Ok(())
}

/// Rules overrides.feed (M50), overrides.speed (M51), overrides.adaptive-feed (M52), overrides.feed-stop (M53): enabled
/// with P1 or without P, disabled with P0, one control at a time (overrides.one-by-one).
fn single(code: u32, words: &Words, state: &mut State) -> Result<(), StepError> {
    let value = word(words, 'p').unwrap_or(1.0);
    let switch = state.dialect().switch(value, state)?;
    let rule = match code {
        50 => {
            state.modes.feed_override = switch;
            state.dialect().feed_override_is_set(state);
            rule::overrides::FEED
        }
        51 => {
            for place in speed_overrides(words, state)? {
                state.modes.spindles[place].speed_override = switch;
            }
            rule::overrides::SPEED
        }
        52 => {
            state.modes.adaptive_feed = switch;
            rule::overrides::ADAPTIVE_FEED
        }
        _ => {
            state.modes.feed_stop = switch;
            rule::overrides::FEED_STOP
        }
    };
    state.coverage.accepted(rule);
    state.coverage.accepted(rule::overrides::ONE_BY_ONE);
    Ok(())
}

/// The spindles whose speed override is meant.
///
/// Rule overrides.without-dollar. Which they are without $ is a choice.
/// Rule overrides.speed-selected. With $ it is that of one.
fn speed_overrides(words: &Words, state: &mut State) -> Result<Vec<usize>, StepError> {
    let Some(value) = state.dialect().spindle_word(words, state) else {
        state.coverage.accepted(rule::overrides::WITHOUT_DOLLAR);
        let every = state.choices.is(choice::overrides::WithoutDollar::All);
        return Ok(if every { state.all_spindles() } else { vec![0] });
    };
    let place = state.dialect().overridden_spindle(value, state)?;
    state.coverage.accepted(rule::overrides::OUT_OF_RANGE);
    state.coverage.accepted(rule::overrides::SPEED_SELECTED);
    Ok(vec![place])
}
