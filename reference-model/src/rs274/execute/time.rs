//! Time passes: spindles reach their angle, brakes are applied or released.

use gaugeblock_vocabulary::{Pin, SpindleTurn};

use crate::ids::rule;
use crate::rs274::state::State;

/// Lets time pass; what ends outside meanwhile has ended.
pub(crate) fn pass(seconds: f64, state: &mut State) {
    state.environment.advance(seconds);
    settle(state);
}

/// Updates the pins of spindles that have reached their angle, and the brakes.
///
/// Rule orient.complete. When its encoder says that a spindle is at its angle, the request is cleared and the
/// spindle is locked and braked. A spindle that turns is neither.
fn settle(state: &mut State) {
    if state.pins_are_current() {
        return;
    }
    for (place, time) in state.environment.oriented() {
        state.environment.end_orientation(place);
        let Some(spindle) = index(place) else { continue };
        state.environment.set_at(time, Pin::SpindleOrient(spindle), 0.0);
        state.environment.set_at(time, Pin::SpindleLocked(spindle), 1.0);
        brake_at(time, place, state);
        state.coverage.accepted(rule::orient::COMPLETE);
    }
    for place in state.all_spindles() {
        if turns(place, state) {
            clear_orientation(place, state);
        }
        brake(place, state);
    }
}

/// Whether a spindle is commanded to turn.
pub(super) fn turns(place: usize, state: &State) -> bool {
    let turn = state.dialect().commanded_turn(place, state);
    matches!(turn, SpindleTurn::Clockwise | SpindleTurn::Counterclockwise)
}

/// The brake of a spindle is as it is now.
pub(super) fn brake(place: usize, state: &mut State) {
    brake_at(state.environment.time(), place, state);
}

fn brake_at(time: f64, place: usize, state: &mut State) {
    let Some(spindle) = index(place) else { return };
    let locked = state.environment.level(Pin::SpindleLocked(spindle)) != 0.0;
    let applied = state.dialect().applies_brake(place, locked, state);
    if locked {
        state.coverage.accepted(rule::orient::BRAKE_OTHERWISE);
    }
    state.environment.set_at(time, Pin::SpindleBrake(spindle), if applied { 1.0 } else { 0.0 });
}

/// Rule orient.cleared. M3, M4 and M5 clear the request and unlock the spindle.
pub(crate) fn clear_orientation(place: usize, state: &mut State) {
    let Some(spindle) = index(place) else { return };
    state.environment.end_orientation(place);
    let pins = [Pin::SpindleOrient(spindle), Pin::SpindleLocked(spindle)];
    for pin in pins {
        if state.environment.level(pin) == 0.0 {
            continue;
        }
        state.coverage.accepted(rule::orient::CLEARED);
        state.environment.set(pin, 0.0);
    }
}

/// The index of a spindle's pins.
pub(super) fn index(place: usize) -> Option<u16> {
    u16::try_from(place).ok()
}
