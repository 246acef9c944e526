//! G74 and G84: tapping with a floating chuck.

use gaugeblock_vocabulary::{FaultKind, SpindleTurn, Switch};

use super::cycle::{Cycle, Kind, turn_spindle};
use crate::ids::{Rule, choice, rule};
use crate::rs274::order::Phase;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::{Record, update_pins};

/// Choice cycles.tap-direction: whether the spindle must turn as the thread is cut.
pub(super) fn check_direction(
    cycle: &Cycle,
    cutting: SpindleTurn,
    state: &State,
) -> Result<(), StepError> {
    let rule = Rule::of_choice::<choice::cycles::TapDirection>();
    if state.choices.is(choice::cycles::TapDirection::Any) {
        return Ok(());
    }
    let kind = match state.dialect().known_turn(cycle.spindle, state) {
        turn if turn == cutting => return Ok(()),
        SpindleTurn::Stopped | SpindleTurn::Oriented => FaultKind::ZeroSpeed,
        SpindleTurn::Clockwise | SpindleTurn::Counterclockwise => FaultKind::ModalConflict,
    };
    Err(refuse(rule, kind, "tapping, and the spindle does not turn as the thread is cut"))
}

/// Rules cycles.tap-right and cycles.tap-left. It feeds to the bottom, stops the spindle, starts it the other way,
/// dwells, and feeds out to the clear height. Choice cycles.tap-without-dwell: without P it may not dwell.
///
/// Rule cycles.tap-overrides. The feed override and the spindle's speed override are disabled meanwhile. Choice
/// cycles.tap-override-switches: or not. Choice cycles.tap-return: whether the spindle turns as before afterwards. A
/// spindle that was oriented is stopped: nothing turns it back to its angle.
pub(super) fn perform(cycle: &Cycle, state: &mut State, record: &mut Record) {
    let [_, _, normal] = cycle.axes;
    let place = cycle.spindle;
    let before = state.modes.spindles[place];
    let feed_override = state.modes.feed_override;
    if state.choices.is(choice::cycles::TapOverrideSwitches::Disabled) {
        state.modes.feed_override = Switch::Off;
        state.modes.spindles[place].speed_override = Switch::Off;
    }
    // Also where the bottom is where the controlled point is, and no move shows it.
    update_pins(state, Some(Phase::Motion));
    state.dialect().feed_tap(normal, cycle.bottom, state, record);
    let out = if cycle.kind == Kind::TapRight {
        SpindleTurn::Counterclockwise
    } else {
        SpindleTurn::Clockwise
    };
    turn_spindle(SpindleTurn::Stopped, cycle, state);
    turn_spindle(out, cycle, state);
    if cycle.dwells || !state.choices.is(choice::cycles::TapWithoutDwell::None) {
        record.dwell(state, cycle.dwell);
    }
    state.dialect().feed_tap(normal, cycle.clear, state, record);
    if state.choices.is(choice::cycles::TapReturn::AsBefore) {
        turn_spindle(SpindleTurn::Stopped, cycle, state);
        if matches!(before.turn, SpindleTurn::Clockwise | SpindleTurn::Counterclockwise) {
            turn_spindle(before.turn, cycle, state);
        }
    }
    state.modes.feed_override = feed_override;
    state.modes.spindles[place].speed_override = before.speed_override;
    state.coverage.accepted(rule::cycles::TAP_OVERRIDES);
}
