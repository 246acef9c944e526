//! Two outcomes side by side: the first divergence, and what could not be compared.

pub mod accuracy;
pub mod alignment;
mod capabilities;
pub mod differences;
mod frame;
pub mod judge;
pub mod observe;
pub mod pins;
mod same;
mod state;
mod tally;
#[cfg(test)]
mod tests;
pub mod tolerance;

use std::collections::BTreeSet;

use gaugeblock_suite::assertion::is_accepted;
use gaugeblock_vocabulary::{BlockLocation, End, Entry, Fault, Pin, Settings, Value};

pub use accuracy::Accuracy;
pub use capabilities::Capabilities;
pub use same::certainly_equal;
pub use state::{FieldDifference, StateDifference, state};
pub use tally::{ComparedKind, Tally};
pub use tolerance::rounded;

use crate::accuracy::{Match, Quantity, hidden};
use crate::observe::{Observed, ObservedEffect, ObservedStep, recorded};

/// What is compared where the runs execute different blocks.
pub const NEXT_BLOCK: &str = "next executed block";

/// The first point at which two runs differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Divergence {
    /// The block of the difference, if there is one.
    pub block: Option<BlockLocation>,
    /// What is compared: `effect`, `end`, [`NEXT_BLOCK`], or a field's name.
    pub field: String,
    /// What the specification has.
    pub expected: String,
    /// What the controller did.
    pub found: String,
}

impl std::fmt::Display for Divergence {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some(block) = &self.block {
            write!(f, "{block}: ")?;
        }
        write!(f, "{}: expected {}, found {}", self.field, self.expected, self.found)
    }
}

/// How two runs compare.
#[derive(Clone, Debug, Default)]
pub struct Comparison {
    /// The first difference.
    pub divergence: Option<Divergence>,
    /// Fields and effects that the controller does not show, so that they were not compared.
    pub masked: BTreeSet<String>,
    /// What was compared.
    pub compared: Tally,
}

/// What is masked where the documents refuse a block and a controller that never refuses has executed it.
pub const REFUSALS: &str = "refusals";

impl Comparison {
    /// Whether the controller's outcome is the specified one, as far as it is observable. A refusal that the controller
    /// declares never to make is not its outcome.
    pub fn is_equal(&self) -> bool {
        self.divergence.is_none() && !self.masked.contains(REFUSALS)
    }
}

/// Compares the controller's outcome with the specified one, on what is observable.
///
/// Linear in the length of both runs.
pub fn compare(expected: &Observed, found: &Observed, observables: &Capabilities) -> Comparison {
    let mut walk = Walk { observables, comparison: Comparison::default() };
    let effects = walk.effects(expected, found);
    let states = walk.states(expected, found);
    let earlier = match (effects, states) {
        (Some((at_effect, effect)), Some((at_state, state))) => {
            Some(if at_effect <= at_state { effect } else { state })
        }
        (Some((_, divergence)), None) | (None, Some((_, divergence))) => Some(divergence),
        (None, None) => None,
    };
    let end = walk.end(expected, found);
    walk.comparison.divergence = match (earlier, end) {
        // A run that went on where it should have been refused, or was refused where it should have gone on, says more.
        (Some(earlier), Some(end)) if earlier.field == NEXT_BLOCK => Some(end),
        (Some(earlier), _) => Some(earlier),
        (None, Some(end)) => Some(end),
        (None, None) if walk.hides_refusal(expected, found) => None,
        (None, None) => walk.last(expected, found),
    };
    walk.comparison
}

struct Walk<'a> {
    observables: &'a Capabilities,
    comparison: Comparison,
}

impl Walk<'_> {
    /// The first effect that differs, and its step.
    fn effects(&mut self, expected: &Observed, found: &Observed) -> Option<(usize, Divergence)> {
        for observed in &expected.effects {
            if !self.observables.effects.contains(observed.effect.name()) {
                self.comparison.masked.insert(observed.effect.name().to_owned());
            } else if observed.in_place && !self.observables.moves_in_place {
                self.comparison.masked.insert("moves in place".to_owned());
            }
        }
        let observable = |observed: &&ObservedEffect| {
            self.observables.effects.contains(observed.effect.name())
                && (self.observables.moves_in_place || !observed.in_place)
        };
        let left: Vec<_> = expected.effects.iter().filter(observable).collect();
        let right: Vec<_> = found.effects.iter().filter(observable).collect();
        for place in 0..left.len().max(right.len()) {
            match (left.get(place), right.get(place)) {
                (Some(a), Some(b)) => {
                    let block = &expected.steps[a.step].block;
                    if let Some(divergence) = self.effect(block, a, b) {
                        return Some((a.step, divergence));
                    }
                }
                (Some(a), None) => {
                    let block = expected.steps[a.step].block.clone();
                    return Some((
                        a.step,
                        missing(Some(block), describe(a), "no further effect".to_owned()),
                    ));
                }
                (None, Some(_))
                    if self.may_be_of_refused_block(expected, found)
                        || self.hides_refusal(expected, found) =>
                {
                    self.comparison.masked.insert("effects of a refused block".to_owned());
                    return None;
                }
                (None, Some(b)) => {
                    let step = found.steps.get(b.step).filter(|_| self.observables.blocks);
                    let block = step.map(|step| step.block.clone());
                    return Some((
                        usize::MAX,
                        missing(block, "no further effect".to_owned(), describe(b)),
                    ));
                }
                (None, None) => {}
            }
        }
        None
    }

    /// What a refused block has done is open; without blocks it is whatever comes after the rest.
    fn may_be_of_refused_block(&self, expected: &Observed, found: &Observed) -> bool {
        let refused = |run: &Observed| matches!(run.end, End::Fault(_));
        !self.observables.blocks && refused(expected) && refused(found)
    }

    /// Whether the documents refuse a block that a controller without refusals has executed.
    fn hides_refusal(&self, expected: &Observed, found: &Observed) -> bool {
        let refused = |run: &Observed| matches!(run.end, End::Fault(_));
        !self.observables.refuses && refused(expected) && !refused(found)
    }

    fn effect(
        &mut self,
        block: &BlockLocation,
        a: &ObservedEffect,
        b: &ObservedEffect,
    ) -> Option<Divergence> {
        let resolution = self.observables.resolution_at(&a.settings);
        match resolution.compare(|error| tolerance::effects(&a.effect, &b.effect, error)) {
            Match::Equal => {
                let values = 1 + a.effect.arguments().len();
                self.comparison.compared.add(ComparedKind::Effects, values);
            }
            Match::Hidden => {
                self.comparison.compared.add(ComparedKind::Effects, 1);
                self.comparison.masked.insert(hidden(a.effect.name()));
            }
            Match::Different => {
                return Some(missing(Some(block.clone()), describe(a), describe(b)));
            }
        }
        let observable = &self.observables.fields_at_effects;
        self.fields(block, &a.settings.entries(), &b.settings.entries(), observable)
    }

    /// The first state that differs, and its step.
    fn states(&mut self, expected: &Observed, found: &Observed) -> Option<(usize, Divergence)> {
        if !self.observables.blocks {
            return self.state_at_end(expected, found);
        }
        let (left, right) = (recorded(expected), recorded(found));
        for place in 0..left.len().max(right.len()) {
            if left.get(place).is_none() && self.hides_refusal(expected, found) {
                return None;
            }
            let (Some((at, a)), Some((_, b))) = (left.get(place), right.get(place)) else {
                let name = |step: Option<&(usize, &ObservedStep)>| {
                    step.map_or_else(|| "no further block".to_owned(), |(_, s)| s.block.to_string())
                };
                let at = left.get(place).map_or(usize::MAX, |(at, _)| *at);
                let block =
                    left.get(place).or(right.get(place)).map(|(_, step)| step.block.clone());
                let (expected, found) = (name(left.get(place)), name(right.get(place)));
                return Some((
                    at,
                    Divergence { block, field: NEXT_BLOCK.to_owned(), expected, found },
                ));
            };
            if a.block != b.block {
                let (expected, found) = (a.block.to_string(), b.block.to_string());
                let block = Some(a.block.clone());
                return Some((
                    *at,
                    Divergence { block, field: NEXT_BLOCK.to_owned(), expected, found },
                ));
            }
            if let Some(divergence) = self.step(a, b) {
                return Some((*at, divergence));
            }
        }
        None
    }

    /// The state at the end, for a controller that does not report blocks.
    fn state_at_end(
        &mut self,
        expected: &Observed,
        found: &Observed,
    ) -> Option<(usize, Divergence)> {
        let (left, right) = (recorded(expected), recorded(found));
        if left.len() > 1 {
            self.comparison.masked.insert("blocks".to_owned());
        }
        if !is_accepted(&expected.end) {
            self.comparison.masked.insert("state at a fault".to_owned());
            return None;
        }
        let (at, a) = left.last()?;
        let Some((_, b)) = right.last() else {
            self.comparison.masked.insert("state at the end".to_owned());
            return None;
        };
        Some((*at, self.step(a, b)?))
    }

    fn step(&mut self, a: &ObservedStep, b: &ObservedStep) -> Option<Divergence> {
        let observable = &self.observables.fields;
        self.fields(&a.block, &state::entries(a), &state::entries(b), observable)
    }

    fn fields(
        &mut self,
        block: &BlockLocation,
        expected: &[Entry],
        found: &[Entry],
        observable: &BTreeSet<String>,
    ) -> Option<Divergence> {
        for (place, entry) in expected.iter().enumerate() {
            let fits = |other: &&Entry| other.field == entry.field && other.index == entry.index;
            // Most fields stand at the same place on both sides.
            let other = found.get(place).filter(fits).or_else(|| found.iter().find(fits));
            let is_shown = observable.contains(entry.field);
            let (true, Some(other)) = (is_shown, other) else {
                if is_shown && self.observables.reports_all_fields {
                    let (expected, found) = (rounded(&entry.value), "nothing".to_owned());
                    let (block, field) = (Some(block.clone()), entry.name());
                    return Some(Divergence { block, field, expected, found });
                }
                self.comparison.masked.insert(entry.field.to_owned());
                continue;
            };
            let is_setting = Settings::FIELDS.contains(&entry.field);
            let basis = if is_setting { ComparedKind::Settings } else { ComparedKind::State };
            let resolution = self.observables.resolution_of(entry.field, found);
            let are_equal =
                |error| tolerance::fields(entry.field, &entry.value, &other.value, error);
            match resolution.compare(are_equal) {
                Match::Equal => self.comparison.compared.add(basis, 1),
                Match::Hidden => {
                    self.comparison.masked.insert(hidden(entry.field));
                }
                Match::Different => {
                    return Some(Divergence {
                        block: Some(block.clone()),
                        field: entry.name(),
                        expected: rounded(&entry.value),
                        found: rounded(&other.value),
                    });
                }
            }
        }
        None
    }

    fn end(&mut self, expected: &Observed, found: &Observed) -> Option<Divergence> {
        if self.hides_refusal(expected, found) {
            self.comparison.masked.insert(REFUSALS.to_owned());
            return None;
        }
        let (expected, found) = (&expected.end, &found.end);
        self.comparison.compared.add(ComparedKind::Acceptance, 1);
        let same = match (expected, found) {
            (End::Fault(a), End::Fault(b)) => {
                !self.observables.faults_have_blocks || same_fault(a, b)
            }
            (a, b) => a.name() == b.name(),
        };
        (!same).then(|| Divergence {
            block: if let End::Fault(fault) = expected { fault.block.clone() } else { None },
            field: "end".to_owned(),
            expected: end_text(expected),
            found: end_text(found),
        })
    }

    /// What is left to compare at the end: settings that effects would show, numbered parameters, and pins.
    fn last(&mut self, expected: &Observed, found: &Observed) -> Option<Divergence> {
        let block = expected.steps.last()?.block.clone();
        let none = BTreeSet::new();
        let is_told = self.observables.blocks || is_accepted(&expected.end);
        let observable = if is_told { &self.observables.fields_at_effects } else { &none };
        let entries = |settings: &Settings| settings.entries();
        let settings = self.fields(
            &block,
            &entries(expected.last_settings()),
            &entries(found.last_settings()),
            observable,
        );
        settings.or_else(|| self.parameters(expected, found)).or_else(|| self.pins(expected, found))
    }

    /// The first pin that took other values. What a refused block did to pins is unspecified, and they name no block,
    /// so that those of a refused run are not compared.
    fn pins(&mut self, expected: &Observed, found: &Observed) -> Option<Divergence> {
        if !is_accepted(&expected.end) {
            return None;
        }
        let pins: BTreeSet<Pin> = expected.pins.keys().chain(found.pins.keys()).copied().collect();
        for pin in pins {
            if !self.observables.pins.contains(pin.name()) {
                self.comparison.masked.insert(pin.name().to_owned());
                continue;
            }
            let values = |run: &Observed| run.pins.get(&pin).cloned().unwrap_or_default();
            let (a, b) = (values(expected), values(found));
            let (all, seen) = (a.iter().map(|at| at.value), b.iter().map(|at| at.value));
            let (all, seen): (Vec<f64>, Vec<f64>) = (all.collect(), seen.collect());
            match pins::compare(&a, &seen, self.observables) {
                Match::Equal => self.comparison.compared.add(ComparedKind::Pins, a.len().max(1)),
                Match::Hidden => {
                    self.comparison.masked.insert(hidden(pin.name()));
                }
                Match::Different => {
                    return Some(Divergence {
                        block: None,
                        field: format!("pin {pin}"),
                        expected: pin_values(&all),
                        found: pin_values(&seen),
                    });
                }
            }
        }
        None
    }

    fn parameters(&mut self, expected: &Observed, found: &Observed) -> Option<Divergence> {
        // A language without numbered parameters has none to show.
        let left = expected.parameters.as_ref()?;
        let observable = found.parameters.as_ref().filter(|_| self.observables.final_parameters);
        let Some(right) = observable else {
            self.comparison.masked.insert("parameters at the end".to_owned());
            return None;
        };
        let numbers: BTreeSet<u32> = left.0.keys().chain(right.0.keys()).copied().collect();
        for number in numbers {
            if self.observables.hidden_parameters.iter().any(|hidden| hidden.contains(&number)) {
                self.comparison.masked.insert("some parameters at the end".to_owned());
                continue;
            }
            let value = |side: &gaugeblock_vocabulary::Indexed<u32, f64>| {
                side.0.get(&number).copied().unwrap_or_default()
            };
            let (a, b) = (value(left), value(right));
            let are_equal = |error| tolerance::numbers(a, b, Quantity::Number, error);
            match self.observables.resolution().compare(are_equal) {
                Match::Equal => self.comparison.compared.add(ComparedKind::Parameters, 1),
                Match::Hidden => {
                    self.comparison.masked.insert(hidden("parameters at the end"));
                }
                Match::Different => {
                    return Some(Divergence {
                        block: None,
                        field: format!("#{number} at the end"),
                        expected: rounded(&Value::Number(a)),
                        found: rounded(&Value::Number(b)),
                    });
                }
            }
        }
        None
    }
}

/// Two faults are the same when they are at the same block; kinds are judged by assertions, where a document names
/// them.
fn same_fault(a: &Fault, b: &Fault) -> bool {
    match (&a.block, &b.block) {
        (Some(a), Some(b)) => a == b,
        _ => true,
    }
}

fn missing(block: Option<BlockLocation>, expected: String, found: String) -> Divergence {
    Divergence { block, field: "effect".to_owned(), expected, found }
}

fn describe(observed: &ObservedEffect) -> String {
    let mut text = observed.effect.name().to_owned();
    for (name, value) in observed.effect.arguments() {
        text.push_str(&format!(" {name}={}", rounded(&value)));
    }
    text
}

/// The values that a pin took, as an assertion writes them.
pub fn pin_values(values: &[f64]) -> String {
    let values: Vec<_> = values.iter().map(|value| rounded(&Value::Number(*value))).collect();
    if values.is_empty() { "none".to_owned() } else { values.join(", ") }
}

/// An end in a few words.
pub fn end_text(end: &End) -> String {
    match end {
        End::Fault(fault) => {
            let kind = fault.kind.map_or_else(String::new, |kind| format!(" ({kind})"));
            match &fault.block {
                Some(block) => format!("refused at {block}{kind}"),
                None => format!("refused{kind}"),
            }
        }
        End::Unsupported { block, what } => format!("unsupported at {block}: {what}"),
        End::Unspecified { block, why } => format!("unspecified at {block}: {why}"),
        End::BudgetExhausted { bound } => format!("budget exhausted ({bound})"),
        End::StreamEnd => "end of the stream without a program end".to_owned(),
        End::ProgramEnd | End::PercentEnd | End::Endless | End::Paused | End::Aborted => {
            end.name().replace('_', " ")
        }
    }
}
