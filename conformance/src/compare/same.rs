//! Whether two outcomes are the same value by value, which needs no folding.

use gaugeblock_trace::{End, Event, Outcome, Settings, Step};

/// Whether two outcomes are surely equal; pins where `pins` says so, and parameters where no block was refused, for what a refused
/// block did is unspecified. A `false` says nothing.
///
/// Most runs of two interpreters in this process are, and finding that out costs a fraction of a comparison.
pub fn surely_same(expected: &Outcome, found: &Outcome, pins: bool) -> bool {
    same_end(&expected.end, &found.end)
        && expected.start == found.start
        && (matches!(expected.end, End::Fault(_)) || expected.parameters == found.parameters)
        && (!pins || expected.pins == found.pins)
        && same_steps(expected, found)
}

fn same_end(a: &End, b: &End) -> bool {
    match (a, b) {
        (End::Fault(a), End::Fault(b)) => a.block == b.block,
        _ => a == b,
    }
}

fn same_steps(a: &Outcome, b: &Outcome) -> bool {
    // An o-word that did nothing has no state, and whether it stands in a trace is each interpreter's own.
    let tells = |step: &&Step| step.state.is_some() || !step.events.is_empty();
    let (mut a, mut b) = (compared(a).iter().filter(tells), compared(b).iter().filter(tells));
    loop {
        match (a.next(), b.next()) {
            (None, None) => return true,
            (Some(a), Some(b)) => {
                if a.block != b.block || a.state != b.state || !same_events(a, b) {
                    return false;
                }
            }
            (Some(_), None) | (None, Some(_)) => return false,
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

/// Whether the same is in force at each effect and after the block. Settings told in another order or number are the same.
fn same_events(a: &Step, b: &Step) -> bool {
    if a.events == b.events {
        return true;
    }
    // What was in force before the block is equal, so that equal changes leave it equal.
    let (mut left, mut right) = (Settings::default(), Settings::default());
    let (mut one, mut other) = (a.events.iter(), b.events.iter());
    loop {
        let effects = (next_effect(&mut one, &mut left), next_effect(&mut other, &mut right));
        if effects.0 != effects.1 || left != right {
            return false;
        }
        if effects.0.is_none() {
            return true;
        }
    }
}

fn next_effect<'a>(
    events: &mut impl Iterator<Item = &'a Event>,
    settings: &mut Settings,
) -> Option<&'a gaugeblock_trace::Effect> {
    for event in events {
        match event {
            Event::Set(change) => settings.overlay(change),
            Event::Do(effect) => return Some(effect),
        }
    }
    None
}
