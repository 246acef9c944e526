//! M48 to M53.

use gaugeblock_vocabulary::{Compensation, FaultKind, Switch};

use super::spindle::{all, number};
use super::{whole, word};
use crate::rs274::evaluate::Words;
use crate::rs274::quirks::settings as quirks;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Enables and disables the controls, M48 and M49 before the single ones, as the document lists them.
///
/// Rule overrides.under-compensation. Whether that is allowed while cutter compensation is on is a choice.
///
/// # Errors
/// Rules overrides.other-p and overrides.out-of-range.
pub fn perform(words: &Words, state: &mut State) -> Result<(), StepError> {
    let rule = "overrides.under-compensation";
    if state.modes.compensation != Compensation::Off && state.choices.is(rule, "refused") {
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

/// Rules overrides.enable-both and overrides.disable-both: the feed override and the speed override.
///
/// Rule overrides.both-selected. $ says which spindle's speed override is meant; whether the feed override is meant too
/// is a choice (overrides.selected-feed).
fn both(switch: Switch, words: &Words, state: &mut State) -> Result<(), StepError> {
    let spindles = speed_overrides(words, state)?;
    state.coverage.accepted(match switch {
        Switch::On => "overrides.enable-both",
        Switch::Off => "overrides.disable-both",
    });
    let selected = word(words, '$').is_some() && !quirks::is_of_others(words, state);
    if selected {
        state.coverage.accepted("overrides.both-selected");
    }
    if state.modes.feed_override == switch {
        state.coverage.accepted("overrides.repeated");
    }
    if !selected || state.choices.is("overrides.selected-feed", "switched") {
        state.modes.feed_override = switch;
    }
    for place in spindles {
        state.modes.spindles[place].speed_override = switch;
    }
    Ok(())
}

/// Rules overrides.feed (M50), overrides.speed (M51), overrides.adaptive-feed (M52), overrides.feed-stop (M53): enabled
/// with P1 or without P, disabled with P0, one control at a time (overrides.one-by-one).
fn single(code: u32, words: &Words, state: &mut State) -> Result<(), StepError> {
    let switch = switch(words, state)?;
    let rule = match code {
        50 => {
            state.modes.feed_override = switch;
            "overrides.feed"
        }
        51 => {
            for place in speed_overrides(words, state)? {
                state.modes.spindles[place].speed_override = switch;
            }
            "overrides.speed"
        }
        52 => {
            state.modes.adaptive_feed = switch;
            "overrides.adaptive-feed"
        }
        _ => {
            state.modes.feed_stop = switch;
            "overrides.feed-stop"
        }
    };
    state.coverage.accepted(rule);
    state.coverage.accepted("overrides.one-by-one");
    Ok(())
}

/// Rule overrides.other-p. P is 1 or 0, and 1 when it is not given.
fn switch(words: &Words, state: &State) -> Result<Switch, StepError> {
    let Some(value) = word(words, 'p') else { return Ok(Switch::On) };
    if state.choices.quirk("rs274.override-any-p") {
        return Ok(quirks::switch_of_any_p(value));
    }
    match whole(value) {
        Some(0) => Ok(Switch::Off),
        Some(1) => Ok(Switch::On),
        _ => {
            let message = format!("P{value} is neither 0 nor 1");
            Err(refuse("overrides.other-p", FaultKind::WordOutOfRange, message))
        }
    }
}

/// The spindles whose speed override is meant.
///
/// Rule overrides.without-dollar. Which they are without $ is a choice.
/// Rule overrides.speed-selected. With $ it is that of one.
fn speed_overrides(words: &Words, state: &mut State) -> Result<Vec<usize>, StepError> {
    let dollar = word(words, '$').filter(|_| !quirks::is_of_others(words, state));
    let Some(value) = dollar else {
        state.coverage.accepted("overrides.without-dollar");
        let every = state.choices.is("overrides.without-dollar", "all");
        return Ok(if every { all(state) } else { vec![0] });
    };
    quirks::override_dollar(value, state)?;
    let place = number(value, state, "overrides.out-of-range")?;
    state.coverage.accepted("overrides.out-of-range");
    state.coverage.accepted("overrides.speed-selected");
    Ok(vec![place])
}
