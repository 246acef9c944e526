//! What a block may look like.

mod expression;
mod reader;
mod statement;

use super::refusal::StepError;
use super::text::Line;
use crate::Choices;

pub use expression::{Expression, Function, Operator};
pub use statement::{Comparison, Condition};

/// A block of a program.
#[derive(Clone, Debug)]
pub struct Block {
    /// Its line, from 1.
    pub line: u32,
    /// Whether it is skipped under block delete.
    pub is_optional: bool,
    /// The sequence number that opens it.
    pub sequence: Option<u32>,
    /// What it says, or why it is refused when it is reached.
    pub content: Result<Content, StepError>,
}

/// What a block says.
#[derive(Clone, Debug)]
pub enum Content {
    /// Words; none where a sequence number stands alone.
    Words(Vec<Word>),
    /// `#… = …`.
    Assign {
        /// The number of the variable.
        number: Expression,
        /// What it gets.
        value: Expression,
    },
    /// `GOTO n`.
    Goto(Expression),
    /// `IF [condition] GOTO n`.
    If(Condition, Expression),
    /// `WHILE [condition] DO m`.
    While(Condition, u32),
    /// `END m`.
    End(u32),
}

/// A word: a letter with what stands behind it.
#[derive(Clone, Debug)]
pub struct Word {
    /// The letter.
    pub letter: char,
    /// Its value.
    pub value: Expression,
}

/// The block of a line.
pub fn block(line: &Line, choices: &Choices) -> Block {
    let content = match &line.fault {
        Some(fault) => Err(fault.clone()),
        None => statement::content(&line.rest, choices),
    };
    Block { line: line.number, is_optional: line.is_optional, sequence: line.sequence, content }
}
