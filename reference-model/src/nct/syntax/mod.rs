//! What a block may look like.

mod block;
mod expression;
mod reader;
mod statement;

use super::text::Line;
use crate::Choices;

pub use block::{Block, Comparison, Condition, Content, Word};
pub use expression::{Expression, Function, Operator};

/// The block of a line.
pub fn block(line: &Line, choices: &Choices) -> Block {
    let content = match &line.fault {
        Some(fault) => Err(fault.clone()),
        None => statement::content(&line.rest, choices),
    };
    Block { line: line.number, is_optional: line.is_optional, sequence: line.sequence, content }
}
