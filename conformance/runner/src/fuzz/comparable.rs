//! What of two runs of a program that nobody has read can be compared, and how a difference is named.

use gaugeblock_compare::{Divergence, NEXT_BLOCK, end_text};
use gaugeblock_vocabulary::{Bound, End, Event, Fault, Language, Outcome};

/// Both runs as far as they can be compared.
///
/// What a refused block did before it was refused is unspecified, and so are the parameters after it. A run whose
/// budget ran out is the beginning of a longer one, and what a budget counts is each interpreter's own: blocks that
/// both finished are compared. What a step of a post-processor costs is told, and so is what counts of custom macros,
/// so that there budgets end both at the same step.
pub fn comparable(mut expected: Outcome, mut found: Outcome) -> (Outcome, Outcome) {
    if expected.language != Language::Rs274 && found.language != Language::Rs274 {
        return (expected, found);
    }
    if is_exhausted(&expected) || is_exhausted(&found) {
        let sure = finished(&expected).min(finished(&found)).saturating_sub(1);
        cut(&mut expected, sure);
        cut(&mut found, sure);
    } else if matches!(expected.end, End::Fault(_)) || matches!(found.end, End::Fault(_)) {
        expected.parameters = None;
        found.parameters = None;
    }
    (expected, found)
}

fn is_exhausted(outcome: &Outcome) -> bool {
    matches!(outcome.end, End::BudgetExhausted { .. })
}

/// How many blocks have a state.
fn finished(outcome: &Outcome) -> usize {
    outcome.steps.iter().filter(|step| step.state.is_some()).count()
}

/// Leaves the first so many blocks that have a state, and those before the last of them.
fn cut(outcome: &mut Outcome, blocks: usize) {
    let with_state = outcome.steps.iter().enumerate().filter(|(_, step)| step.state.is_some());
    let end = blocks.checked_sub(1).and_then(|last| with_state.map(|(at, _)| at + 1).nth(last));
    outcome.steps.truncate(end.unwrap_or_default());
    outcome.end = End::BudgetExhausted { bound: Bound::Steps };
    outcome.parameters = None;
    outcome.pins.clear();
}

/// The difference, named by the refusal where one side goes on behind a block that the other one refuses: what
/// follows from that is not what differs.
pub(super) fn named(divergence: Divergence, expected: &Outcome, found: &Outcome) -> Divergence {
    let goes_on = divergence.field == "end"
        || divergence.field == NEXT_BLOCK
        || (divergence.field == "effect"
            && [&divergence.expected, &divergence.found]
                .iter()
                .any(|text| *text == "no further effect"));
    if !goes_on {
        return if divergence.field == "effect" {
            missing(divergence, expected, found)
        } else {
            divergence
        };
    }
    let fault = |outcome: &Outcome| -> Option<Fault> {
        if let End::Fault(fault) = &outcome.end { Some(fault.clone()) } else { None }
    };
    let accepted = || "accepted".to_owned();
    let (left, right) = (finished(expected), finished(found));
    match (fault(expected), fault(found)) {
        (Some(fault), other) if left < right || other.is_none() => Divergence {
            block: fault.block,
            field: "end".to_owned(),
            expected: end_text(&expected.end),
            found: accepted(),
        },
        (other, Some(fault)) if right < left || other.is_none() => Divergence {
            block: fault.block,
            field: "end".to_owned(),
            expected: accepted(),
            found: end_text(&found.end),
        },
        _ if divergence.field == "effect" => missing(divergence, expected, found),
        _ => divergence,
    }
}

/// An effect that one side lacks is compared with the one that happens to come next: that one does not differ.
fn missing(divergence: Divergence, expected: &Outcome, found: &Outcome) -> Divergence {
    let name = |text: &str| text.split(' ').next().unwrap_or_default().to_owned();
    let (left, right) = (name(&divergence.expected), name(&divergence.found));
    if left == right {
        return divergence;
    }
    let count = |outcome: &Outcome, name: &str| {
        let events = outcome.steps.iter().flat_map(|step| &step.events);
        events.filter(|event| matches!(event, Event::Do(effect) if effect.name() == name)).count()
    };
    let nothing = || "no such effect".to_owned();
    if count(expected, &left) > count(found, &left) {
        Divergence { found: nothing(), ..divergence }
    } else if count(found, &right) > count(expected, &right) {
        Divergence { expected: nothing(), ..divergence }
    } else {
        divergence
    }
}
