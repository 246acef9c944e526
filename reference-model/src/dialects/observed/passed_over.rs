//! Reads a line that `rs274` skips while it searches for a label: some of its content is checked.

use gaugeblock_vocabulary::FaultKind;

use crate::ids::rule;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;
use crate::rs274::syntax::{Keyword, OWord, Parser};
use crate::rs274::text::condense;

/// The part of a skipped line that matters.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum PassedOver {
    /// No part.
    Nothing,
    /// A label and its keyword; what follows them is not read.
    OWord(OWord),
    /// A label without a keyword, and the refusal for a search in which such a label is an error.
    WithoutKeyword(StepError),
    /// M98.
    NumberedCall,
}

/// Reads a skipped line. No rule counts as covered.
///
/// # Errors
/// The line is too long, a comment is not closed, or a line number, label or keyword is invalid.
pub(super) fn passed_over(line: &str, state: &mut State) -> Result<PassedOver, StepError> {
    let before = state.coverage.set_muted(true);
    let mut room = std::mem::take(&mut state.room);
    let condensed = condense(line, &mut room.glyphs, state);
    state.coverage.set_muted(before);
    condensed?;
    read(&mut Parser::new(room, &state.choices))
}

/// The line number, a label with its keyword, and whether M98 begins the line.
fn read(parser: &mut Parser<'_>) -> Result<PassedOver, StepError> {
    parser.block_delete();
    parser.line_number()?;
    if parser.is_led_by_comment() {
        return Ok(PassedOver::Nothing);
    }
    parser.comments();
    if parser.take("m98") {
        let ends = !matches!(parser.peek(), Some('0'..='9' | '.'));
        return Ok(if ends { PassedOver::NumberedCall } else { PassedOver::Nothing });
    }
    if parser.peek() != Some('o') {
        return Ok(PassedOver::Nothing);
    }
    let start = parser.place();
    let label = parser.label()?;
    let word = parser.keyword(label.clone(), start);
    parser.comments();
    let word = match word {
        Ok(word) => word,
        Err(error) if parser.peek().is_some() => return Ok(PassedOver::WithoutKeyword(error)),
        // A name alone counts as a number alone does.
        Err(_) => OWord {
            label,
            keyword: Keyword::ProgramNumber,
            arguments: Vec::new(),
            span: parser.span_from(start),
        },
    };
    if word.keyword == Keyword::ProgramNumber && parser.peek().is_some() {
        let message = "the number of an O-word without a keyword";
        let error = parser.refuse(rule::control::UNRELATED_WORDS, FaultKind::BadBlock, message);
        return Ok(PassedOver::WithoutKeyword(error));
    }
    Ok(PassedOver::OWord(word))
}
