//! A block as it is read.

use super::expression::Expression;
use crate::nct::refusal::StepError;

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

/// `[a EQ b]` and its like.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    /// The left side.
    pub left: Expression,
    /// How the sides are compared.
    pub comparison: Comparison,
    /// The right side.
    pub right: Expression,
}

/// How two values are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// EQ.
    Equal,
    /// NE.
    NotEqual,
    /// GT.
    Greater,
    /// LT.
    Less,
    /// GE.
    GreaterOrEqual,
    /// LE.
    LessOrEqual,
}
