//! What a block may look like.
//!
//! A block is parsed when it is reached, not before: the errors of a block that is never reached do not count.

mod block;
mod expression;
mod items;
mod o_word;
mod parser;
mod room;
#[cfg(test)]
mod tests;
mod value;

pub use super::text::Comment;
pub use block::*;

use super::refusal::{Refusal, StepError};
use super::state::State;
use super::text::condense;
pub(crate) use items::SyntaxRules;
pub(crate) use parser::Parser;
pub use room::Room;

/// Parses a line.
///
/// # Errors
/// The line has not the form of a block.
pub fn parse(line: &str, state: &mut State) -> Result<Block, StepError> {
    let mut room = std::mem::take(&mut state.room);
    let comments = condense(line, &mut room.glyphs, state)?;
    let mut parser = Parser::new(room, &state.choices);
    let parsed = parser.block(comments);
    let (room, failed) = parser.into_rules();
    if parsed.is_ok() {
        room.reached.iter().for_each(|rule| state.coverage.accepted(*rule));
    } else {
        failed.into_iter().for_each(|rule| state.coverage.refused(rule));
    }
    state.room = room;
    parsed
}

/// So many characters are never too many for a line.
const SHORT: usize = 255;

/// The O-word of a line that begins with one, as far as it can be read.
///
/// Anything else is `None`; nothing is refused, and no rule is reached.
pub fn o_word_of(line: &str, state: &mut State) -> Option<OWord> {
    leading_o_word(line, true, state)
}

/// The same without its arguments, for finding labels.
pub fn mark_of(line: &str, state: &mut State) -> Option<OWord> {
    leading_o_word(line, false, state)
}

fn leading_o_word(line: &str, with_arguments: bool, state: &mut State) -> Option<OWord> {
    if !may_begin_with_o_word(line) {
        return None;
    }
    let before = state.coverage.set_muted(true);
    let mut room = std::mem::take(&mut state.room);
    let mut line = line;
    let mut condensed = condense(line, &mut room.glyphs, state);
    let mut broken = false;
    if let Err(StepError::Refused(Refusal { span: None, .. })) = &condensed {
        broken = true;
        // Of a line that is too long the beginning can be read.
        line = line.char_indices().nth(SHORT).map_or(line, |(end, _)| &line[..end]);
        condensed = condense(line, &mut room.glyphs, state);
    }
    if let Err(StepError::Refused(Refusal { span: Some(span), .. })) = &condensed {
        // The text before a comment that is not closed, or not opened, can be read.
        broken = true;
        condensed = condense(&line[..span.start as usize], &mut room.glyphs, state);
    }
    state.coverage.set_muted(before);
    condensed.ok()?;
    let mut parser = Parser::new(room, &state.choices);
    let word = parser.leading_o_word(with_arguments);
    (state.room, _) = parser.into_rules();
    word.filter(|word| !broken || word.keyword != Keyword::ProgramNumber)
}

/// Whether an O-word, or a comment that may precede one, follows what can be a slash and a line number.
fn may_begin_with_o_word(line: &str) -> bool {
    let before =
        |byte: &u8| matches!(byte, b' ' | b'\t' | b'\r' | b'/' | b'n' | b'N' | b'0'..=b'9' | b'.');
    matches!(line.bytes().find(|byte| !before(byte)), Some(b'o' | b'O' | b'('))
}
