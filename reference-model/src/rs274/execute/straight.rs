//! Straight moves to points that are found already: of G0 and G1, and of the cycles that are rewritten into them.

use gaugeblock_vocabulary::{Effect, FeedMode, Motion, Position};

use super::compensation;
use super::feed::{length_for_feed, record_rate};
use crate::ids::rule;
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Leads straight to a point that is found already, with the tool compensated where that is on.
pub(super) fn lead_to(
    motion: Motion,
    end: Position,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let start = compensation::programmed_point(state);
    compensation::lead_away(end, state)?;
    state.dialect().straight_move_leads(motion, start, end, state);
    if motion == Motion::Feed && !compensation::applies(state) {
        record_rate(length_for_feed(start, end), state);
    }
    accepted(motion, end, words, state);
    if compensation::applies(state) {
        return compensation::line(motion, end, state, record);
    }
    move_straight(motion, end, state, record);
    Ok(())
}

/// Moves straight to a point.
fn move_straight(motion: Motion, end: Position, state: &mut State, record: &mut Record) {
    state.modes.motion = motion;
    state.position = end;
    let effect = if motion == Motion::Feed {
        Effect::StraightFeed { end }
    } else {
        Effect::StraightTraverse { end }
    };
    record.effect(state, effect);
}

/// The rules that an accepted move follows, including those on the modes in effect before it.
fn accepted(motion: Motion, end: Position, words: &Words, state: &mut State) {
    for rule in [
        rule::modal_groups::ONE_IN_FORCE,
        rule::modal_groups::NON_MODAL_ONCE,
        rule::modal_groups::AXIS_WORDS_WITHOUT_MODE,
        rule::units_planes::MOTION_IN_ACTIVE_UNIT,
        rule::path_control::MODE_HOLDS,
        rule::offsets::SELECT_HOLDS,
        rule::feed::MODE_HOLDS,
    ] {
        state.coverage.accepted(rule);
    }
    if motion == Motion::Feed {
        state.coverage.accepted(rule::motion::FEED);
    } else {
        state.coverage.accepted(rule::motion::TRAVERSE);
        if state.modes.feed_mode == FeedMode::InverseTime {
            state.coverage.accepted(rule::feed::INVERSE_TIME_RAPID);
        }
        if state.modes.feed_rate == 0.0 {
            state.coverage.accepted(rule::feed::TRAVERSE_NEEDS_NONE);
        }
    }
    if [end.a, end.b, end.c].iter().any(|angle| *angle != 0.0) {
        state.coverage.accepted(rule::motion::ROTARY_AXES);
    }
    if words.letters.keys().any(|letter| matches!(letter, 'x' | 'y' | 'z')) {
        state.coverage.accepted(rule::motion::NO_SUCH_AXIS);
    }
}
