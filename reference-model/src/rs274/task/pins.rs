//! The values of the machine's pins, from the active modes.

use gaugeblock_vocabulary::{Pin, SpindleMode, SpindleTurn, Switch};

use crate::ids::{Rule, rule};
use crate::rs274::execute;
use crate::rs274::modes::Spindle;
use crate::rs274::order::Phase;
use crate::rs274::state::{PinSnapshot, State};

/// Brings the pins up to date, also within a phase that goes on.
///
/// Rules coolant.mist-pin and coolant.flood-pin. Each coolant has a pin.
pub(crate) fn update_pins(state: &mut State, after: Option<Phase>) {
    if state.pins_are_current() {
        return;
    }
    for rule in (0..)
        .zip(&state.modes.spindles)
        .flat_map(|(number, spindle)| of_override(spindle, state.panel.spindle_override(number)))
    {
        state.coverage.accepted(rule);
    }
    execute::pass(0.0, state);
    let coolants = [(Pin::CoolantMist, state.modes.mist), (Pin::CoolantFlood, state.modes.flood)];
    for (pin, switch) in coolants {
        set_pin(pin, digital(switch == Switch::On), after, state);
    }
    for place in 0..state.modes.spindles.len() {
        let Ok(number) = u16::try_from(place) else { break };
        let turn = state.dialect().commanded_turn(place, state);
        let spindle = Spindle { turn, ..state.modes.spindles[place] };
        let pins = of_spindle(number, &spindle, state.panel.spindle_override(number));
        for (pin, value) in pins.into_iter().flatten() {
            set_pin(pin, value, after, state);
        }
    }
    let (modes, environment) = (&state.modes, &state.environment);
    state.pin_snapshot = (!environment.is_orienting()).then(|| PinSnapshot {
        spindles: modes.spindles.clone(),
        overrides: state.panel.spindle_overrides.clone(),
        mist: modes.mist,
        flood: modes.flood,
        changes: environment.changes().len(),
    });
}

fn set_pin(pin: Pin, value: f64, after: Option<Phase>, state: &mut State) {
    if (state.environment.level(pin) - value).abs() > 0.0 {
        state.environment.set(pin, value);
        changed_pin(pin, value, after, state);
    }
}

/// Rule spindle.turns-at-speed. The pins of a spindle report how it turns; each spindle has its own
/// (spindle.each-turns).
///
/// Rule spindle.turns-later. A speed above zero lets a spindle turn that was started before.
/// Rule spindle.override-turned-up. So does its override.
fn changed_pin(pin: Pin, value: f64, after: Option<Phase>, state: &mut State) {
    let coverage = &mut state.coverage;
    if pin == Pin::CoolantMist {
        coverage.accepted(rule::coolant::MIST_PIN);
    } else if pin == Pin::CoolantFlood {
        coverage.accepted(rule::coolant::FLOOD_PIN);
    } else if let Pin::SpindleOn(number) = pin {
        coverage.accepted(rule::spindle::TURNS_AT_SPEED);
        if number > 0 {
            coverage.accepted(rule::spindle::EACH_TURNS);
        }
        let starts = value > 0.0;
        if starts && after == Some(Phase::SpindleSpeed) {
            coverage.accepted(rule::spindle::TURNS_LATER);
        } else if starts && after.is_none() {
            coverage.accepted(rule::spindle::OVERRIDE_TURNED_UP);
        }
    }
}

/// The rules by which a spindle that was started is stopped, or turns at another speed than S.
///
/// Rule spindle.zero-speed-stands. A spindle with a speed of zero does not turn.
/// Rule spindle.override-zero-stands. A spindle whose override is enabled and zero does not turn.
/// Rule spindle.override-counts. An override that is enabled changes its speed.
/// Rule overrides.speed-value. One that is disabled does not.
fn of_override(spindle: &Spindle, factor: f64) -> Option<Rule> {
    if spindle.turn == SpindleTurn::Stopped {
        None
    } else if spindle.speed == 0.0 {
        Some(rule::spindle::ZERO_SPEED_STANDS)
    } else if (factor - 1.0).abs() == 0.0 {
        None
    } else if spindle.speed_override == Switch::Off {
        Some(rule::overrides::SPEED_VALUE)
    } else if factor == 0.0 {
        Some(rule::spindle::OVERRIDE_ZERO_STANDS)
    } else {
        Some(rule::spindle::OVERRIDE_COUNTS)
    }
}

fn digital(on: bool) -> f64 {
    if on { 1.0 } else { 0.0 }
}

/// The pins of one spindle with their values; one that nothing is known of is left out.
fn of_spindle(number: u16, spindle: &Spindle, factor: f64) -> [Option<(Pin, f64)>; 4] {
    let factor = if spindle.speed_override == Switch::On { factor } else { 1.0 };
    let speed = spindle.speed * factor;
    let turns = speed != 0.0;
    let forward = turns && spindle.turn == SpindleTurn::Clockwise;
    let reverse = turns && spindle.turn == SpindleTurn::Counterclockwise;
    let signed = if forward { Some(speed) } else { reverse.then_some(-speed) };
    // Under constant surface speed the radius decides, which is a matter of motion.
    let known = spindle.mode == SpindleMode::Rpm || signed.is_none();
    [
        Some((Pin::SpindleOn(number), digital(forward || reverse))),
        Some((Pin::SpindleForward(number), digital(forward))),
        Some((Pin::SpindleReverse(number), digital(reverse))),
        known.then_some((Pin::SpindleSpeed(number), signed.unwrap_or(0.0))),
    ]
}
