//! An outcome in the form that is compared: settings at each effect, settings and state after each block.
//!
//! An outcome records changes. Here they are folded, so that a setting that is repeated, or reordered between two
//! effects, makes no difference.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::{
    Axis, BlockLocation, Effect, End, Entry, Event, Indexed, LengthUnit, Outcome, Pin, PinChange,
    Position, Settings, State, Value,
};

use crate::accuracy::Resolution;
use crate::tolerance;

/// An effect and the settings in force at it.
#[derive(Clone, Debug)]
pub struct ObservedEffect {
    /// What was done.
    pub effect: Effect,
    /// The settings in force.
    pub settings: Settings,
    /// The block that did it, as a place among the steps.
    pub step: usize,
    /// Whether it is a straight move to where the controlled point is already.
    pub in_place: bool,
}

/// An executed block.
#[derive(Clone, Debug)]
pub struct ObservedStep {
    /// The block.
    pub block: BlockLocation,
    /// Its k-th execution, from 1.
    pub execution: u32,
    /// Its effects, as places among all effects.
    pub effects: std::ops::Range<usize>,
    /// The settings after it.
    pub settings: Settings,
    /// The state after it, where one is recorded, with all parameters that were seen to change so far.
    pub state: Option<State>,
}

/// A whole run as it is compared. Memory is linear in the executed blocks.
#[derive(Clone, Debug)]
pub struct Observed {
    /// Settings before the first block.
    pub start: Settings,
    /// Executed blocks in order.
    pub steps: Vec<ObservedStep>,
    /// Effects in order.
    pub effects: Vec<ObservedEffect>,
    /// How it ended.
    pub end: End,
    /// Numbered parameters that are not zero at the end, if the controller reports them.
    pub parameters: Option<Indexed<u32, f64>>,
    /// The values that each pin took over the whole run, in order, without the one that it had before; times are
    /// not compared.
    pub pins: BTreeMap<Pin, Vec<PinValue>>,
}

/// A value that a pin took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinValue {
    /// The value.
    pub value: f64,
    /// For how long, seconds; without end for the last one.
    pub lasts: f64,
}

impl Observed {
    /// Folds an outcome. What a refused block did before it was refused is left out: it is unspecified.
    pub fn of(outcome: &Outcome) -> Self {
        let mut settings = outcome.start.clone();
        let mut state = State::empty(outcome.language);
        let mut executions: BTreeMap<&BlockLocation, u32> = BTreeMap::new();
        let mut observed = Self {
            start: outcome.start.clone(),
            steps: Vec::new(),
            effects: Vec::new(),
            end: outcome.end.clone(),
            parameters: outcome.parameters.clone(),
            pins: pins(&outcome.pins),
        };
        let counted = match (&outcome.end, outcome.steps.last()) {
            (End::Fault(fault), Some(last))
                if fault.block.as_ref() == Some(&last.block) && last.state.is_none() =>
            {
                outcome.steps.len() - 1
            }
            _ => outcome.steps.len(),
        };
        let mut point = Some(Position::default());
        for (place, step) in outcome.steps[..counted].iter().enumerate() {
            let first = observed.effects.len();
            for event in &step.events {
                match event {
                    Event::Set(change) => {
                        if moves_coordinates(&settings, change) {
                            point = point.and_then(|point| after_change(point, &settings, change));
                        }
                        settings.overlay(change);
                    }
                    Event::Unknown(fields) => {
                        settings.forget(fields);
                        state.forget(fields);
                        if fields.iter().any(|field| field == "position") {
                            point = None;
                        }
                    }
                    Event::Do(effect) => {
                        let in_place = is_in_place(effect, point.as_ref());
                        point = end_of(effect).or(point);
                        observed.effects.push(ObservedEffect {
                            effect: effect.clone(),
                            settings: settings.clone(),
                            step: place,
                            in_place,
                        });
                    }
                }
            }
            if let Some(change) = &step.state {
                forget_local_names(&mut state, change);
                state.overlay(change);
                match &state {
                    State::Rs274(state) => point = state.position.or(point),
                    State::Nct(state) => point = state.position.or(point),
                    State::Gpp(_) => {}
                }
            }
            let execution = executions.entry(&step.block).or_default();
            *execution += 1;
            observed.steps.push(ObservedStep {
                block: step.block.clone(),
                execution: *execution,
                effects: first..observed.effects.len(),
                settings: settings.clone(),
                state: step.state.as_ref().map(|_| state.clone()),
            });
        }
        observed
    }

    /// Settings in force at the end.
    pub fn last_settings(&self) -> &Settings {
        self.steps.last().map_or(&self.start, |step| &step.settings)
    }

    /// The last state that was recorded.
    pub fn last_state(&self) -> Option<&State> {
        self.steps.iter().rev().find_map(|step| step.state.as_ref())
    }

    /// The texts of all messages in order.
    pub fn messages(&self) -> Vec<&str> {
        self.effects
            .iter()
            .filter_map(|observed| {
                let Effect::Message { text, .. } = &observed.effect else { return None };
                Some(text.as_str())
            })
            .collect()
    }
}

/// Whether a straight move ends where the controlled point is.
pub(crate) fn is_in_place(effect: &Effect, point: Option<&Position>) -> bool {
    let (Effect::StraightTraverse { end } | Effect::StraightFeed { end }) = effect else {
        return false;
    };
    point.is_some_and(|point| tolerance::positions(end, point, Resolution::EXACT))
}

/// Where an effect leaves the controlled point, if it moves it.
pub(crate) fn end_of(effect: &Effect) -> Option<Position> {
    let (Effect::StraightTraverse { end }
    | Effect::StraightFeed { end }
    | Effect::ArcFeed { end, .. }
    | Effect::RigidTap { end }) = effect
    else {
        return None;
    };
    Some(*end)
}

/// The program coordinates of the controlled point after a change of the unit, or of the tool offset, which is along the
/// axes of the program where the coordinate system is not turned; `None` after any other change.
fn after_change(mut point: Position, before: &Settings, change: &Settings) -> Option<Position> {
    let others = Settings { units: before.units, ..change.clone() };
    if !moves_coordinates(before, &others) {
        let (from, to) = (millimetres(before.units?), millimetres(change.units?));
        for axis in [Axis::X, Axis::Y, Axis::Z, Axis::U, Axis::V, Axis::W] {
            *point.get_mut(axis) *= from;
            *point.get_mut(axis) /= to;
        }
        return Some(point);
    }
    let others = Settings { tool_offset: before.tool_offset, ..change.clone() };
    if moves_coordinates(before, &others) || before.rotation != Some(0.0) {
        return None;
    }
    let (old, new) = (before.tool_offset?, change.tool_offset?);
    for axis in Axis::ALL {
        *point.get_mut(*axis) += old.get(*axis) - new.get(*axis);
    }
    Some(point)
}

/// Millimetres in a unit.
fn millimetres(unit: LengthUnit) -> f64 {
    match unit {
        LengthUnit::Millimetre => 1.0,
        LengthUnit::Inch => 25.4,
    }
}

/// Whether the controlled point has other program coordinates after this change: a setting that is repeated unchanged
/// moves nothing.
fn moves_coordinates(before: &Settings, change: &Settings) -> bool {
    fn differs<T: PartialEq>(before: Option<&T>, after: Option<&T>) -> bool {
        after.is_some() && before != after
    }
    differs(before.units.as_ref(), change.units.as_ref())
        || differs(before.g5x_offset.as_ref(), change.g5x_offset.as_ref())
        || differs(before.g92_offset.as_ref(), change.g92_offset.as_ref())
        || differs(before.rotation.as_ref(), change.rotation.as_ref())
        || differs(before.tool_offset.as_ref(), change.tool_offset.as_ref())
}

/// After a call or return, which a recorded call level marks, only those local named parameters exist that are recorded
/// again.
fn forget_local_names(state: &mut State, change: &State) {
    if let (State::Rs274(state), State::Rs274(change)) = (state, change)
        && change.call_level.is_some()
        && let Some(parameters) = &mut state.parameter
    {
        parameters.0.retain(|name, _| !is_local_name(name));
    }
}

/// Whether a recorded parameter is a local named one: not a number, and without an underscore before the name.
pub fn is_local_name(name: &str) -> bool {
    !name.starts_with('_') && name.parse::<u32>().is_err()
}

/// The values of each pin in order; a repeated value is not a change.
fn pins(changes: &[PinChange]) -> BTreeMap<Pin, Vec<PinValue>> {
    let mut pins: BTreeMap<Pin, Vec<PinValue>> = BTreeMap::new();
    let mut since: BTreeMap<Pin, f64> = BTreeMap::new();
    for PinChange { pin, value, time } in changes {
        let values = pins.entry(*pin).or_default();
        let last = values.last_mut();
        if last.as_ref().is_none_or(|last| !tolerance::identical(last.value, *value)) {
            let begun = since.insert(*pin, *time).unwrap_or(*time);
            if let Some(last) = last {
                last.lasts = time - begun;
            }
            values.push(PinValue { value: *value, lasts: f64::INFINITY });
        }
    }
    pins
}

/// The value of a field among entries.
pub fn value_of(entries: &[Entry], field: &str, index: Option<&str>) -> Option<Value> {
    entries
        .iter()
        .find(|entry| entry.field == field && entry.index.as_deref() == index)
        .map(|entry| entry.value.clone())
}

/// The steps after which a state is recorded, each with its place.
pub(crate) fn recorded(run: &Observed) -> Vec<(usize, &ObservedStep)> {
    run.steps.iter().enumerate().filter(|(_, step)| step.state.is_some()).collect()
}

#[cfg(test)]
mod tests {
    use gaugeblock_reference::run;
    use gaugeblock_vocabulary::Scenario;

    use super::*;

    /// What is known of a parameter after each state.
    fn shown(program: &str, parameter: &str) -> Vec<(u32, Option<Value>)> {
        let observed = Observed::of(&run(&Scenario::of(program)).0);
        let states = observed.steps.iter().filter_map(|step| {
            let entries = step.state.as_ref()?.entries();
            Some((step.block.line, value_of(&entries, "parameter", Some(parameter))))
        });
        states.collect()
    }

    #[test]
    fn local_name_is_observable_only_in_its_scope() {
        let program = "#<w> = 5\no1 sub\ng0\n#<w> = 9\no1 endsub\no1 call\no1 call\ng0\nm2\n";
        let number = |value| Some(Value::Number(value));
        assert_eq!(
            shown(program, "w"),
            [
                (1, number(5.0)),
                (3, None),
                (4, number(9.0)),
                (3, None),
                (4, number(9.0)),
                (8, number(5.0)),
                (9, number(5.0)),
            ]
        );
    }

    #[test]
    fn a_global_name_and_a_number_stay_in_sight() {
        let program = "#<_depth> = 5 #31 = 5\no1 sub\ng0\no1 endsub\no1 call\nm2\n";
        for parameter in ["_depth", "31"] {
            let five = Some(Value::Number(5.0));
            let expected = [(1, five.clone()), (3, five.clone()), (6, five)];
            assert_eq!(shown(program, parameter), expected, "{parameter}");
        }
    }
}
