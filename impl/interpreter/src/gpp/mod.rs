//! The post-processor GPP: a program with a toolpath, in GPP2 or the GPP before it.
//!
//! ```text
//! toolpath   formats and system variables, then blocks     toolpath, formats
//! program    text to words, texts and signs                lexer, words
//!   compile    declarations, statements, expressions       compile, declare, statements, structures, expressions
//!   program    statements in a row, that lead to places    program
//!   run        a step at a time: lines of the toolpath, and statements     run, print, calculate
//! Sink       what is printed and warned of, and a look at each step when it is done     done
//! ```
//!
//! Names are looked up while a program is compiled, and never while it runs. A variable keeps its text as it is
//! printed, so that printing copies it, and a number is rounded to it by integers, exactly.
//!
//! **Invariants.** A step is one line of the toolpath, or one statement, or the part of an OUTPUT up to the newline
//! procedure; its time is bounded by the text of its statement and by the variables that it sets, which it reports as
//! its cost. In steady state nothing is allocated except for a warning. Memory is bounded by the texts of program and
//! toolpath and by 25 000 variables.

mod choices;
mod compile;
mod declare;
mod evaluate;
mod expressions;
mod formats;
mod lexer;
mod print;
mod program;
mod run;
mod runner;
mod statement_end;
mod statements;
mod structures;
#[cfg(test)]
mod tests;
mod toolpath;
mod variables;
mod words;

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::fmt;

use gaugeblock_vocabulary::{BlockLocation, End, Fault, FaultKind, Options};

use crate::canon::Sink;
use crate::error::Error;
use choices::Choices;
use compile::Stop;
use runner::{Line, Runner};
use statement_end::File;
use toolpath::Toolpath;

pub use statement_end::{StatementEnd, TOOLPATH};
pub use variables::{Change, Name};

/// Why there is nothing to run.
#[derive(Clone, Debug, PartialEq)]
pub enum NotCompiled {
    /// The options are not usable.
    Configuration(Error),
    /// The program or its toolpath is refused, or the documents leave open what it means.
    Ended(Box<End>),
}

impl fmt::Display for NotCompiled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Configuration(error) => error.fmt(f),
            Self::Ended(end) => f.write_str(end.name()),
        }
    }
}

impl core::error::Error for NotCompiled {}

/// A program of a post-processor, compiled, and the place of its run.
///
/// ```
/// use gaugeblock_interpreter::gpp::{PostProcessor, StatementEnd};
/// use gaugeblock_interpreter::{Reply, Sink};
/// use gaugeblock_vocabulary::{Effect, Options, Settings};
///
/// #[derive(Default)]
/// struct Printer(String);
///
/// impl Sink for Printer {
///     fn set(&mut self, _line: u32, _changed: &Settings) {}
///     fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
///         if let Effect::Message { text, .. } = effect {
///             self.0.push_str(text);
///         }
///         Reply::Done
///     }
/// }
///
/// let program = "START:\nOUTPUT \"X\" X_CURPOS;\n";
/// let toolpath = "system X_CURPOS change COORDINATES\nblock START: X_CURPOS=1.5\n";
/// let mut run = PostProcessor::new(program, Some(toolpath), &Options::default())?;
/// let mut printer = Printer::default();
/// while run.has_next() {
///     run.step(&mut printer).map_err(|fault| fault.message)?;
/// }
/// assert_eq!(printer.0, "X1.5");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct PostProcessor(Runner);

impl PostProcessor {
    /// Compiles a program for a toolpath. Without one nothing is processed.
    ///
    /// # Errors
    /// An option that there is not; a toolpath or program that is refused, at the first line that is; what the
    /// documents leave open.
    pub fn new(
        program: &str,
        toolpath: Option<&str>,
        options: &Options,
    ) -> Result<Self, NotCompiled> {
        let choices = Choices::of(options).map_err(NotCompiled::Configuration)?;
        let Toolpath { formats, systems, blocks } = Toolpath::read(toolpath.unwrap_or_default())
            .map_err(|line| {
                let why = "a line of the toolpath is not what it must be";
                ended(fault(File::Toolpath, line, FaultKind::BadFile, why))
            })?;
        let compiled = compile::compile(program, &systems, &formats, choices)
            .map_err(|(line, stop)| ended(end_of(line, stop)))?;
        let lines = blocks.into_iter().map(|processed| Line {
            line: processed.line,
            block: compiled.blocks.get(&processed.heading).copied(),
            sets: processed.sets,
        });
        let lines: Vec<Line> = lines.collect();
        let compile::Compiled { program, variables, .. } = compiled;
        Ok(Self(Runner::new(program, variables, formats, choices, (systems, lines))))
    }

    /// Whether a step is left.
    pub fn has_next(&mut self) -> bool {
        self.0.advance()
    }

    /// Makes the next step and reports to the sink what it does: what is printed, on the channel of the output, and
    /// warnings, on the display. What the sink answers changes nothing. The answer is what the step costs: one, one
    /// for each item that it prints or tries to, and one for each variable that it sets; nothing where no step is
    /// left.
    ///
    /// # Errors
    /// The statement or line is refused. Reports to the sink of that step do not count, and the run is over.
    pub fn step<S: Sink>(&mut self, sink: &mut S) -> Result<u64, Box<Fault>> {
        self.0.step(sink).map_err(|(file, line, (kind, why))| {
            self.0.stop();
            Box::new(fault_of(file, line, kind, why))
        })
    }
}

fn ended(end: End) -> NotCompiled {
    NotCompiled::Ended(Box::new(end))
}

fn end_of(line: u32, stop: Stop) -> End {
    match stop {
        Stop::Refused(kind, why) | Stop::RefusedAt(_, kind, why) => {
            fault(File::Program, line, kind, why)
        }
        Stop::Open(why) => End::Unspecified {
            block: BlockLocation::new(File::Program.name(), line),
            why: why.into(),
        },
    }
}

fn fault(file: File, line: u32, kind: FaultKind, why: &str) -> End {
    End::Fault(fault_of(file, line, kind, why))
}

fn fault_of(file: File, line: u32, kind: FaultKind, why: &str) -> Fault {
    let block = Some(BlockLocation::new(file.name(), line));
    Fault { kind: Some(kind), block, span: None, message: why.into() }
}
