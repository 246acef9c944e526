//! Runs custom macros: one step at a time, within the budget, recorded by a sink.

use gaugeblock_adapter::HarnessError;
use gaugeblock_interpreter::nct::{CustomMacros, MacroStep};
use gaugeblock_interpreter::{Reply, Sink};
use gaugeblock_vocabulary::{
    BlockLocation, Bound, Effect, End, Event, Language, MacroValue, NctState, Outcome, Program,
    Scenario, Settings, State, Step, Vacancy,
};

/// What has been seen so far.
#[derive(Debug, Default)]
struct Recorder {
    steps: Vec<Step>,
    /// What the step that is being made has done.
    events: Vec<Event>,
    effects: usize,
    /// Seconds of dwells.
    time: f64,
}

impl Sink for Recorder {
    fn set(&mut self, _line: u32, changed: &Settings) {
        self.events.push(Event::Set(changed.clone().into()));
    }

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        if let Effect::Dwell { seconds } = effect {
            self.time += seconds;
        }
        self.effects += 1;
        self.events.push(Event::Do(effect.clone()));
        Reply::Done
    }

    fn end_macro_step(&mut self, done: &MacroStep<'_>) {
        let events = std::mem::take(&mut self.events);
        let block = BlockLocation::new(Program::MAIN, done.line());
        self.steps.push(Step { block, events, state: Some(State::Nct(state(done))) });
    }
}

/// What a step has made of the state.
fn state(done: &MacroStep<'_>) -> NctState {
    let mut state = NctState {
        macro_level: Some(done.level()),
        motion: done.motion(),
        position: done.position(),
        ..NctState::default()
    };
    for change in done.variables() {
        let value = change.value.map_or(MacroValue::Vacant(Vacancy::Vacant), MacroValue::Number);
        match change.level {
            Some(level) => {
                let name = format!("{level}.{}", change.number);
                state.local.get_or_insert_default().0.insert(name, value);
            }
            None => {
                state.common.get_or_insert_default().0.insert(change.number, value);
            }
        }
    }
    if let Some((depth, program)) = done.modal_call() {
        state.modal_call.get_or_insert_default().0.insert(depth, program);
    }
    state
}

/// Runs a program with custom macros.
///
/// # Errors
/// Options that it does not take.
pub(super) fn run(scenario: &Scenario) -> Result<Outcome, HarnessError> {
    let (program, axes) = (&scenario.program, &scenario.machine.axes);
    let run = CustomMacros::new(&program.main, axes, program.block_delete, &scenario.options);
    let mut run = run.map_err(|error| HarnessError::NotRun(error.to_string()))?;
    let start = run.settings();
    let mut recorder = Recorder::default();
    let end = steps(scenario, &mut run, &mut recorder);
    Ok(Outcome {
        language: Language::Nct,
        start,
        steps: recorder.steps,
        end,
        parameters: None,
        pins: Vec::new(),
        samples: Vec::new(),
    })
}

fn steps(scenario: &Scenario, run: &mut CustomMacros, recorder: &mut Recorder) -> End {
    let budget = &scenario.budget;
    let most = usize::try_from(budget.steps).unwrap_or(usize::MAX);
    let effects = usize::try_from(budget.effects).unwrap_or(usize::MAX);
    loop {
        if recorder.steps.len() >= most && run.has_next() {
            return End::BudgetExhausted { bound: Bound::Steps };
        }
        let step = run.step(recorder);
        if recorder.effects > effects {
            return End::BudgetExhausted { bound: Bound::Effects };
        }
        if recorder.time > budget.time {
            return End::BudgetExhausted { bound: Bound::Time };
        }
        if let Err(end) = step {
            return *end;
        }
    }
}
