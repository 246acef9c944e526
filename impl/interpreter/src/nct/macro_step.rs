//! The state that a sink receives after each step of a program with custom macros.

use gaugeblock_vocabulary::{Motion, Position};

use super::run::StepReport;
use super::variables::{VariableChange, Variables};

/// A step that was made, and what it made of the state.
#[derive(Clone, Copy, Debug)]
pub struct MacroStep<'a> {
    pub(super) line: u32,
    pub(super) variables: &'a Variables,
    pub(super) report: &'a StepReport,
}

impl<'a> MacroStep<'a> {
    /// The line of its block, from 1.
    pub fn line(&self) -> u32 {
        self.line
    }

    /// The macro level: 0 in the main program.
    pub fn level(&self) -> u32 {
        u32::try_from(self.variables.level()).unwrap_or(u32::MAX)
    }

    /// The variables that the step has changed, each once. Those of a level that is over are vacant.
    pub fn variables(&self) -> impl Iterator<Item = VariableChange> + 'a {
        self.variables.changes()
    }

    /// The modal call that was commanded or cancelled: its depth from 0, and the number of its program; 0 where it
    /// was cancelled, or where no program can have the number.
    pub fn modal_call(&self) -> Option<(u32, u32)> {
        self.report.modal_call
    }

    /// The motion mode, where it is another one than after the step before, and after the first step.
    pub fn motion(&self) -> Option<Motion> {
        self.report.motion
    }

    /// The controlled point in program coordinates and the active length unit, where it is another one, and after the
    /// first step.
    pub fn position(&self) -> Option<Position> {
        self.report.position
    }
}
