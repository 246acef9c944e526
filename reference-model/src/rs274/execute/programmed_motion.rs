//! Which motion a block programs.

use gaugeblock_vocabulary::{FaultKind, Motion};

use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::modes::motion_mode;
use crate::rs274::order::{has_axis_words, moves_by_axis_words, moves_without_code};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// The motion that a block programs.
///
/// Rule motion.mode-change. A motion code replaces the motion mode.
/// Rule motion.mode-holds. Axis words alone repeat the motion mode, unless a code of the block uses them.
pub(crate) fn motion_of(words: &Words, state: &State) -> Option<Motion> {
    let programmed =
        words.g_tenths.iter().filter(|code| **code != 800).find_map(|code| motion_mode(*code));
    if words.g_tenths.contains(&53) {
        return Some(Motion::Nurbs);
    }
    let cancelled = words.g_tenths.contains(&800);
    programmed.or(cancelled.then_some(Motion::None)).or_else(|| {
        let implied = moves_by_axis_words(words)
            || by_offsets_alone(words, state)
            || words.g_tenths.contains(&530);
        implied.then_some(state.modes.motion)
    })
}

/// Rule motion.offset-words-after-cancel. Whether axis words that an offset, a position or a tool length uses are
/// refused while G80 is active, by this block or an earlier one, is a choice. A motion code of the block replaces G80.
pub(super) fn check_words_after_cancel(words: &Words, state: &mut State) -> Result<(), StepError> {
    let is_cancelled = motion_of(words, state).unwrap_or(state.modes.motion) == Motion::None;
    if !is_cancelled || !has_axis_words(words) || moves_by_axis_words(words) {
        return Ok(());
    }
    let rule = rule::motion::OFFSET_WORDS_AFTER_CANCEL;
    if state.dialect().refuses_words_after_cancel(words, state) {
        let message = "axis words while G80 is active";
        return Err(refuse(rule, FaultKind::AxisWords, message));
    }
    state.coverage.accepted(rule);
    Ok(())
}

/// Whether offsets of a centre alone repeat the arc that is in force.
///
/// Rule arcs.offsets-alone. The motion in force is executed again where there are axis words; a full circle has none,
/// so that this is a choice.
pub(super) fn by_offsets_alone(words: &Words, state: &State) -> bool {
    is_arc(state.modes.motion)
        && moves_without_code(words)
        && state.choices.is(choice::arcs::OffsetsAlone::Arc)
}

/// Whether a motion is an arc.
pub(crate) fn is_arc(motion: Motion) -> bool {
    matches!(motion, Motion::ArcClockwise | Motion::ArcCounterclockwise)
}

/// Whether a motion is a spline.
pub(crate) fn is_spline(motion: Motion) -> bool {
    matches!(motion, Motion::CubicSpline | Motion::QuadraticSpline | Motion::Nurbs)
}

/// Whether a motion is executed at the feed rate.
pub(super) fn is_feed(motion: Motion) -> bool {
    motion == Motion::Feed || is_arc(motion)
}
