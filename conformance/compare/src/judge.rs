//! Judges assertions about an observed run.

use gaugeblock_suite::assertion::{Assertion, Claim, Expected, Place, is_accepted};
use gaugeblock_vocabulary::{Channel, Effect, End, Entry, Pin, Position, Settings, State, Value};

use crate::Capabilities;
use crate::accuracy::{Match, Quantity, Resolution, hidden};
use crate::observe::{Observed, ObservedEffect, ObservedStep, end_of, is_in_place, value_of};
use crate::{REFUSALS, end_text, frame, pin_values, pins, rounded, tolerance};

/// The result of an assertion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Finding {
    /// It holds.
    Holds,
    /// It does not; the sentence says what was found.
    Fails(String),
    /// The controller does not show what it is about.
    Masked(String),
}

/// Judges an assertion on what is observable.
pub fn judge(assertion: &Assertion, run: &Observed, observables: &Capabilities) -> Finding {
    let judge = Judge { run, observables };
    match &assertion.claim {
        Claim::Accepted => ok(is_accepted(&run.end), || end_text(&run.end)),
        Claim::Refused(place) => judge.refused(place.as_ref()),
        Claim::Kind(_) if judge.hides_refusal() => Finding::Masked(REFUSALS.to_owned()),
        Claim::Kind(kind) => {
            let End::Fault(fault) = &run.end else { return Finding::Fails(end_text(&run.end)) };
            match fault.kind.filter(|_| observables.faults_have_kinds) {
                Some(found) => ok(found == *kind, || format!("kind {found}")),
                None => Finding::Masked("kind".to_owned()),
            }
        }
        Claim::Ends(name) => ok(run.end.name() == name, || end_text(&run.end)),
        Claim::After(place, fields) => judge.after(place, fields),
        Claim::AtEnd(fields) => judge.at_end(fields),
        Claim::AtEffect(name, count, fields) => judge.at_effect(name, *count, fields),
        Claim::EffectsAt(_, _) if !observables.blocks => Finding::Masked("blocks".to_owned()),
        Claim::EffectsAt(place, lists) => match (judge.step(place), lists.as_slice()) {
            (Some(step), [effects]) => {
                let begin = judge.begin(step);
                judge.effects(effects, &run.effects[step.effects.clone()], begin, true)
            }
            (Some(step), lists) => {
                judge.effects_with_gaps(lists, &run.effects[step.effects.clone()])
            }
            (None, _) => Finding::Fails(format!("block {place} was not executed")),
        },
        Claim::Unchanged(_, _) if !observables.blocks => Finding::Masked("blocks".to_owned()),
        Claim::Unchanged(place, changed) => match judge.step(place) {
            Some(step) => match frame::unchanged(run, step, changed, observables) {
                Ok(None) => Finding::Holds,
                Ok(Some(masked)) => Finding::Masked(masked),
                Err(found) => Finding::Fails(found),
            },
            None => Finding::Fails(format!("block {place} was not executed")),
        },
        Claim::Effects(effects) => {
            judge.effects(effects, &run.effects, Some(Position::default()), false)
        }
        Claim::Count(name, count) => judge.count(name, *count),
        Claim::Messages(texts) => judge.messages(texts),
        Claim::Output(text) => judge.output(text),
        Claim::Warnings(texts) => judge.warnings(texts),
        Claim::Pin(pin, values) => judge.pin(*pin, values),
    }
}

fn ok(holds: bool, found: impl FnOnce() -> String) -> Finding {
    if holds { Finding::Holds } else { Finding::Fails(found()) }
}

struct Judge<'a> {
    run: &'a Observed,
    observables: &'a Capabilities,
}

impl Judge<'_> {
    /// Whether a controller without refusals has executed the program.
    fn hides_refusal(&self) -> bool {
        !self.observables.refuses && !matches!(self.run.end, End::Fault(_))
    }

    fn refused(&self, place: Option<&Place>) -> Finding {
        if self.hides_refusal() {
            return Finding::Masked(REFUSALS.to_owned());
        }
        let End::Fault(fault) = &self.run.end else {
            return Finding::Fails(end_text(&self.run.end));
        };
        let block = fault.block.as_ref().filter(|_| self.observables.faults_have_blocks);
        match (place, block) {
            (None, _) => Finding::Holds,
            (Some(_), None) => Finding::Masked("the block of a fault".to_owned()),
            (Some(place), Some(block)) => {
                let same = place.file == block.file && place.line == block.line;
                ok(same, || end_text(&self.run.end))
            }
        }
    }

    fn step(&self, place: &Place) -> Option<&ObservedStep> {
        self.run.steps.iter().rev().find(|step| {
            step.block.file == place.file
                && step.block.line == place.line
                && place.execution.is_none_or(|execution| execution == step.execution)
        })
    }

    /// Where the controlled point was before a block, as far as states report it.
    fn begin(&self, step: &ObservedStep) -> Option<Position> {
        let place = self.run.steps.iter().position(|other| std::ptr::eq(other, step))?;
        let before = self.run.steps[..place].iter().rev().find_map(|step| step.state.as_ref());
        match before {
            Some(State::Rs274(state)) => state.position,
            Some(State::Nct(state)) => state.position,
            Some(State::Gpp(_)) => None,
            None => Some(Position::default()),
        }
    }

    fn after(&self, place: &Place, fields: &[Expected]) -> Finding {
        if !self.observables.blocks {
            return Finding::Masked("blocks".to_owned());
        }
        let Some(step) = self.step(place) else {
            return Finding::Fails(format!("block {place} was not executed"));
        };
        let mut entries = step.settings.entries();
        if let Some(state) = &step.state {
            entries.extend(state.entries());
            entries.extend(unset_parameters(fields, &entries));
        }
        self.fields(fields, &entries, |field| self.observables.fields.contains(field))
    }

    /// Where no state is recorded after the last block, an o-word, M98 or M99, only what effects show is judged, and
    /// numbered parameters.
    fn at_end(&self, fields: &[Expected]) -> Finding {
        let stated = if self.observables.blocks {
            self.run.steps.last().is_some_and(|step| step.state.is_some())
        } else {
            is_accepted(&self.run.end)
        };
        let mut entries = self.run.last_settings().entries();
        entries.extend(self.run.last_state().iter().flat_map(|state| state.entries()));
        entries.retain(|entry| entry.field != "parameter");
        let (parameters, others): (Vec<_>, Vec<_>) =
            fields.iter().cloned().partition(|field| field.field == "parameter");
        let is_reported = stated || self.observables.blocks;
        let finding = self.fields(&others, &entries, |field| {
            is_reported && self.observables.fields_at_effects.contains(field)
                || stated && self.observables.fields.contains(field)
        });
        if matches!(finding, Finding::Fails(_)) || parameters.is_empty() {
            return finding;
        }
        match (self.parameters(&parameters), finding) {
            (Finding::Holds, masked @ Finding::Masked(_)) => masked,
            (of_parameters, _) => of_parameters,
        }
    }

    fn parameters(&self, fields: &[Expected]) -> Finding {
        let mut masked = None;
        for field in fields {
            let name = field.index.as_deref().unwrap_or_default();
            let shown = self.run.parameters.as_ref().filter(|_| self.observables.final_parameters);
            let (Some(shown), Ok(number)) = (shown, name.parse::<u32>()) else {
                return Finding::Masked(format!("#{name} at the end"));
            };
            if self.observables.hidden_parameters.iter().any(|hidden| hidden.contains(&number)) {
                return Finding::Masked(format!("#{name} at the end"));
            }
            let found = shown.0.get(&number).copied().unwrap_or_default();
            let are_equal = |error| {
                let expected = field.value.parse();
                expected.is_ok_and(|e| tolerance::numbers(e, found, Quantity::Number, error))
            };
            match self.observables.resolution().compare(are_equal) {
                Match::Equal => {}
                Match::Hidden => masked = Some(Finding::Masked(hidden(&format!("#{name}")))),
                Match::Different => {
                    let found = rounded(&Value::Number(found));
                    return Finding::Fails(format!("#{number} = {found}"));
                }
            }
        }
        masked.unwrap_or(Finding::Holds)
    }

    fn at_effect(&self, name: &str, count: u32, fields: &[Expected]) -> Finding {
        if !self.observables.effects.contains(name) {
            return Finding::Masked(name.to_owned());
        }
        let mut named = self.run.effects.iter().filter(|observed| observed.effect.name() == name);
        let place = usize::try_from(count.saturating_sub(1)).unwrap_or(usize::MAX);
        match named.nth(place) {
            Some(observed) => self.fields(fields, &observed.settings.entries(), |field| {
                self.observables.fields_at_effects.contains(field)
            }),
            None => Finding::Fails(format!("no {name} number {count}")),
        }
    }

    fn fields(
        &self,
        fields: &[Expected],
        entries: &[Entry],
        shown: impl Fn(&str) -> bool,
    ) -> Finding {
        let mut masked = None;
        for field in fields {
            let index = field.index.as_deref();
            if !shown(&field.field) {
                masked = Some(Finding::Masked(field.field.clone()));
                continue;
            }
            match value_of(entries, &field.field, index).or_else(|| initial(&field.field)) {
                None => masked = Some(Finding::Masked(field.field.clone())),
                Some(found) => {
                    let expected = expected_value(field);
                    let resolution = self.observables.resolution_of(&field.field, entries);
                    let are_equal = |error| {
                        let expected = expected.as_ref();
                        expected.is_some_and(|e| tolerance::fields(&field.field, e, &found, error))
                    };
                    match resolution.compare(are_equal) {
                        Match::Equal => {}
                        Match::Hidden => masked = Some(Finding::Masked(hidden(&field.field))),
                        Match::Different => {
                            let index =
                                index.map_or_else(String::new, |index| format!("[{index}]"));
                            let found = rounded(&found);
                            return Finding::Fails(format!("{}{index} = {found}", field.field));
                        }
                    }
                }
            }
        }
        masked.unwrap_or(Finding::Holds)
    }

    fn effects(
        &self,
        expected: &[Effect],
        found: &[ObservedEffect],
        begin: Option<Position>,
        with_messages: bool,
    ) -> Finding {
        if let Some(hidden) = expected.iter().find(|e| !self.observables.effects.contains(e.name()))
        {
            return Finding::Masked(hidden.name().to_owned());
        }
        let counts = |effect: &Effect| {
            let is_message = matches!(effect, Effect::Message { .. });
            let is_end =
                matches!(effect, Effect::ProgramEnd {} | Effect::ChangeControllerMode { .. });
            self.observables.effects.contains(effect.name())
                && (with_messages || !(is_message || is_end))
        };
        let found: Vec<&ObservedEffect> =
            found.iter().filter(|observed| counts(&observed.effect)).collect();
        let all: Vec<&Effect> = expected.iter().collect();
        let starts = |expected: &[&Effect]| {
            expected.iter().zip(&found).all(|(a, b)| self.match_effect(a, b) != Match::Different)
        };
        let same = |expected: &[&Effect]| expected.len() == found.len() && starts(expected);
        let moving = || without_moves_in_place(expected, begin);
        if !self.observables.moves_in_place && !same(&all) && same(&moving()) {
            return Finding::Masked("moves in place".to_owned());
        }
        let same = same(&all);
        if !same && self.may_go_on(found.len() > all.len() && starts(&all)) {
            return Finding::Masked("effects of a refused block".to_owned());
        }
        let is_hidden =
            |(a, b): &(&Effect, &&ObservedEffect)| self.match_effect(a, b) == Match::Hidden;
        if same && let Some((effect, _)) = expected.iter().zip(&found).find(is_hidden) {
            return Finding::Masked(hidden(effect.name()));
        }
        ok(same, || effect_texts(&found))
    }

    /// Lists of effects that a block has in this order: the first list begins it, the last one ends it, and
    /// other effects may be between them.
    fn effects_with_gaps(&self, lists: &[Vec<Effect>], found: &[ObservedEffect]) -> Finding {
        let observes = |effect: &Effect| self.observables.effects.contains(effect.name());
        if let Some(hidden) = lists.iter().flatten().find(|effect| !observes(effect)) {
            return Finding::Masked(hidden.name().to_owned());
        }
        let found: Vec<_> = found.iter().filter(|observed| observes(&observed.effect)).collect();
        if fits(lists, &found, |a, b| self.match_effect(a, b) == Match::Equal) {
            return Finding::Holds;
        }
        if fits(lists, &found, |a, b| self.match_effect(a, b) != Match::Different) {
            return Finding::Masked(hidden("effects"));
        }
        Finding::Fails(effect_texts(&found))
    }

    /// Whether effects beyond the expected ones may be those of a refused block, because blocks are not reported.
    fn may_go_on(&self, goes_on: bool) -> bool {
        goes_on && !self.observables.blocks && matches!(self.run.end, End::Fault(_))
    }

    fn match_effect(&self, expected: &Effect, found: &ObservedEffect) -> Match {
        let resolution = self.observables.resolution_at(&found.settings);
        resolution.compare(|error| tolerance::effects(expected, &found.effect, error))
    }

    fn count(&self, name: &str, count: usize) -> Finding {
        if !self.observables.effects.contains(name) {
            return Finding::Masked(name.to_owned());
        }
        let found = self.run.effects.iter().filter(|o| o.effect.name() == name).count();
        if found < count && name.starts_with("straight_") && !self.observables.moves_in_place {
            return Finding::Masked("moves in place".to_owned());
        }
        if self.may_go_on(found > count) {
            return Finding::Masked("effects of a refused block".to_owned());
        }
        ok(found == count, || format!("{found} of {name}"))
    }

    fn messages(&self, texts: &[String]) -> Finding {
        if !self.observables.effects.contains("message") {
            return Finding::Masked("message".to_owned());
        }
        let found = self.run.messages();
        let starts = texts.iter().zip(&found).all(|(a, b)| tolerance::texts(a.trim(), b.trim()));
        if self.may_go_on(starts && found.len() > texts.len()) {
            return Finding::Masked("effects of a refused block".to_owned());
        }
        ok(starts && texts.len() == found.len(), || {
            if found.is_empty() {
                "no messages".to_owned()
            } else {
                format!("messages: {}", found.join(" | "))
            }
        })
    }

    /// The texts of one channel.
    fn said(&self, on: Channel) -> impl Iterator<Item = &str> {
        self.run.effects.iter().filter_map(move |observed| {
            let Effect::Message { channel, text } = &observed.effect else { return None };
            (*channel == on).then_some(text.as_str())
        })
    }

    fn output(&self, expected: &str) -> Finding {
        if !self.observables.effects.contains("message") {
            return Finding::Masked("message".to_owned());
        }
        let found: String = self.said(Channel::Output).collect();
        ok(found == expected, || format!("output: {found:?}"))
    }

    fn warnings(&self, expected: &[String]) -> Finding {
        if !self.observables.effects.contains("message") {
            return Finding::Masked("message".to_owned());
        }
        let found = self.said(Channel::Display).map(|text| text.trim_start_matches("warning: "));
        let found: Vec<&str> = found.collect();
        ok(found == expected, || format!("warnings: {}", found.join(" | ")))
    }

    fn pin(&self, pin: Pin, expected: &[f64]) -> Finding {
        if !self.observables.pins.contains(pin.name()) {
            return Finding::Masked(pin.name().to_owned());
        }
        let found = self.run.pins.get(&pin).into_iter().flatten().map(|at| at.value);
        let found: Vec<f64> = found.collect();
        let is_same = tolerance::sequences(expected, &found, Resolution::EXACT);
        if !is_same && pins::may_match_untimed(expected, &found, self.observables) {
            // Whether they last is known where the outcomes are compared.
            return Finding::Masked(hidden(pin.name()));
        }
        ok(is_same, || format!("pin {pin}: {}", pin_values(&found)))
    }
}

/// Whether lists are in a sequence one after the other, the first at its begin and the last at its end.
fn fits<Wanted, Found>(
    lists: &[Vec<Wanted>],
    found: &[Found],
    same: impl Fn(&Wanted, &Found) -> bool,
) -> bool {
    let [first, between @ .., last] = lists else { return lists.len() == found.len() };
    let is_at = |list: &[Wanted], place: usize| {
        let part = found.get(place..place + list.len());
        part.is_some_and(|part| list.iter().zip(part).all(|(wanted, found)| same(wanted, found)))
    };
    let Some(end) = found.len().checked_sub(last.len()) else { return false };
    let mut place = first.len();
    let are_inside = is_at(first, 0)
        && between.iter().all(|list| {
            let next = (place..=end).find(|begin| is_at(list, *begin));
            place = next.map_or(place, |begin| begin + list.len());
            next.is_some()
        });
    are_inside && place <= end && is_at(last, end)
}

/// Without straight moves that end where the one before ended.
fn without_moves_in_place(effects: &[Effect], begin: Option<Position>) -> Vec<&Effect> {
    let mut point = begin;
    let moves = |effect: &&Effect| {
        let in_place = is_in_place(effect, point.as_ref());
        point = end_of(effect).or(point);
        !in_place
    };
    effects.iter().filter(moves).collect()
}

/// What a field of a variable or of a modal call is before it is recorded for the first time.
fn initial(field: &str) -> Option<Value> {
    match field {
        "variable" => Some(Value::Text(String::new())),
        "set" => Some(Value::Word("off".to_owned())),
        "local" | "common" => Some(Value::Word("vacant".to_owned())),
        "modal_call" => Some(Value::Number(0.0)),
        _ => None,
    }
}

/// The parameters of an assertion that no block has set: their value is zero. Only parameters of programs count.
fn unset_parameters(fields: &[Expected], entries: &[Entry]) -> Vec<Entry> {
    let is_unset = |field: &&Expected| {
        let index = field.index.as_deref();
        field.field == "parameter"
            && index
                .and_then(|index| index.parse().ok())
                .is_some_and(|number| frame::PROGRAM_PARAMETERS.contains(&number))
            && value_of(entries, &field.field, index).is_none()
    };
    let unset = fields.iter().filter(is_unset);
    unset
        .map(|field| Entry {
            field: "parameter",
            index: field.index.clone(),
            value: Value::Number(0.0),
        })
        .collect()
}

/// The value that is written, read as the field's type.
fn expected_value(field: &Expected) -> Option<Value> {
    let index = field.index.as_deref();
    let mut settings = Settings::default();
    let entries = if settings.read(&field.field, index, &field.value).is_ok() {
        settings.entries()
    } else {
        let mut state = State::empty(field.language());
        state.read(&field.field, index, &field.value).ok()?;
        state.entries()
    };
    entries.into_iter().next().map(|entry| entry.value)
}

fn effect_texts(effects: &[&ObservedEffect]) -> String {
    let texts: Vec<_> = effects.iter().map(|observed| effect_text(&observed.effect)).collect();
    if texts.is_empty() { "no effects".to_owned() } else { texts.join("; ") }
}

fn effect_text(effect: &Effect) -> String {
    let mut text = effect.name().to_owned();
    for (name, value) in effect.arguments() {
        text.push_str(&format!(" {name}={}", rounded(&value)));
    }
    text
}
