//! What each cycle does in its hole, from R down and back to its clear height.

use gaugeblock_vocabulary::{FaultKind, LengthUnit, SpindleTurn};

use super::cycle::{Cycle, Kind, feed_along, traverse_along, turn_spindle};
use super::tapping;
use crate::ids::{Rule, choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::execute::word;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// A bottom that is this close is reached: what is left is rounding of the increments.
pub(super) const REACHED: f64 = 1e-9;

/// P of the cycles that dwell.
///
/// Rule cycles.dwell-needed. G82, G86 and G89 need it; whether the one of the block before holds is a choice.
/// Choice cycles.tap-without-dwell: whether G74 and G84 need it.
/// Rule cycles.negative-dwell. It is not negative.
pub(super) fn dwell(
    kind: Kind,
    words: &Words,
    before: Option<f64>,
    state: &mut State,
) -> Result<Option<f64>, StepError> {
    let taps = matches!(kind, Kind::TapLeft | Kind::TapRight);
    if !taps && !matches!(kind, Kind::DrillDwell | Kind::BoreSpindleStop | Kind::BoreDwell) {
        return Ok(None);
    }
    let before = before.filter(|_| state.choices.is(choice::cycles::StickyArguments::Sticky));
    let Some(seconds) = word(words, 'p').or(before) else {
        if taps && !state.choices.is(choice::cycles::TapWithoutDwell::Refused) {
            return Ok(None);
        }
        let rule = if taps {
            Rule::of_choice::<choice::cycles::TapWithoutDwell>()
        } else {
            rule::cycles::DWELL_NEEDED
        };
        return Err(refuse(
            rule,
            FaultKind::MissingWord,
            "this cycle needs P, the seconds of its dwell",
        ));
    };
    state.coverage.accepted(rule::cycles::DWELL_NEEDED);
    state.dialect().check_cycle_dwell(seconds, state)?;
    state.coverage.accepted(rule::cycles::NEGATIVE_DWELL);
    Ok(Some(seconds))
}

/// Rule cycles.peck-increment. Q of G73 and G83 is positive.
/// Rule cycles.peck-needed. They need it; whether the one of the block before holds is a choice.
pub(super) fn peck(
    kind: Kind,
    words: &Words,
    before: Option<f64>,
    state: &mut State,
) -> Result<Option<f64>, StepError> {
    if !matches!(kind, Kind::ChipBreaking | Kind::Peck) {
        return Ok(None);
    }
    let before = before.filter(|_| state.choices.is(choice::cycles::StickyArguments::Sticky));
    let Some(peck) = state.dialect().programmed_peck(words, state).or(before) else {
        let message = "this cycle needs Q, the increment of its pecks";
        return Err(refuse(rule::cycles::PECK_NEEDED, FaultKind::MissingWord, message));
    };
    state.coverage.accepted(rule::cycles::PECK_NEEDED);
    if peck <= 0.0 {
        let message = format!("the increment of pecks Q must be greater than zero: {peck}");
        return Err(refuse(rule::cycles::PECK_INCREMENT, FaultKind::WordOutOfRange, message));
    }
    state.coverage.accepted(rule::cycles::PECK_INCREMENT);
    Ok(Some(peck))
}

/// Checks that the spindle turns as the cycle needs it.
///
/// Rule cycles.bore-needs-spindle. The spindle turns before G86.
pub(super) fn check_spindle(cycle: &Cycle, state: &mut State) -> Result<(), StepError> {
    match cycle.kind {
        Kind::TapLeft => tapping::check_direction(cycle, SpindleTurn::Counterclockwise, state),
        Kind::TapRight => tapping::check_direction(cycle, SpindleTurn::Clockwise, state),
        Kind::BoreSpindleStop => {
            let rule = rule::cycles::BORE_NEEDS_SPINDLE;
            let turn = state.dialect().known_turn(cycle.spindle, state);
            if matches!(turn, SpindleTurn::Stopped | SpindleTurn::Oriented) {
                let message = "G86 while the spindle does not turn";
                return Err(refuse(rule, FaultKind::ZeroSpeed, message));
            }
            state.coverage.accepted(rule);
            Ok(())
        }
        Kind::Drill
        | Kind::DrillDwell
        | Kind::ChipBreaking
        | Kind::Peck
        | Kind::Bore
        | Kind::BoreDwell
        | Kind::Undefined => Ok(()),
    }
}

/// Rule cycles.drill. G81 feeds to the bottom and traverses to the clear height.
/// Rule cycles.drill-dwell. G82 dwells between.
/// Rule cycles.bore. G85 feeds out to R, and traverses on to the clear height. Rule cycles.bore-return. By a choice it
/// feeds all the way.
/// Rule cycles.bore-dwell. G89 dwells, and feeds out to the clear height.
/// Rule cycles.bore-spindle-stop. G86 dwells, stops the spindle, traverses out, and lets it turn again as before.
pub(super) fn perform(
    cycle: &Cycle,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let [_, _, normal] = cycle.axes;
    if matches!(cycle.kind, Kind::ChipBreaking | Kind::Peck) {
        return pecks(cycle, state, record);
    }
    if matches!(cycle.kind, Kind::TapLeft | Kind::TapRight) {
        tapping::perform(cycle, state, record);
        return Ok(());
    }
    feed_along(normal, cycle.bottom, state, record);
    if matches!(cycle.kind, Kind::DrillDwell | Kind::BoreSpindleStop | Kind::BoreDwell) {
        record.dwell(state, cycle.dwell);
    }
    let feeds_out = cycle.kind == Kind::Bore && state.choices.is(choice::cycles::BoreReturn::Feed);
    if cycle.kind == Kind::Bore {
        state.coverage.accepted(rule::cycles::BORE_RETURN);
    }
    if cycle.kind == Kind::BoreDwell || feeds_out {
        feed_along(normal, cycle.clear, state, record);
        return Ok(());
    }
    if cycle.kind == Kind::Bore {
        feed_along(normal, cycle.retract, state, record);
    }
    let turn = state.modes.spindles[cycle.spindle].turn;
    if cycle.kind == Kind::BoreSpindleStop {
        turn_spindle(SpindleTurn::Stopped, cycle, state);
    }
    traverse_along(normal, cycle.clear, state, record);
    if cycle.kind == Kind::BoreSpindleStop {
        turn_spindle(turn, cycle, state);
    }
    Ok(())
}

/// Pecks: each feeds deeper by Q, or to the bottom where that is less.
///
/// Rule cycles.chip-breaking. Between two pecks G73 backs off by 0.254 mm or 0.01 inch. Rule cycles.peck. G83
/// traverses out to R, whatever the return mode is, and back to that much above what it has drilled. Choice
/// cycles.chip-break-return: whether G73 ends at R under G98 too. Rule cycles.peck-return. By a choice G83 goes out to
/// the clear height.
fn pecks(cycle: &Cycle, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let [_, _, normal] = cycle.axes;
    let back_off = match state.modes.units {
        LengthUnit::Inch => 0.01,
        LengthUnit::Millimetre => 0.254,
    };
    let is_clear = state.choices.is(choice::cycles::PeckReturn::Clear);
    let between = if is_clear { cycle.clear } else { cycle.retract };
    let mut drilled = cycle.retract - cycle.peck;
    while !state.dialect().is_last_peck(drilled - cycle.bottom, state) {
        if record.is_full() {
            return Err(StepError::TooManyEffects);
        }
        feed_along(normal, drilled, state, record);
        if cycle.kind == Kind::Peck {
            state.coverage.accepted(rule::cycles::PECK_RETURN);
            traverse_along(normal, between, state, record);
        }
        traverse_along(normal, drilled + back_off, state, record);
        drilled -= cycle.peck;
    }
    feed_along(normal, cycle.bottom, state, record);
    let ends_at_retract = cycle.kind == Kind::ChipBreaking
        && state.choices.is(choice::cycles::ChipBreakReturn::Retract);
    let end = if ends_at_retract { cycle.retract } else { cycle.clear };
    traverse_along(normal, end, state, record);
    Ok(())
}
