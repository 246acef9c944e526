//! Whether two outcomes are the same value by value: found out step by step, without writing down what is in force at
//! each.

use gaugeblock_vocabulary::{
    Effect, End, Entry, Event, Outcome, Pin, PinChange, Rs274State, Settings, State, Step,
};

use super::tolerance;
use crate::accuracy::{Quantity, Resolution};

/// Whether two outcomes are surely equal; pins where `pins` says so and no block was refused, for what a refused
/// block did to them is unspecified. A `false` says nothing.
///
/// Most runs of two interpreters in this process are, and finding that out costs a fraction of a comparison.
pub fn certainly_equal(expected: &Outcome, found: &Outcome, pins: bool) -> bool {
    let refused = matches!(expected.end, End::Fault(_));
    same_end(&expected.end, &found.end)
        && same_parameters(expected, found)
        && (refused || !pins || same_pins(&expected.pins, &found.pins))
        && same_steps(expected, found)
}

fn same_number(a: f64, b: f64) -> bool {
    tolerance::numbers(a, b, Quantity::Number, Resolution::EXACT)
}

fn same_end(a: &End, b: &End) -> bool {
    match (a, b) {
        (End::Fault(a), End::Fault(b)) => a.block == b.block,
        _ => a == b,
    }
}

fn same_parameters(a: &Outcome, b: &Outcome) -> bool {
    let (Some(a), Some(b)) = (&a.parameters, &b.parameters) else {
        return a.parameters.is_none() && b.parameters.is_none();
    };
    let (mut left, mut right) = (a.0.iter(), b.0.iter());
    a.0.len() == b.0.len()
        && left.all(|(number, a)| {
            right.next().is_some_and(|(other, b)| number == other && same_number(*a, *b))
        })
}

/// Whether each pin took the same values in order, at whatever times; a repeated value is not a change.
fn same_pins(a: &[PinChange], b: &[PinChange]) -> bool {
    let same_value =
        |((pin, a), (other, b)): (&(Pin, f64), &(Pin, f64))| pin == other && same_number(*a, *b);
    a == b || {
        let (a, b) = (values_by_pin(a), values_by_pin(b));
        a.len() == b.len() && a.iter().zip(&b).all(same_value)
    }
}

/// The values of the pins, pin by pin.
fn values_by_pin(changes: &[PinChange]) -> Vec<(Pin, f64)> {
    let mut values: Vec<_> = changes.iter().map(|change| (change.pin, change.value)).collect();
    values.sort_by_key(|(pin, _)| *pin);
    values.dedup();
    values
}

fn same_steps(a: &Outcome, b: &Outcome) -> bool {
    // An o-word that did nothing has no state, and whether it stands in a trace is each interpreter's own.
    let tells = |step: &&Step| step.state.is_some() || !step.events.is_empty();
    let of = |outcome| compared(outcome).iter().filter(tells);
    if a.start == b.start && of(a).eq(of(b)) {
        // Told in the same words.
        return true;
    }
    let mut both = StatePair::new(a, b);
    let (mut a, mut b) = (of(a), of(b));
    both.same_settings()
        && loop {
            match (a.next(), b.next()) {
                (None, None) => break true,
                (Some(a), Some(b)) => {
                    if a.block != b.block || !both.same_events(a, b) || !both.same_states(a, b) {
                        break false;
                    }
                }
                (Some(_), None) | (None, Some(_)) => break false,
            }
        }
}

/// The steps of an outcome without a refused block, which is unspecified.
fn compared(outcome: &Outcome) -> &[Step] {
    match (&outcome.end, outcome.steps.split_last()) {
        (End::Fault(fault), Some((last, before)))
            if fault.block.as_ref() == Some(&last.block) && last.state.is_none() =>
        {
            before
        }
        _ => &outcome.steps,
    }
}

/// What is in force on both sides.
struct StatePair {
    settings: (Settings, Settings),
    states: (State, State),
}

impl StatePair {
    fn new(a: &Outcome, b: &Outcome) -> Self {
        Self {
            settings: (a.start.clone(), b.start.clone()),
            states: (State::empty(a.language), State::empty(b.language)),
        }
    }

    /// Whether the settings are the same at each effect and after the block. The order and number of reports do not
    /// matter.
    fn same_events(&mut self, a: &Step, b: &Step) -> bool {
        let (left, right) = (&mut self.settings.0, &mut self.settings.1);
        let (mut one, mut other) = (a.events.iter(), b.events.iter());
        if a.events == b.events && !has_unknown(a) {
            // What was in force before the block is the same, and what changes too.
            while next_effect(&mut one, left).is_some() {}
            while next_effect(&mut other, right).is_some() {}
            return true;
        }
        if has_unknown(a) || has_unknown(b) {
            return false;
        }
        loop {
            let (left, right) = (&mut self.settings.0, &mut self.settings.1);
            let effects = (next_effect(&mut one, left), next_effect(&mut other, right));
            let same = match effects {
                (Some(a), Some(b)) => same_effect(a, b),
                (None, None) => return self.same_settings(),
                (Some(_), None) | (None, Some(_)) => false,
            };
            if !same || !self.same_settings() {
                return false;
            }
        }
    }

    fn same_settings(&self) -> bool {
        let (left, right) = &self.settings;
        left == right || same_entries(&left.entries(), &right.entries())
    }

    /// Whether the states after a block are the same, except for the reports of parameters.
    fn same_states(&mut self, a: &Step, b: &Step) -> bool {
        let (left, right) = (&mut self.states.0, &mut self.states.1);
        match (&a.state, &b.state) {
            (None, None) => true,
            (Some(a), Some(b)) => {
                overlay(left, a);
                overlay(right, b);
                left == right || same_entries(&left.entries(), &right.entries())
            }
            (Some(_), None) | (None, Some(_)) => false,
        }
    }
}

/// Takes over a later record, without the parameters of an RS-274 controller.
fn overlay(state: &mut State, change: &State) {
    let (State::Rs274(state), State::Rs274(change)) = (&mut *state, change) else {
        return state.overlay(change);
    };
    let &Rs274State {
        motion,
        position,
        tool,
        prepared_tool,
        controller_mode,
        call_level,
        parameter: _,
    } = change;
    state.overlay(&Rs274State {
        motion,
        position,
        tool,
        prepared_tool,
        controller_mode,
        call_level,
        parameter: None,
    });
}

fn has_unknown(step: &Step) -> bool {
    step.events.iter().any(|event| matches!(event, Event::Unknown(_)))
}

fn same_effect(a: &Effect, b: &Effect) -> bool {
    a == b || tolerance::effects(a, b, Resolution::EXACT)
}

fn same_entries(a: &[Entry], b: &[Entry]) -> bool {
    a.len() == b.len()
        && a.iter().zip(b).all(|(a, b)| {
            (a.field, &a.index) == (b.field, &b.index)
                && tolerance::fields(a.field, &a.value, &b.value, Resolution::EXACT)
        })
}

fn next_effect<'a>(
    events: &mut impl Iterator<Item = &'a Event>,
    settings: &mut Settings,
) -> Option<&'a Effect> {
    for event in events {
        match event {
            Event::Set(change) => settings.overlay(change),
            Event::Do(effect) => return Some(effect),
            Event::Unknown(fields) => settings.forget(fields),
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pins_are_the_same_whenever_they_change() {
        let change = |time, pin, value| PinChange { time, pin, value };
        let (mist, flood) = (Pin::CoolantMist, Pin::CoolantFlood);
        let one = [change(0.0, mist, 1.0), change(0.0, flood, 1.0), change(1.0, mist, 0.0)];
        let other = [
            change(0.5, flood, 1.0),
            change(0.5, mist, 1.0),
            change(0.7, mist, 1.0),
            change(2.0, mist, 0.0),
        ];
        assert!(same_pins(&one, &other));
        assert!(!same_pins(&one, &other[..3]));
        let unlike = [change(0.0, mist, 1.0), change(1.0, mist, 0.0), change(1.0, flood, 0.0)];
        assert!(!same_pins(&one, &unlike));
    }
}
