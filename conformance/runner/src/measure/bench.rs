//! Runs a program on a controller and reports whether it is accepted.

use gaugeblock_adapter::Adapter;
use gaugeblock_vocabulary::{End, Options, Outcome, Scenario};

/// The answer of a controller to a program.
pub(super) enum Answer {
    Accepted(Box<Outcome>),
    Refused,
}

/// Runs programs and counts them.
pub(super) struct Bench<'a> {
    controller: &'a dyn Adapter,
    options: &'a Options,
    pub(super) runs: u32,
    pub(super) program: String,
}

impl<'a> Bench<'a> {
    pub(super) fn new(controller: &'a dyn Adapter, options: &'a Options) -> Self {
        Self { controller, options, runs: 0, program: String::new() }
    }

    pub(super) fn scenario(&self, program: &str) -> Scenario {
        Scenario { options: self.options.clone(), ..Scenario::of(program) }
    }

    /// Runs a program to its end.
    ///
    /// # Errors
    /// The controller lacks what the program needs, or fails. The text names the reason.
    pub(super) fn answer(&mut self, program: &str) -> Result<Answer, String> {
        let scenario = self.scenario(program);
        self.controller.supports(&scenario)?;
        self.runs += 1;
        program.clone_into(&mut self.program);
        let outcome = self.controller.run(&scenario).map_err(|error| error.to_string())?;
        match &outcome.end {
            End::ProgramEnd | End::PercentEnd | End::StreamEnd => {
                Ok(Answer::Accepted(Box::new(outcome)))
            }
            End::Fault(_) => Ok(Answer::Refused),
            End::Unsupported { what, .. } => Err(what.clone()),
            End::Unspecified { why, .. } => Err(format!("the documents leave it open: {why}")),
            End::BudgetExhausted { .. } => {
                Err("the program takes longer than its budget".to_owned())
            }
            End::Endless | End::Paused | End::Aborted => Err("the program does not end".to_owned()),
        }
    }

    pub(super) fn accepts(&mut self, program: &str) -> Result<bool, String> {
        Ok(matches!(self.answer(program)?, Answer::Accepted(_)))
    }
}
