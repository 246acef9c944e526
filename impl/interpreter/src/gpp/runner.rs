//! The state of a run.

use alloc::string::String;
use alloc::vec::Vec;

use super::choices::Choices;
use super::evaluate::{Evaluator, Stack};
use super::formats::Format;
use super::program::{IndexRange, Program, Statement};
use super::toolpath::{System, Value};
use super::variables::Variables;

/// An OUTPUT or PRINT.
#[derive(Clone, Debug, Default)]
pub(super) struct Printing {
    pub(super) line: u32,
    /// Its place in the program.
    pub(super) at: usize,
    /// Whether it waits for the end of the newline procedure.
    pub(super) waits: bool,
    pub(super) is_output: bool,
    /// Whether it has let the newline procedure run.
    pub(super) has_run: bool,
    /// The items that are left.
    pub(super) items: IndexRange,
    /// Slots that go off when it is done.
    pub(super) goes_off: Vec<usize>,
    /// The text of the item that let the newline procedure run.
    pub(super) carried: String,
}

/// A line of the toolpath, ready to be processed.
#[derive(Clone, Debug)]
pub(super) struct Line {
    pub(super) line: u32,
    /// System variables by place, and their values.
    pub(super) sets: Vec<(usize, Value)>,
    /// Where the statements of its block begin.
    pub(super) block: Option<usize>,
}

/// The next step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Next {
    /// A warning of compilation.
    Warning(usize),
    /// A line of the toolpath.
    Line(usize),
    /// A statement, and the line of the toolpath after its block.
    Statement {
        at: usize,
        line: usize,
    },
    /// The rest of an OUTPUT after the newline procedure.
    Rest {
        line: usize,
    },
    Over,
}

/// A compiled program and all that its run needs.
#[derive(Debug)]
pub(super) struct Runner {
    pub(super) program: Program,
    pub(super) variables: Variables,
    pub(super) formats: [Format; 19],
    pub(super) choices: Choices,
    pub(super) systems: Vec<System>,
    pub(super) lines: Vec<Line>,
    pub(super) next: Next,
    /// Whether a newline waits for something that is printed.
    pub(super) newline_waits: bool,
    pub(super) printing: Printing,
    /// The one within the newline procedure.
    pub(super) within: Printing,
    /// The text that the step prints.
    pub(super) text: String,
    /// Items that the step has printed or tried to.
    pub(super) printed: u64,
    pub(super) stack: Stack,
    /// Whether the newline procedure has no statement.
    pub(super) procedure_is_empty: bool,
    /// Whether a step has been executed.
    pub(super) has_reply: bool,
}

impl Runner {
    pub(super) fn new(
        program: Program,
        variables: Variables,
        formats: [Format; 19],
        choices: Choices,
        (systems, lines): (Vec<System>, Vec<Line>),
    ) -> Self {
        let first = program.newline.and_then(|at| program.statements.get(at));
        Self {
            procedure_is_empty: matches!(first, Some(Statement::End)),
            program,
            variables,
            formats,
            choices,
            systems,
            lines,
            next: Next::Warning(0),
            newline_waits: false,
            printing: Printing::default(),
            within: Printing::default(),
            text: String::new(),
            printed: 0,
            stack: Stack::new(),
            has_reply: false,
        }
    }

    /// Evaluates with the variables as they are now.
    pub(super) fn evaluator(&self) -> Evaluator<'_> {
        Evaluator {
            program: &self.program,
            variables: &self.variables,
            formats: &self.formats,
            absent_zero: self.choices.absent_zero,
            tie_even: self.choices.tie_even,
        }
    }
}
