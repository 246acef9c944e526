//! Custom macros as on the NCT 99M and 2000M: macro calls and modal calls, macro levels, vacant variables,
//! expressions and jumps.
//!
//! ```text
//! text       lines without blanks and comments               text
//!   compile    blocks, numbers, loops                          compile, statements, expressions
//!   program    blocks, words and operations in rows            program
//!   run        a block at a time: which one comes next         run, calculate, variables
//!     calls      macros, modal calls, subprograms, returns       calls
//!     execute    modes, effects and motions of words             execute, modes, arcs
//! Sink       settings, effects, and a look at each step when it is done     done
//! ```
//!
//! The whole text is compiled before the first step: a jump goes to a place, and a word finds its variable without
//! looking at text. What is wrong with a block is kept with it, and refuses it when it is reached.
//!
//! **Invariants.** A step is one block, or the modal call after one; its time is bounded by the text of its line, and
//! that of a call by the number of variables. A sink hears of a block when nothing can refuse it any more. In steady
//! state nothing is allocated. Memory is bounded by the text, and by the modal calls that are in force, of which a
//! step commands one at most.

mod arcs;
mod calls;
mod choices;
mod codes;
mod compile;
mod evaluate;
mod execute;
mod expressions;
mod frames;
mod macro_step;
mod modes;
mod program;
mod run;
mod statements;
#[cfg(test)]
mod tests;
mod text;
mod variables;

use alloc::boxed::Box;
use alloc::format;

use gaugeblock_vocabulary::{Axis, BlockLocation, End, Fault, Options, Program, Settings};

use crate::canon::Sink;
use crate::error::Error;
use choices::Choices;
use program::Stop;
use run::{Flow, Runner};

pub use macro_step::MacroStep;
pub use variables::VariableChange;

/// A program with custom macros, compiled, and the place of its run.
///
/// ```
/// use gaugeblock_interpreter::nct::CustomMacros;
/// use gaugeblock_interpreter::{Reply, Sink};
/// use gaugeblock_vocabulary::{Axis, Effect, End, Options, Settings};
///
/// #[derive(Default)]
/// struct Ends(Vec<f64>);
///
/// impl Sink for Ends {
///     fn set(&mut self, _line: u32, _changed: &Settings) {}
///     fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
///         if let Effect::StraightFeed { end } = effect {
///             self.0.push(end.x);
///         }
///         Reply::Done
///     }
/// }
///
/// let text = "O1\nG66 P2 A10\nG1 X1 F100\nG67\nM30\nO2\nX#1\nM99\n";
/// let mut run = CustomMacros::new(text, &[Axis::X], false, &Options::default())?;
/// let mut ends = Ends::default();
/// let end = loop {
///     if let Err(end) = run.step(&mut ends) {
///         break end;
///     }
/// };
/// assert_eq!(*end, End::ProgramEnd);
/// assert_eq!(ends.0, [1.0, 10.0]);
/// # Ok::<(), gaugeblock_interpreter::Error>(())
/// ```
#[derive(Debug)]
pub struct CustomMacros {
    runner: Runner,
    over: Option<Box<End>>,
}

impl CustomMacros {
    /// Compiles a text of programs, of which the first one is to be run, on a machine with these axes. With
    /// `block_delete`, blocks that begin with a slash are skipped.
    ///
    /// # Errors
    /// [`Error::Configuration`] for an option that there is not.
    pub fn new(
        text: &str,
        axes: &[Axis],
        block_delete: bool,
        options: &Options,
    ) -> Result<Self, Error> {
        let choices = Choices::of(options)?;
        let code = compile::compile(text, block_delete, choices);
        Ok(Self { runner: Runner::new(code, choices, axes), over: None })
    }

    /// The settings in force.
    pub fn settings(&self) -> Settings {
        self.runner.modes.settings()
    }

    /// Whether the program in progress has a block left, or a call after one. Where it has none, or the run is over,
    /// the next step says how it ends.
    pub fn has_next(&mut self) -> bool {
        self.over.is_none() && self.runner.has_next()
    }

    /// Makes the next step and reports to the sink what it does. Replies of the sink change nothing.
    ///
    /// # Errors
    /// How the run has ended; later calls return the same. After [`End::ProgramEnd`] and [`End::Endless`] the sink
    /// has received the last step; a block that is refused, open or unsupported is not a step, and the sink has
    /// received nothing of it.
    pub fn step<S: Sink>(&mut self, sink: &mut S) -> Result<(), Box<End>> {
        if let Some(end) = &self.over {
            return Err(end.clone());
        }
        let before = self.runner.modes;
        let (line, flow) = self.runner.step();
        let end = match flow {
            Ok(flow) => {
                self.report_state(line, &before, sink);
                match flow {
                    Flow::On => return Ok(()),
                    Flow::ProgramEnd => End::ProgramEnd,
                    Flow::Endless => End::Endless,
                }
            }
            Err(stop) => end_of(line, stop),
        };
        Err(self.over.insert(Box::new(end)).clone())
    }

    /// Reports what a step has done.
    fn report_state<S: Sink>(&self, line: u32, before: &modes::Modes, sink: &mut S) {
        let Runner { modes, variables, report, effects, .. } = &self.runner;
        if modes != before {
            sink.set(line, &modes.settings().since(&before.settings()));
        }
        for effect in effects {
            sink.perform(line, effect);
        }
        sink.end_macro_step(&MacroStep { line, variables, report });
    }
}

fn end_of(line: u32, stop: Stop) -> End {
    let block = BlockLocation::new(Program::MAIN, line);
    match stop {
        Stop::Refused(kind, why) => End::Fault(Fault {
            kind: Some(kind),
            block: Some(block),
            span: None,
            message: why.into(),
        }),
        Stop::Open(why) => End::Unspecified { block, why: why.into() },
        Stop::Unsupported(letter, tenths) => {
            let letter = char::from(letter);
            let (code, tenth) = (tenths.wrapping_div(10), tenths.wrapping_rem(10));
            let what = match (letter, tenth) {
                ('G', 0) => format!("G{code}"),
                ('G', _) => format!("G{code}.{tenth}"),
                _ => format!("{letter}{tenths}"),
            };
            End::Unsupported { block, what }
        }
        Stop::SystemVariable(number) => {
            End::Unsupported { block, what: format!("the system variable #{number}") }
        }
    }
}
