//! The record of a run: steps, what changed at each, and the budget.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_vocabulary::scenario::Budget;
use gaugeblock_vocabulary::{
    BlockLocation, Bound, Channel, Effect, Event, GppState, Indexed, Program, State, Step, Switch,
};

use super::refusal::StepError;
use super::variables::Variables;
use crate::ids::choice::gpp::Tie;

/// The file that drives a program.
pub const TOOLPATH: &str = "toolpath";

/// What a run has done so far.
#[derive(Clone, Debug)]
pub struct Record {
    /// The steps that are complete.
    pub steps: Vec<Step>,
    budget: Budget,
    effects: u32,
    /// What the steps have cost: each one, and one for each variable that it sets and each item that it prints.
    cost: usize,
    /// What the step in progress has done.
    events: Vec<Event>,
    /// The cells that it has changed.
    touched: BTreeSet<usize>,
    /// Text and flag of each variable as they were last recorded; absent means no text, and off.
    shown: BTreeMap<String, (String, bool)>,
    /// Whether the modality of the variables has been recorded.
    modality_is_shown: bool,
}

impl Record {
    /// Nothing yet.
    pub fn new(budget: Budget) -> Self {
        Self {
            steps: Vec::new(),
            budget,
            effects: 0,
            cost: 0,
            events: Vec::new(),
            touched: BTreeSet::new(),
            shown: BTreeMap::new(),
            modality_is_shown: false,
        }
    }

    /// A step begins.
    ///
    /// # Errors
    /// Those before have used up the budget.
    pub fn begin(&self) -> Result<(), StepError> {
        let most = usize::try_from(self.budget.steps).unwrap_or(usize::MAX);
        if self.cost < most { Ok(()) } else { Err(StepError::Exhausted(Bound::Steps)) }
    }

    /// The step in progress costs more.
    pub fn spend(&mut self, cost: usize) {
        self.cost = self.cost.saturating_add(cost);
    }

    /// Something is said.
    pub fn say(&mut self, channel: Channel, text: impl Into<String>) {
        let text = text.into();
        self.events.push(Event::Do(Effect::Message { channel, text }));
    }

    /// A cell has got another value or flag.
    pub fn touch(&mut self, cell: usize) {
        self.touched.insert(cell);
    }

    /// A warning of the compiler, which stands before the run.
    ///
    /// # Errors
    /// The budget is used up.
    pub fn warn(&mut self, line: u32, text: &str) -> Result<(), StepError> {
        self.begin()?;
        self.say(Channel::Display, text);
        self.finish(BlockLocation::new(Program::MAIN, line), None)
    }

    /// The step in progress is complete; what has changed since the one before is its state.
    ///
    /// # Errors
    /// There are more effects than the budget allows.
    pub fn end(
        &mut self,
        block: BlockLocation,
        variables: &Variables,
        tie: Tie,
    ) -> Result<(), StepError> {
        let mut state = GppState::default();
        let (mut texts, mut flags) = (BTreeMap::new(), BTreeMap::new());
        for cell in std::mem::take(&mut self.touched) {
            let content = &variables.cells[cell];
            let sharing = variables.of_cell(cell);
            self.cost = self.cost.saturating_add(sharing.len());
            for variable in sharing {
                let text = content.value.as_ref().map(|value| variables.text(variable, value, tie));
                let text = text.and_then(Result::ok).unwrap_or_default();
                let name = variables.shown_name(variable, cell);
                let (shown_text, shown_flag) = self.shown.entry(name.clone()).or_default();
                if *shown_text != text {
                    texts.insert(name.clone(), text.clone());
                    *shown_text = text;
                }
                if *shown_flag != content.on {
                    flags.insert(name, if content.on { Switch::On } else { Switch::Off });
                    *shown_flag = content.on;
                }
            }
        }
        state.variable = (!texts.is_empty()).then_some(Indexed(texts.into()));
        state.set = (!flags.is_empty()).then_some(Indexed(flags.into()));
        if !self.modality_is_shown {
            self.modality_is_shown = true;
            let modality = variables.all.iter().map(|v| (v.name.clone(), v.modal));
            let modality: BTreeMap<_, _> = modality.collect();
            state.modal = (!modality.is_empty()).then_some(Indexed(modality.into()));
        }
        self.finish(block, Some(State::Gpp(state)))
    }

    fn finish(&mut self, block: BlockLocation, state: Option<State>) -> Result<(), StepError> {
        self.spend(1);
        let events = std::mem::take(&mut self.events);
        self.effects = self.effects.saturating_add(u32::try_from(events.len()).unwrap_or(u32::MAX));
        self.steps.push(Step { block, events, state });
        if self.effects <= self.budget.effects {
            return Ok(());
        }
        Err(StepError::Exhausted(Bound::Effects))
    }
}
