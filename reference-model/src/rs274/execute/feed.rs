//! G93, G94, G95 and F.

use gaugeblock_vocabulary::{FaultKind, FeedMode, Motion, Position};

use super::probe::is_probing;
use super::programmed_motion::{is_arc, is_feed, is_spline, motion_of};
use super::units_planes::programmed_units;
use super::word;
use crate::ids::{choice, rule};
use crate::math;
use crate::rs274::evaluate::Words;
use crate::rs274::modes::{each, unit_size};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Operations on the feed that a dialect can replace.
pub(crate) trait FeedRules {
    /// Selects the feed mode.
    ///
    /// Rules feed.inverse-time, feed.per-minute, feed.per-revolution. Rule feed.per-revolution-spindle. The $ of G95
    /// names a spindle of the machine.
    fn select_feed_mode(&self, words: &Words, state: &mut State) -> Result<(), StepError> {
        let (mode, rule) = if words.g_tenths.contains(&930) {
            (FeedMode::InverseTime, rule::feed::INVERSE_TIME)
        } else if words.g_tenths.contains(&940) {
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
    /// Choice feed.after-mode-change: from G93 to G94 that of the last move counts.
    fn switch_feed_mode(&self, mode: FeedMode, state: &mut State) {
        let counts = mode == FeedMode::PerMinute
            && state.modes.feed_mode == FeedMode::InverseTime
            && state.choices.is(choice::feed::AfterModeChange::OfLastMove);
        if counts {
            state.modes.feed_rate = state.move_rate;
        } else if mode != FeedMode::InverseTime {
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

    /// Choice feed.after-mode-change. The feed rate per minute of a move under inverse time: its length times F.
    fn rate_of_move(&self, length: f64, state: &mut State) -> f64 {
        length * state.modes.feed_rate
    }
}

/// Prepares the feed rate for a block, before any of its phases but the comment.
///
/// Rule feed.after-inverse-time. Whether a block without F under G93 sets the feed rate to zero is a choice.
/// Choice feed.after-mode-change. The feed rate before G93 is that of the last move.
pub fn begin_block(words: &Words, state: &mut State) {
    if words.g_tenths.contains(&930) && state.modes.feed_mode == FeedMode::PerMinute {
        state.move_rate = state.modes.feed_rate;
    }
    let is_inverse_time = if words.g_tenths.iter().any(|code| [940, 950].contains(code)) {
        false
    } else {
        words.g_tenths.contains(&930) || state.modes.feed_mode == FeedMode::InverseTime
    };
    if !is_inverse_time || word(words, 'f').is_some() {
        return;
    }
    state.coverage.accepted(rule::feed::AFTER_INVERSE_TIME);
    if state.choices.is(choice::feed::AfterInverseTime::Zero) {
        state.modes.feed_rate = 0.0;
    }
}

/// Sets the feed rate.
///
/// Rule feed.rate. F holds until another F, except under inverse time, where it counts for the feed move of its own
/// block and is ignored in any other block (feed.inverse-time-stray-rate).
/// Choice feed.after-inverse-time: where a block without F leaves no feed rate, each F is taken.
///
/// # Errors
/// Rule feed.negative-rate.
pub fn set_rate(words: &Words, state: &mut State) -> Result<(), StepError> {
    let Some(rate) = word(words, 'f') else { return Ok(()) };
    if rate < 0.0 {
        let message = format!("the feed rate F must not be negative: {rate}");
        return Err(refuse(rule::feed::NEGATIVE_RATE, FaultKind::WordOutOfRange, message));
    }
    let motion = motion_of(words, state);
    let feeds = motion.is_some_and(|motion| state.dialect().takes_feed_rate(motion, state));
    let is_stray = state.modes.feed_mode == FeedMode::InverseTime && !feeds;
    if is_stray && state.choices.is(choice::feed::AfterInverseTime::Kept) {
        state.coverage.accepted(rule::feed::INVERSE_TIME_STRAY_RATE);
        return Ok(());
    }
    state.coverage.accepted(rule::feed::RATE);
    if motion.is_none() {
        state.coverage.accepted(rule::feed::RATE_MOVES_NOTHING);
    }
    let rate = in_unit_before(rate, words, state);
    state.dialect().use_feed_rate(rate, state);
    Ok(())
}

/// F of a block as it is read before the block changes the length unit, which converts it where it converts feeds.
///
/// Rule order.feed-unit. Whether F in the block that changes the unit is read in the new one is a choice. Under inverse
/// time F is the inverse of a time, and the unit does not change it.
fn in_unit_before(rate: f64, words: &Words, state: &mut State) -> f64 {
    let before = state.modes.units;
    let Some(unit) = programmed_units(words).filter(|unit| *unit != before) else { return rate };
    if state.modes.feed_mode == FeedMode::InverseTime {
        return rate;
    }
    state.coverage.accepted(rule::order::FEED_UNIT);
    let is_converted =
        state.choices.is(choice::order::FeedUnit::New) && state.dialect().rescales_feed(state);
    if is_converted { rate * unit_size(unit) / unit_size(before) } else { rate }
}

/// Rule feed.inverse-time-needs-rate. Under inverse time a feed move needs F in its own block; one that stood elsewhere
/// was ignored (feed.inverse-time-stray-rate).
/// Rule feed.move-without-rate. Otherwise a feed rate must have been set, and again after a switch of the feed mode
/// (feed.rate-after-mode-change).
/// Rule arcs.needs-feed-rate. All this holds for arcs too.
pub(super) fn check_feed_rate(words: &Words, state: &mut State) -> Result<(), StepError> {
    check_rate(words, state)?;
    state.coverage.accepted(rule::feed::APPLIES_TO_FEED_MOVES);
    state.dialect().check_spindle_of_feed(words, state)
}

/// The feed rate of a block that has a motion code of a feed move, also where it moves nothing.
pub(super) fn check_rate(words: &Words, state: &mut State) -> Result<(), StepError> {
    if state.modes.feed_mode == FeedMode::InverseTime {
        if word(words, 'f').is_none() {
            state.coverage.refused(rule::feed::INVERSE_TIME_STRAY_RATE);
            let message = "under inverse time a feed move needs F in its block";
            return Err(refuse(
                rule::feed::INVERSE_TIME_NEEDS_RATE,
                FaultKind::MissingWord,
                message,
            ));
        }
        state.coverage.accepted(rule::feed::INVERSE_TIME_NEEDS_RATE);
    }
    if state.modes.feed_rate == 0.0 && state.dialect().needs_feed_rate(words, state) {
        // Rule modal-groups.power-up. A controller begins without a feed rate.
        state.coverage.refused(if state.modes.feed_awaited {
            rule::feed::RATE_AFTER_MODE_CHANGE
        } else {
            rule::modal_groups::POWER_UP
        });
        if motion_of(words, state).is_some_and(is_arc) {
            state.coverage.refused(rule::arcs::NEEDS_FEED_RATE);
        }
        let message = "a feed move, and no feed rate";
        return Err(refuse(rule::feed::MOVE_WITHOUT_RATE, FaultKind::ZeroFeed, message));
    }
    state.coverage.accepted(rule::feed::MOVE_WITHOUT_RATE);
    state.coverage.accepted(rule::feed::RATE_AFTER_MODE_CHANGE);
    Ok(())
}

/// Records the feed rate per minute of a feed move of a length, active length unit or degrees.
pub(super) fn record_rate(length: f64, state: &mut State) {
    if state.modes.feed_mode == FeedMode::InverseTime {
        state.move_rate = state.dialect().rate_of_move(length, state);
    }
}

/// The length of a straight move that its feed rate counts for: that of X, Y and Z if one of these axes moves, else
/// that of U, V and W, else that of A, B and C.
pub(crate) fn length_for_feed(start: Position, end: Position) -> f64 {
    let way = each(end, start, |end, start| end - start);
    let length = |[x, y, z]: [f64; 3]| math::hypotenuse(math::hypotenuse(x, y), z);
    let lengths = [[way.x, way.y, way.z], [way.u, way.v, way.w], [way.a, way.b, way.c]].map(length);
    lengths.into_iter().find(|length| *length > 0.0).unwrap_or_default()
}
