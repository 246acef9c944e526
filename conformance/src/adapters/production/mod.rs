//! The production interpreter as a controller: it runs in this process, and a sink writes down what it does.
//!
//! Everything that it does is shown exactly (`recorder`). What the outside of a controller answers comes from the scenario's bench
//! (`outside`). The task around an interpreter (a person, manual data input, pins, a feed that is held) is not there yet (`supports`).
//! It honours every choice of the documents and no quirk: those are what other controllers do otherwise.

mod outside;
mod recorder;
mod supports;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

use gaugeblock_impl::{Error, Interpreter, Limits, Memory, Progress};
use gaugeblock_trace::{Bound, End, Options, Outcome, Program, Scenario};

use super::{Adapter, Capabilities, HarnessError};
use outside::Outside;
use recorder::{Halt, Recorder};

/// The production interpreter.
#[derive(Debug)]
pub struct Production {
    capabilities: Capabilities,
}

impl Default for Production {
    fn default() -> Self {
        let everything = Capabilities::everything("production", env!("CARGO_PKG_VERSION"));
        Self { capabilities: Capabilities { pins: BTreeSet::new(), ..everything } }
    }
}

impl Adapter for Production {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn honours(&self, options: &Options) -> Result<(), String> {
        supports::options(options)
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        supports::supports(scenario)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        // It promises not to panic, and is not trusted to keep that.
        catch_unwind(AssertUnwindSafe(|| run(scenario))).unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
            let stderr = text.unwrap_or_default().to_owned();
            Err(HarnessError::Crashed { status: "a panic".to_owned(), stderr })
        })
    }
}

fn run(scenario: &Scenario) -> Result<Outcome, HarnessError> {
    let (machine, options) = (scenario.machine.clone(), scenario.options.clone());
    let mut interpreter = Interpreter::new(machine, options, Limits::default())
        .map_err(|error| HarnessError::NotRun(error.to_string()))?;
    interpreter.set_block_delete(scenario.program.block_delete);
    let mut recorder = Recorder::new(&mut interpreter, Outside::new(scenario));
    let end = end(scenario, &mut interpreter, &mut recorder)?;
    // With the run every call is over.
    interpreter.begin();
    let parameters = interpreter.parameters().into_iter().collect();
    Ok(recorder.outcome(end, parameters))
}

/// Block after block, until something ends the run.
fn end(
    scenario: &Scenario,
    interpreter: &mut Interpreter,
    recorder: &mut Recorder<'_>,
) -> Result<End, HarnessError> {
    let mut source = source(&scenario.program);
    loop {
        if let Some(bound) = exhausted(scenario, recorder) {
            return Ok(End::BudgetExhausted { bound });
        }
        let progress = interpreter.step(&mut source, recorder);
        match recorder.halt() {
            Some(Halt::Pauses) => return Ok(End::Paused),
            Some(Halt::WaitsForEver) => return Ok(End::BudgetExhausted { bound: Bound::Time }),
            None => {}
        }
        match progress {
            Ok(Progress::More | Progress::Stopped) => {}
            Ok(Progress::Ended(end)) => return Ok(end),
            Err(Error::Fault(fault)) => return Ok(End::Fault(*fault)),
            Err(Error::Beyond { limit, block }) => {
                return Ok(End::Unsupported { block, what: format!("so many {limit}") });
            }
            Err(error @ (Error::NotYet(_) | Error::Unreadable(_) | Error::Configuration(_))) => {
                return Err(HarnessError::NotRun(error.to_string()));
            }
        }
    }
}

fn source(program: &Program) -> Memory<'_> {
    let main = Memory::new(&program.main);
    program.files.iter().fold(main, |source, (name, text)| source.with_file(name, text))
}

/// The bound of the budget that is used up. It is looked at between blocks, so that a short run is a prefix of a longer one.
fn exhausted(scenario: &Scenario, recorder: &Recorder<'_>) -> Option<Bound> {
    let budget = &scenario.budget;
    if recorder.steps() >= budget.steps {
        Some(Bound::Steps)
    } else if recorder.effects() >= budget.effects {
        Some(Bound::Effects)
    } else if recorder.time() >= budget.time {
        Some(Bound::Time)
    } else {
        None
    }
}
