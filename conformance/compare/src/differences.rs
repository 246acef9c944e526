//! All differences of two runs, block by block. Their traces are aligned, so that an effect that one side has more
//! shifts nothing.

use std::collections::BTreeMap;
use std::ops::Range;

use gaugeblock_vocabulary::{BlockLocation, End, Entry, Settings, State, Value};

use crate::accuracy::Quantity;
use crate::alignment::{ALIGNED_MAX, Segment, pairs, segments};
use crate::observe::{Observed, ObservedEffect, ObservedStep};
use crate::{Capabilities, Divergence, NEXT_BLOCK, end_text, rounded, tolerance};

/// What a side has where it has no such effect.
const NO_EFFECT: &str = "no such effect";

/// The differences in the order of the blocks. A setting or a field of the state that stays different is listed where
/// it begins to be, and again where it changes. After a block that only one side executes, a bounded number of blocks
/// is aligned: the rest follows from it.
pub fn differences(
    expected: &Observed,
    found: &Observed,
    observables: &Capabilities,
) -> Vec<Divergence> {
    let mut walk =
        Walk { expected, found, observables, lasting: BTreeMap::new(), list: Vec::new() };
    if observables.blocks {
        walk.blocks();
    } else {
        let all = |run: &Observed| 0..run.effects.len();
        walk.effects(all(expected), all(found));
    }
    walk.end();
    walk.parameters();
    walk.list
}

struct Walk<'a> {
    expected: &'a Observed,
    found: &'a Observed,
    observables: &'a Capabilities,
    /// Fields that differ since an earlier block, with both values.
    lasting: BTreeMap<String, (String, String)>,
    list: Vec<Divergence>,
}

impl Walk<'_> {
    /// Blocks that both sides execute are compared; of the others, the first of each sequence is listed, except after
    /// the end of a side, which is a difference of its own.
    fn blocks(&mut self) {
        let (mut left, mut right) = (executed(self.expected), executed(self.found));
        let both = left.iter().zip(&right).take_while(|(a, b)| a.block == b.block);
        let most = both.count() + ALIGNED_MAX;
        left.truncate(most);
        right.truncate(most);
        let keys = |steps: &[&ObservedStep]| -> Vec<(String, u32)> {
            steps.iter().map(|step| (step.block.file.to_string(), step.block.line)).collect()
        };
        for segment in segments(&keys(&left), &keys(&right)) {
            match segment {
                Segment::Equal(old, new) => {
                    for (expected, found) in old.zip(new) {
                        self.block(left[expected], right[found]);
                    }
                }
                Segment::Different(old, new) => {
                    let is_after_end = old.start == left.len() || new.start == right.len();
                    if is_after_end && !self.same_end() {
                        continue;
                    }
                    let first = |steps: &[&ObservedStep], range: Range<usize>| {
                        range.clone().next().map(|at| steps[at].block.clone())
                    };
                    self.other_blocks(first(&left, old), first(&right, new));
                }
            }
        }
    }

    /// Lists the first blocks that only one side executes.
    fn other_blocks(&mut self, expected: Option<BlockLocation>, found: Option<BlockLocation>) {
        let name = |block: &Option<BlockLocation>| {
            block.as_ref().map_or_else(|| "not executed".to_owned(), ToString::to_string)
        };
        self.list.push(Divergence {
            field: NEXT_BLOCK.to_owned(),
            expected: name(&expected),
            found: name(&found),
            block: expected.or(found),
        });
    }

    fn block(&mut self, expected: &ObservedStep, found: &ObservedStep) {
        let observables = self.observables;
        self.effects(expected.effects.clone(), found.effects.clone());
        if expected.state.is_some() && found.state.is_some() {
            let fields = &observables.fields;
            let entries = (entries(expected), entries(found));
            self.fields(expected, &entries.0, &entries.1, |field| fields.contains(field));
        }
    }

    /// Aligns effects, and compares the settings at those that both sides have.
    fn effects(&mut self, expected: Range<usize>, found: Range<usize>) {
        let (left, right) = (self.shown(self.expected, expected), self.shown(self.found, found));
        let keys = |effects: &[&ObservedEffect]| -> Vec<String> {
            effects.iter().map(|effect| coarse(effect)).collect()
        };
        for (expected, found) in pairs(&keys(&left), &keys(&right)) {
            self.effect(expected.map(|at| left[at]), found.map(|at| right[at]));
        }
    }

    fn effect(&mut self, expected: Option<&ObservedEffect>, found: Option<&ObservedEffect>) {
        let step = match (expected, found) {
            (Some(effect), _) => self.expected.steps.get(effect.step),
            (None, Some(effect)) => self.found.steps.get(effect.step),
            (None, None) => None,
        };
        let Some(step) = step else { return };
        let observables = self.observables;
        if let (Some(a), Some(b)) = (expected, found)
            && tolerance::effects(&a.effect, &b.effect, observables.resolution_at(&a.settings))
        {
            let fields = &observables.fields_at_effects;
            let (a, b) = (a.settings.entries(), b.settings.entries());
            self.fields(step, &a, &b, |field| fields.contains(field));
            return;
        }
        let text = |effect: Option<&ObservedEffect>| effect.map_or(NO_EFFECT.to_owned(), described);
        let (expected, found) = (text(expected), text(found));
        let block = Some(step.block.clone());
        self.list.push(Divergence { block, field: "effect".to_owned(), expected, found });
    }

    /// Lists fields that begin to differ, or that differ in another way than before.
    fn fields(
        &mut self,
        step: &ObservedStep,
        expected: &[Entry],
        found: &[Entry],
        is_shown: impl Fn(&str) -> bool,
    ) {
        for entry in expected.iter().filter(|entry| is_shown(entry.field)) {
            let fits = |other: &&Entry| other.field == entry.field && other.index == entry.index;
            let Some(other) = found.iter().find(fits) else { continue };
            let name = entry.name();
            let resolution = self.observables.resolution_of(entry.field, found);
            if tolerance::fields(entry.field, &entry.value, &other.value, resolution) {
                self.lasting.remove(&name);
                continue;
            }
            let values = (rounded(&entry.value), rounded(&other.value));
            if self.lasting.insert(name.clone(), values.clone()).as_ref() != Some(&values) {
                let (expected, found) = values;
                let block = Some(step.block.clone());
                self.list.push(Divergence { block, field: name, expected, found });
            }
        }
    }

    /// How the runs end: where one side refuses a block that the other one executes, at that block.
    fn end(&mut self) {
        if self.same_end() {
            return;
        }
        let (expected, found) = (&self.expected.end, &self.found.end);
        let refused =
            |end: &End| if let End::Fault(fault) = end { fault.block.clone() } else { None };
        let count = |run: &Observed| executed(run).len();
        let is_first = count(self.expected) <= count(self.found);
        let (expected_at, found_at) = (refused(expected), refused(found));
        let (expected, found) = match (&expected_at, &found_at) {
            (Some(_), other) if is_first || other.is_none() => (refusal(expected), end_of(found)),
            (_, Some(_)) => (end_of(expected), refusal(found)),
            _ => (end_text(expected), end_text(found)),
        };
        let block = if is_first { expected_at.or(found_at) } else { found_at.or(expected_at) };
        self.list.push(Divergence { block, field: "end".to_owned(), expected, found });
    }

    fn same_end(&self) -> bool {
        match (&self.expected.end, &self.found.end) {
            (End::Fault(a), End::Fault(b)) => {
                let both = a.block.as_ref().zip(b.block.as_ref());
                !self.observables.faults_have_blocks || both.is_none_or(|(a, b)| a == b)
            }
            (a, b) => a.name() == b.name(),
        }
    }

    fn parameters(&mut self) {
        let both = (&self.expected.parameters, &self.found.parameters);
        let (true, (Some(left), Some(right))) = (self.observables.final_parameters, both) else {
            return;
        };
        let refused = |run: &Observed| matches!(run.end, End::Fault(_));
        if refused(self.expected) || refused(self.found) {
            return;
        }
        let numbers: std::collections::BTreeSet<u32> =
            left.0.keys().chain(right.0.keys()).copied().collect();
        let hidden = &self.observables.hidden_parameters;
        for number in numbers.into_iter().filter(|n| !hidden.iter().any(|range| range.contains(n)))
        {
            let value = |side: &gaugeblock_vocabulary::Indexed<u32, f64>| {
                side.0.get(&number).copied().unwrap_or_default()
            };
            let (a, b) = (value(left), value(right));
            let resolution = self.observables.resolution();
            if !tolerance::numbers(a, b, Quantity::Number, resolution) {
                self.list.push(Divergence {
                    block: None,
                    field: format!("#{number} at the end"),
                    expected: rounded(&Value::Number(a)),
                    found: rounded(&Value::Number(b)),
                });
            }
        }
    }

    /// The effects that the controllers report.
    fn shown<'r>(&self, run: &'r Observed, range: Range<usize>) -> Vec<&'r ObservedEffect> {
        let is_shown = |effect: &&ObservedEffect| {
            self.observables.effects.contains(effect.effect.name())
                && (self.observables.moves_in_place || !effect.in_place)
        };
        run.effects.get(range).unwrap_or_default().iter().filter(is_shown).collect()
    }
}

/// The blocks that did something or have a state: whether others are in a trace is each interpreter's own.
fn executed(run: &Observed) -> Vec<&ObservedStep> {
    run.steps.iter().filter(|step| step.state.is_some() || !step.effects.is_empty()).collect()
}

/// Settings and state after a block, without the parameters that a program names: only assertions compare them.
fn entries(step: &ObservedStep) -> Vec<Entry> {
    let mut entries = Settings::entries(&step.settings);
    entries.extend(step.state.iter().flat_map(State::entries));
    entries.retain(|entry| entry.field != "parameter");
    entries
}

/// An effect as it is aligned: its numbers without the digits that a resolution can take.
fn coarse(effect: &ObservedEffect) -> String {
    let mut text = effect.effect.name().to_owned();
    for (name, value) in effect.effect.arguments() {
        let value = match value {
            Value::Number(number) => format!("{number:.2}"),
            Value::Position(position) => format!("{:.2?}", position.to_array()),
            other @ (Value::Word(_) | Value::Text(_)) => other.to_string(),
        };
        text.push_str(&format!(" {name}={value}"));
    }
    text
}

fn described(effect: &ObservedEffect) -> String {
    let mut text = effect.effect.name().to_owned();
    for (name, value) in effect.effect.arguments() {
        text.push_str(&format!(" {name}={}", rounded(&value)));
    }
    text
}

fn refusal(end: &End) -> String {
    let End::Fault(fault) = end else { return end_text(end) };
    let kind = fault.kind.map_or_else(String::new, |kind| format!(" ({kind})"));
    format!("refuses this block{kind}: {}", fault.message)
}

/// How a side goes on that executes the block.
fn end_of(end: &End) -> String {
    format!("executes this block; at the end: {}", end_text(end))
}

#[cfg(test)]
mod tests {
    use gaugeblock_reference::run;
    use gaugeblock_vocabulary::{Outcome, Scenario};

    use super::*;

    fn compared(expected: &str, found: &str) -> Vec<String> {
        let outcome = |program: &str| -> Outcome { run(&Scenario::of(program)).0 };
        let (expected, found) = (outcome(expected), outcome(found));
        let everything = Capabilities::everything("a", "1");
        let list = differences(&Observed::of(&expected), &Observed::of(&found), &everything);
        list.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn effect_that_one_side_has_more_shifts_nothing() {
        let list = compared("g21\ng0 x1\ng0 x3\nm2\n", "g21\n(msg,hello) g0 x1\ng0 x3\nm2\n");
        assert_eq!(list.len(), 1, "{list:#?}");
        assert!(list[0].starts_with("main.ngc:2: effect: expected no such effect, found message"));
        assert!(compared("g21\ng0 x1\nm2\n", "g21\ng0 x1\nm2\n").is_empty());
    }

    #[test]
    fn field_that_stays_different_is_listed_where_it_begins_and_where_it_changes() {
        let list = compared("f10\n\ng4 p1\nf30\nm2\n", "f20\n\ng4 p1\nf40\nm2\n");
        let fields: Vec<_> = list.iter().filter(|text| text.contains("feed_rate")).collect();
        assert_eq!(fields.len(), 2, "{list:#?}");
        assert!(fields[0].starts_with("main.ngc:1:") && fields[1].starts_with("main.ngc:4:"));
    }

    #[test]
    fn refused_block_is_the_difference_and_not_what_follows() {
        let list = compared("g0 x1\nm72\ng0 x2\nm2\n", "g0 x1\nm9\ng0 x2\nm2\n");
        assert_eq!(list.len(), 1, "{list:#?}");
        assert!(list[0].starts_with("main.ngc:2: end: expected refuses this block"), "{list:#?}");
        assert!(list[0].ends_with("executes this block; at the end: program end"), "{list:#?}");
    }

    #[test]
    fn runs_that_execute_many_other_blocks_end_in_few_differences() {
        let looped = |times: u32| format!("o1 repeat [{times}]\ng0 x1\no1 endrepeat\nm2\n");
        let list = compared(&looped(1), &looped(8_000));
        assert!((1..=3).contains(&list.len()), "{}", list.len());
    }
}
