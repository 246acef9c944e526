//! The numbers of a cycle: which its block programs, which stick, and the heights that they mean.

use gaugeblock_vocabulary::{Axis, Distance, FaultKind, Lathe, Motion, ReturnMode};

use super::cycle::{Cycle, Kind, axes_of};
use crate::ids::{Rule, choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::execute::target::moved;
use crate::rs274::execute::word;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::{Series, SeriesFrame, State};

/// Finds the numbers of a cycle.
///
/// Rules cycles.sticky-depth and cycles.sticky-retract. What the same cycle had before need not be programmed again.
/// Rule cycles.incremental. In incremental distance mode R counts from the current position, and the depth from R; in
/// absolute distance mode they are positions (cycles.absolute).
///
/// # Errors
/// A number that is missing or of no use.
pub(super) fn find(
    motion: Motion,
    kind: Kind,
    words: &Words,
    state: &mut State,
) -> Result<(Series, Cycle), StepError> {
    let axes = axes_of(state.modes.plane);
    let [_, _, normal] = axes;
    if state.modes.lathe == Lathe::Diameter && normal == Axis::X {
        let what = "R along X in diameter mode";
        return Err(StepError::Unspecified(what.to_owned()));
    }
    let before = state.series;
    let same = before.filter(|before| before.motion == motion);
    let values = moved(words, state);
    let depth = values.iter().find(|(axis, _)| *axis == normal).map(|(_, value)| *value);
    let retract = sticky(
        word(words, 'r'),
        same.map(|same| same.retract),
        (rule::cycles::STICKY_RETRACT, "R, the retract height"),
        state,
    )?;
    let letter = crate::rs274::execute::letter(normal).to_ascii_uppercase();
    let needed = format!("{letter}, the bottom of the hole");
    let depth =
        sticky(depth, same.map(|same| same.depth), (rule::cycles::STICKY_DEPTH, &needed), state)?;
    unchanged(words, before, normal, state)?;
    let position = state.position.get(normal);
    let of_row = before.filter(|_| state.choices.is(choice::cycles::OldLevel::Row));
    let initial = of_row.map_or(position, |before| before.initial);
    let incremental = state.modes.distance == Distance::Incremental;
    let from = if incremental {
        state.dialect().incremental_retract_from(position, initial, state)
    } else {
        0.0
    };
    let retract_at = from + retract;
    let bottom = if incremental { retract_at + depth } else { depth };
    if retract_at < bottom {
        let message = "R below the bottom of the hole";
        return Err(refuse(rule::cycles::RETRACT_BELOW_BOTTOM, FaultKind::WordOutOfRange, message));
    }
    state.coverage.accepted(rule::cycles::RETRACT_BELOW_BOTTOM);
    let dwell = same.and_then(|same| same.dwell);
    let dwell = state.dialect().dwell_of_cycle(kind, words, dwell, state)?;
    let peck = super::strokes::peck(kind, words, same.and_then(|same| same.peck), state)?;
    let last = SeriesFrame::of(&state.modes);
    let first = before.map_or(last, |before| before.first);
    let series = Series { motion, depth, retract, dwell, peck, initial, first, last };
    let cycle = Cycle {
        kind,
        axes,
        initial,
        retract: retract_at,
        bottom,
        clear: clear(initial, retract_at, state),
        dwell: dwell.unwrap_or_default(),
        dwells: dwell.is_some(),
        peck: peck.unwrap_or_default(),
        spindle: state.dialect().spindle_of_cycle(words, state)?,
    };
    Ok((series, cycle))
}

/// Rule cycles.return-level. Under G98 each repeat ends at the initial level if that is above R; otherwise it ends at
/// R. Rule cycles.initial-level. That is where the normal axis was before the first of a row of cycles. Choice
/// cycles.old-level: or where it was before the cycle.
fn clear(initial: f64, retract: f64, state: &State) -> f64 {
    match state.modes.retract {
        ReturnMode::OldZ => initial.max(retract),
        ReturnMode::RPlane => retract,
    }
}

/// A number that must be programmed the first time.
fn sticky(
    number: Option<f64>,
    before: Option<f64>,
    (rule, needed): (Rule, &str),
    state: &mut State,
) -> Result<f64, StepError> {
    let found = number.or(before).ok_or_else(|| {
        let message = format!("the first block of a series of cycles needs {needed}");
        refuse(rule, FaultKind::MissingWord, message)
    })?;
    if number.is_none() {
        state.coverage.accepted(rule);
    }
    Ok(found)
}

/// A series goes on with its numbers and its initial level as long as they mean the same; what becomes of them under
/// another unit, plane or offset no document says.
fn unchanged(
    words: &Words,
    before: Option<Series>,
    normal: Axis,
    state: &State,
) -> Result<(), StepError> {
    let Some(before) = before else { return Ok(()) };
    let now = SeriesFrame::of(&state.modes);
    let told_anew = before.last.plane != now.plane || before.last.unit != now.unit;
    let has = |letter: char| word(words, letter).is_some();
    let all_programmed = has('r') && has(crate::rs274::execute::letter(normal));
    let to_initial =
        state.modes.retract == ReturnMode::OldZ && state.choices.is(choice::cycles::OldLevel::Row);
    if told_anew && !all_programmed || before.first != now && to_initial {
        let what = "a row of cycles over a change of plane, length unit or offset";
        return Err(StepError::Unspecified(what.to_owned()));
    }
    Ok(())
}
