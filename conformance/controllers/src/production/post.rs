//! Runs a post-processor program: one step at a time, within the budget, recorded by a sink.

use gaugeblock_adapter::HarnessError;
use gaugeblock_interpreter::gpp::{NotCompiled, PostProcessor, StatementEnd, TOOLPATH};
use gaugeblock_interpreter::{Reply, Sink};
use gaugeblock_vocabulary::{
    BlockLocation, Bound, Effect, End, Event, GppState, Language, Outcome, Scenario, Settings,
    State, Step, Switch,
};

/// What has been seen so far.
#[derive(Debug, Default)]
struct Recorder {
    steps: Vec<Step>,
    /// What the step that is being made has done.
    events: Vec<Event>,
    effects: usize,
}

impl Sink for Recorder {
    fn set(&mut self, _line: u32, _changed: &Settings) {}

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        self.events.push(Event::Do(effect.clone()));
        Reply::Done
    }

    fn end_statement(&mut self, done: &StatementEnd<'_>) {
        let events = std::mem::take(&mut self.events);
        self.effects += events.len();
        let block = BlockLocation::new(done.file(), done.line());
        let state = done.was_executed().then(|| State::Gpp(state(done)));
        self.steps.push(Step { block, events, state });
    }
}

/// What a step has made of the variables.
fn state(done: &StatementEnd<'_>) -> GppState {
    let mut state = GppState::default();
    for change in done.changes() {
        let name = change.name.to_string();
        if let Some(text) = change.text {
            let texts = state.variable.get_or_insert_default();
            texts.0.insert(name.clone(), text.to_owned());
        }
        if let Some(on) = change.on {
            let flag = if on { Switch::On } else { Switch::Off };
            state.set.get_or_insert_default().0.insert(name, flag);
        }
    }
    for (name, modal) in done.modalities() {
        state.modal.get_or_insert_default().0.insert(name.to_owned(), modal);
    }
    state
}

/// Runs a post-processor's program.
///
/// # Errors
/// Options that it does not take.
pub(super) fn run(scenario: &Scenario) -> Result<Outcome, HarnessError> {
    let program = &scenario.program;
    let toolpath = program.files.get(TOOLPATH).map(String::as_str);
    let mut recorder = Recorder::default();
    let end = match PostProcessor::new(&program.main, toolpath, &scenario.options) {
        Ok(mut post) => steps(scenario, &mut post, &mut recorder),
        Err(NotCompiled::Ended(end)) => *end,
        Err(NotCompiled::Configuration(error)) => {
            return Err(HarnessError::NotRun(error.to_string()));
        }
    };
    Ok(Outcome {
        language: Language::Gpp,
        start: Settings::default(),
        steps: recorder.steps,
        end,
        parameters: None,
        pins: Vec::new(),
        samples: Vec::new(),
    })
}

fn steps(scenario: &Scenario, post: &mut PostProcessor, recorder: &mut Recorder) -> End {
    let (most, effects) = (u64::from(scenario.budget.steps), scenario.budget.effects);
    let effects = usize::try_from(effects).unwrap_or(usize::MAX);
    let mut cost = 0_u64;
    while post.has_next() {
        if cost >= most {
            return End::BudgetExhausted { bound: Bound::Steps };
        }
        match post.step(recorder) {
            Ok(more) => cost = cost.saturating_add(more),
            Err(fault) => return End::Fault(*fault),
        }
        if recorder.effects > effects {
            return End::BudgetExhausted { bound: Bound::Effects };
        }
    }
    End::ProgramEnd
}
