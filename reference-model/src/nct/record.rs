//! The record of a run: steps, settings and state as they change, and the budget.

use gaugeblock_vocabulary::scenario::Budget;
use gaugeblock_vocabulary::{
    BlockLocation, Bound, Effect, Event, Indexed, MacroValue, Motion, NctState, Position, Settings,
    State, Step, Vacancy,
};

use super::frames::ModalCall;
use super::modes::Modes;
use super::refusal::StepError;
use super::variables::{COMMON_COUNT, Locals, VariableValue, Variables};

/// What a run has done so far.
#[derive(Clone, Debug)]
pub struct Record {
    /// The steps that are complete.
    pub steps: Vec<Step>,
    budget: Budget,
    effects: u32,
    /// Virtual time, seconds.
    time: f64,
    /// What the step in progress has done.
    events: Vec<Event>,
    /// What was last recorded.
    settings: Settings,
    levels: Vec<Locals>,
    common: [VariableValue; COMMON_COUNT],
    modal_calls: Vec<u32>,
    motion: Option<Motion>,
    position: Option<Position>,
}

impl Record {
    /// Nothing yet.
    pub fn new(budget: Budget, settings: Settings) -> Self {
        Self {
            steps: Vec::new(),
            budget,
            effects: 0,
            time: 0.0,
            events: Vec::new(),
            settings,
            levels: Vec::new(),
            common: [None; COMMON_COUNT],
            modal_calls: Vec::new(),
            motion: None,
            position: None,
        }
    }

    /// A step begins.
    ///
    /// # Errors
    /// The budget is used up.
    pub fn begin(&mut self) -> Result<(), StepError> {
        self.events.clear();
        let most = usize::try_from(self.budget.steps).unwrap_or(usize::MAX);
        if self.steps.len() < most { Ok(()) } else { Err(StepError::Exhausted(Bound::Steps)) }
    }

    /// Something is done, under the settings in force.
    pub fn effect(&mut self, modes: &Modes, effect: Effect) {
        if let Effect::Dwell { seconds } = effect {
            self.time += seconds;
        }
        self.set(modes);
        self.effects = self.effects.saturating_add(1);
        self.events.push(Event::Do(effect));
    }

    fn set(&mut self, modes: &Modes) {
        let now = modes.settings();
        let change = now.since(&self.settings);
        if !change.is_empty() {
            self.events.push(Event::Set(change.into()));
            self.settings = now;
        }
    }

    /// The step in progress is complete. The level stands in each; what else is the same as in the step before does
    /// not.
    ///
    /// # Errors
    /// There are more effects than the budget allows, or more time has gone by.
    pub fn end(
        &mut self,
        block: BlockLocation,
        modes: &Modes,
        variables: &Variables,
        modal_calls: &[ModalCall],
    ) -> Result<(), StepError> {
        self.set(modes);
        let state = NctState {
            macro_level: u32::try_from(variables.level()).ok(),
            local: self.local_changes(variables),
            common: self.common_changes(variables),
            modal_call: self.modal_changes(modal_calls),
            motion: (self.motion != Some(modes.motion)).then_some(modes.motion),
            position: (self.position != Some(modes.position)).then_some(modes.position),
        };
        (self.motion, self.position) = (Some(modes.motion), Some(modes.position));
        let state = State::Nct(state);
        let events = std::mem::take(&mut self.events);
        self.steps.push(Step { block, events, state: Some(state) });
        if self.effects > self.budget.effects {
            return Err(StepError::Exhausted(Bound::Effects));
        }
        if self.time > self.budget.time { Err(StepError::Exhausted(Bound::Time)) } else { Ok(()) }
    }

    fn local_changes(&mut self, variables: &Variables) -> Option<Indexed<String, MacroValue>> {
        let mut changes = Vec::new();
        let levels = self.levels.len().max(variables.levels.len());
        self.levels.resize(levels, [None; 33]);
        for (level, shown) in self.levels.iter_mut().enumerate() {
            let now = variables.levels.get(level).copied().unwrap_or([None; 33]);
            for (place, (shown, now)) in shown.iter_mut().zip(now).enumerate() {
                if !same(*shown, now) {
                    changes.push((format!("{level}.{}", place + 1), value(now)));
                    *shown = now;
                }
            }
        }
        (!changes.is_empty()).then(|| changes.into_iter().collect())
    }

    fn common_changes(&mut self, variables: &Variables) -> Option<Indexed<u32, MacroValue>> {
        let mut changes = Vec::new();
        for (place, (shown, now)) in self.common.iter_mut().zip(variables.common).enumerate() {
            if !same(*shown, now) {
                changes.push((Variables::common_number(place), value(now)));
                *shown = now;
            }
        }
        (!changes.is_empty()).then(|| changes.into_iter().collect())
    }

    /// A step begins or cancels one modal call at most.
    fn modal_changes(&mut self, modal_calls: &[ModalCall]) -> Option<Indexed<u32, u32>> {
        let depth = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
        if modal_calls.len() < self.modal_calls.len() {
            self.modal_calls.pop();
            return Some(Indexed::one(depth(self.modal_calls.len()), 0));
        }
        let call = modal_calls.get(self.modal_calls.len())?;
        let program = u32::try_from(call.program).unwrap_or_default();
        self.modal_calls.push(program);
        Some(Indexed::one(depth(self.modal_calls.len() - 1), program))
    }
}

fn same(one: VariableValue, other: VariableValue) -> bool {
    one.map(f64::to_bits) == other.map(f64::to_bits)
}

fn value(value: VariableValue) -> MacroValue {
    value.map_or(MacroValue::Vacant(Vacancy::Vacant), MacroValue::Number)
}
