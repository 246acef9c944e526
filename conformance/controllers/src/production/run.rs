//! A run: a program or blocks by hand, and then what the operator does with the idle controller.

use std::cell::Cell;

use gaugeblock_adapter::HarnessError;
use gaugeblock_interpreter::task::{Deadlock, IdleRequest, MDI_FILE, StepResult, Task};
use gaugeblock_interpreter::{Error, Interpreter, Limits, Memory, Scratch};
use gaugeblock_vocabulary::scenario::Start;
use gaugeblock_vocabulary::{
    BlockLocation, Bound, ControllerMode, End, Indexed, Outcome, Program, Scenario,
};

use super::environment::SimulatedEnvironment;
use super::recorder::Recorder;

thread_local! {
    /// What the run before has left for the next one.
    static SCRATCH: Cell<Scratch> = Cell::default();
}

/// A controller that runs a scenario.
struct Run<'a> {
    scenario: &'a Scenario,
    task: Task<Recorder<'a>>,
    /// How often M99 has ended the main program since the last operator event.
    turns: u32,
}

/// Runs a scenario.
///
/// # Errors
/// A machine or options that the interpreter does not take, or a source that cannot be read.
pub(super) fn run(scenario: &Scenario) -> Result<Outcome, HarnessError> {
    let (machine, options) = (scenario.machine.clone(), scenario.options.clone());
    let not_run = |error: Error| HarnessError::NotRun(error.to_string());
    let (limits, scratch) = (Limits::default(), SCRATCH.take());
    let mut interpreter =
        Box::new(Interpreter::with_scratch(machine, options, limits, scratch).map_err(not_run)?);
    interpreter.set_block_delete(scenario.program.block_delete);
    // Somebody may act at a line that holds a comment only.
    interpreter.set_report_comments(!scenario.operator.is_empty());
    let recorder = Recorder::new(&mut interpreter, SimulatedEnvironment::new(scenario), scenario);
    let task = Task::new(interpreter, recorder);
    let mut run = Run { scenario, task, turns: 0 };
    let end = match scenario.program.start {
        Start::Program => run.program()?,
        Start::Mdi => run.lines()?,
    };
    run.task.machine_mut().lines_are_over();
    let end = run.idle(end)?;
    let (mut interpreter, recorder) = run.task.into_parts();
    // With the run every call is over.
    interpreter.begin();
    let parameters = interpreter.parameters().into_iter().collect();
    SCRATCH.set(interpreter.into_scratch());
    let whole = recorder.is_whole();
    let mut outcome = recorder.outcome(end, parameters);
    if !whole && outcome.end == (End::BudgetExhausted { bound: Bound::Effects }) {
        outcome.parameters = before_last(scenario, &outcome)?;
    }
    Ok(outcome)
}

/// Parameters before a block that makes more effects than the budget allows. The interpreter has executed a part of
/// that block, which is not recorded, so the blocks before it are executed again.
fn before_last(
    scenario: &Scenario,
    outcome: &Outcome,
) -> Result<Option<Indexed<u32, f64>>, HarnessError> {
    let steps = u32::try_from(outcome.steps.len()).unwrap_or(u32::MAX);
    if steps >= scenario.budget.steps {
        return Err(HarnessError::NotRun(
            "a block exceeds a limit of the interpreter, whatever is executed before it".to_owned(),
        ));
    }
    let mut scenario = scenario.clone();
    scenario.budget.steps = steps;
    Ok(run(&scenario)?.parameters)
}

impl Run<'_> {
    /// The program from its first block, until something ends it.
    fn program(&mut self) -> Result<End, HarnessError> {
        self.task.start();
        let mut source = source(&self.scenario.program);
        loop {
            if let Some(bound) = exhausted(self.scenario, &self.task) {
                return Ok(End::BudgetExhausted { bound });
            }
            if self.task.machine().has_operator() {
                if let Some((file, line)) = self.task.next_block(&mut source) {
                    let block = BlockLocation::new(file, line);
                    self.task.machine_mut().begin_block(block);
                } else if !self.task.is_within_block() {
                    // The text ends here: what happens now belongs to the last block.
                    self.task.machine_mut().rest();
                }
            }
            let activity = self.task.step(&mut source);
            match self.end_of(activity)? {
                None => {}
                // M99 in the main program.
                Some(End::Endless) if self.begins_again() => {
                    self.task.machine_mut().go_on();
                    self.task.start_over();
                    source = self::source(&self.scenario.program);
                }
                Some(end) => return Ok(end),
            }
        }
    }

    /// Whether M99 repeats the main program: while operator events are left, and then up to [`End::TURNS`] turns.
    fn begins_again(&mut self) -> bool {
        if !self.task.machine().operator_is_waiting() {
            self.turns += 1;
        }
        self.turns < End::TURNS
    }

    /// Each line of the program, entered by hand.
    fn lines(&mut self) -> Result<End, HarnessError> {
        self.task.set_mode(ControllerMode::Mdi);
        // Where the last block ends no program the next one is waited for.
        let mut end = End::Paused;
        let program = &self.scenario.program;
        for (line, text) in (1..).zip(program.language.lines(&program.main)) {
            if let Some(bound) = exhausted(self.scenario, &self.task) {
                return Ok(End::BudgetExhausted { bound });
            }
            let deleted = program.block_delete && text.trim().starts_with('/');
            if text.trim().is_empty() || deleted {
                continue;
            }
            self.task.machine_mut().begin_block(BlockLocation::new(Program::MAIN, line));
            end = self.enter(text, line, End::Paused)?;
            let stuck = end == End::Paused && self.task.is_within_block();
            if is_final(&end) || stuck {
                break;
            }
        }
        Ok(end)
    }

    /// A block by hand, after a run that ended so.
    fn enter(&mut self, text: &str, number: u32, before: End) -> Result<End, HarnessError> {
        let (scenario, mut used_up) = (self.scenario, None);
        let mut source = source(&scenario.program);
        let activity = self.task.execute_mdi_while(text, number, &mut source, |task| {
            used_up = exhausted(scenario, task);
            used_up.is_none()
        });
        if let (Ok(StepResult::More), Some(bound)) = (&activity, used_up) {
            return Ok(End::BudgetExhausted { bound });
        }
        Ok(self.end_of(activity)?.unwrap_or(before))
    }

    /// What the operator does with an idle controller, after a run that ended so.
    fn idle(&mut self, mut end: End) -> Result<End, HarnessError> {
        while !is_final(&end) {
            end = match self.task.idle() {
                IdleRequest::None => break,
                IdleRequest::Start => self.program()?,
                IdleRequest::Mdi(text) => {
                    // What was refused has been entered too.
                    let number = self.task.machine().entered();
                    self.task.machine_mut().begin_block(BlockLocation::new(MDI_FILE, number));
                    self.enter(&text, number, end)?
                }
            };
        }
        Ok(end)
    }

    /// The end that an activity is, if it is one.
    fn end_of(&mut self, activity: Result<StepResult, Error>) -> Result<Option<End>, HarnessError> {
        if self.task.machine().is_over() {
            return Ok(Some(End::BudgetExhausted { bound: Bound::Effects }));
        }
        let end = match activity {
            Ok(StepResult::More) => return Ok(None),
            Ok(StepResult::MdiDone) => {
                self.task.machine_mut().rest();
                return Ok(None);
            }
            Ok(StepResult::Ended(end)) => {
                self.task.machine_mut().rest();
                end
            }
            Ok(StepResult::Deadlock(Deadlock::Paused)) => {
                if self.task.is_within_block() {
                    let block = self.task.interpreter().block();
                    self.task.machine_mut().stay(&block);
                } else {
                    self.task.machine_mut().stay_before();
                }
                End::Paused
            }
            Ok(StepResult::Deadlock(Deadlock::Waiting)) => {
                End::BudgetExhausted { bound: Bound::Time }
            }
            Err(Error::Fault(mut fault)) => {
                if let Some(block) = &mut fault.block {
                    *block = self.task.machine().block(&block.file, block.line);
                }
                End::Fault(*fault)
            }
            Err(Error::LimitExceeded { limit, block }) => {
                End::Unsupported { block, what: format!("so many {limit}") }
            }
            Err(error @ (Error::Source(_) | Error::Configuration(_))) => {
                return Err(HarnessError::NotRun(error.to_string()));
            }
        };
        Ok(Some(end))
    }
}

/// The bound of the budget that is used up. It is checked between blocks, so that a short run is a prefix of a longer
/// one; within a block only the number of effects is checked.
fn exhausted(scenario: &Scenario, task: &Task<Recorder<'_>>) -> Option<Bound> {
    let (budget, recorder) = (&scenario.budget, task.machine());
    if recorder.steps() >= budget.steps {
        Some(Bound::Steps)
    } else if recorder.effects() >= budget.effects {
        Some(Bound::Effects)
    } else if !task.is_within_block() && recorder.elapsed() >= budget.time {
        Some(Bound::Time)
    } else {
        None
    }
}

/// Whether nothing can follow such an end.
fn is_final(end: &End) -> bool {
    !matches!(end, End::ProgramEnd | End::PercentEnd | End::Aborted | End::Paused)
}

fn source(program: &Program) -> Memory<'_> {
    let main = Memory::new(&program.main);
    program.files.iter().fold(main, |source, (name, text)| source.with_file(name, text))
}
