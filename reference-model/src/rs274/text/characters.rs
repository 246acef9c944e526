//! A line's characters as the parser sees them: without blanks, in lower case, comments split off.

use gaugeblock_vocabulary::FaultKind;

use super::comments::{Comment, comment_at, is_open};
use super::glyph::{Glyph, place};
use super::{Line, Source};
use crate::Choices;
use crate::ids::{choice, rule};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// The comments of a line; the characters that count are put down as `glyphs`.
///
/// Rule text.blanks. Spaces and tabs are allowed anywhere, within words and numbers too, and change nothing.
/// Rule text.case. A letter outside a comment means the same in upper and in lower case.
/// Rule text.comments-removed. Whether comments are taken out of the line, as blanks are, is a choice.
/// Rule text.comment-verbatim. Inside a comment blanks and case stay as they are written.
/// Rule text.comment-format-checked. Each of several comments on a line is checked, also those that are ignored.
///
/// # Errors
/// The line is too long, or a comment is not closed.
pub fn condense(
    line: &str,
    glyphs: &mut Vec<Glyph>,
    state: &mut State,
) -> Result<Vec<Comment>, StepError> {
    state.dialect().check_line_length(line, &state.choices)?;
    let bytes = line.as_bytes();
    glyphs.clear();
    glyphs.reserve(bytes.len());
    let mut comments: Vec<Comment> = Vec::new();
    let is_removed = state.choices.is(choice::text::CommentsRemoved::Removed);
    let mut removed = Vec::new();
    let (mut blanks, mut upper_case) = (false, false);
    let mut at = 0;
    while let Some(byte) = bytes.get(at) {
        let start = place(at);
        match byte {
            b' ' | b'\t' | b'\r' => blanks = true,
            b';' | b'(' | b')' => {
                let comment = checked_comment(line, at, !comments.is_empty(), state)?;
                let (start, end) = (comment.span.start, comment.span.end);
                if is_removed {
                    removed.push(glyphs.len());
                } else {
                    glyphs.push(Glyph { character: Glyph::COMMENT, start, end });
                }
                comments.push(comment);
                at = end as usize;
                continue;
            }
            0..=127 => {
                upper_case |= byte.is_ascii_uppercase();
                let character = char::from(byte.to_ascii_lowercase());
                glyphs.push(Glyph { character, start, end: start + 1 });
            }
            128.. => {
                let character = line[at..].chars().next().unwrap_or(char::REPLACEMENT_CHARACTER);
                at += character.len_utf8();
                glyphs.push(Glyph { character, start, end: place(at) });
                continue;
            }
        }
        at += 1;
    }
    if removed.iter().any(|place| divides_word(glyphs, *place)) {
        state.coverage.accepted(rule::text::COMMENTS_REMOVED);
    }
    if blanks {
        state.coverage.accepted(rule::text::BLANKS);
    }
    if upper_case {
        state.coverage.accepted(rule::text::CASE);
    }
    state.coverage.accepted(rule::text::LINE_LENGTH);
    if comments.len() > 1 {
        state.coverage.accepted(rule::text::COMMENT_FORMAT_CHECKED);
    }
    Ok(comments)
}

/// Whether a number goes on after a comment that was removed before the glyph at a place.
fn divides_word(glyphs: &[Glyph], place: usize) -> bool {
    let next = glyphs.get(place).map(|glyph| glyph.character);
    place > 0 && next.is_some_and(|next| matches!(next, '0'..='9' | '.' | '+' | '-'))
}

/// The comment that begins somewhere in a line; `another` where there is one before it. Most lines have none.
/// Rule text.comment-to-line-end. Whether one without its right parenthesis takes the rest of the line is a choice.
#[inline(never)]
fn checked_comment(
    line: &str,
    at: usize,
    another: bool,
    state: &mut State,
) -> Result<Comment, StepError> {
    let comment = comment_at(line, at, &state.choices).inspect_err(|_| {
        if another {
            state.coverage.refused(rule::text::COMMENT_FORMAT_CHECKED);
        }
        if is_open(line, at) {
            state.coverage.refused(rule::text::COMMENT_TO_LINE_END);
        }
    })?;
    if is_open(line, at) {
        state.coverage.accepted(rule::text::COMMENT_TO_LINE_END);
    }
    state.coverage.accepted(if comment.semicolon {
        rule::text::COMMENT_SEMICOLON
    } else {
        rule::text::COMMENT_PARENTHESES
    });
    state.coverage.accepted(rule::text::COMMENT_VERBATIM);
    Ok(comment)
}

/// How text is read, before its lines are parsed.
pub(crate) trait TextRules {
    /// Rule text.line-length. A line has at most 256 characters; a longer one is refused.
    /// Choice text.line-end-counted: whether the line end is one of them.
    fn check_line_length(&self, line: &str, choices: &Choices) -> Result<(), StepError> {
        let counted = choices.is(choice::text::LineEndCounted::Counted);
        let limit = if counted { 255 } else { 256 };
        // A line of so few bytes has no more characters.
        if line.len() <= limit { Ok(()) } else { within(limit, line.chars().count()) }
    }

    /// Rule text.line-end. A line ends with a carriage return, a line feed or both.
    fn with_line_feeds(&self, text: &str, _choices: &Choices) -> String {
        text.replace("\r\n", "\n").replace('\r', "\n")
    }

    /// What a percent line of a file is.
    ///
    /// Rule text.percent-file. In a file that begins with a percent line, the second one ends the program.
    /// Choice text.percent-alone: what one means in a file that does not.
    fn percent_line<'a>(&self, line: &'a str, source: &Source, state: &mut State) -> Line<'a> {
        if source.percent {
            state.coverage.accepted(rule::text::PERCENT_FILE);
            state.coverage.accepted(rule::text::PERCENT_LINE);
            return Line::End;
        }
        match state.choices.get::<choice::text::PercentAlone>() {
            choice::text::PercentAlone::Ends => Line::End,
            choice::text::PercentAlone::Ignored => Line::Nothing,
            choice::text::PercentAlone::Refused => Line::Block(line),
        }
    }

    /// Rule text.block-delete-on. A line that block delete skips is not read.
    fn pass_over_skipped(&self, _text: &str, _state: &mut State) -> Result<(), StepError> {
        Ok(())
    }

    /// Rule text.percent-file. A file that is called begins and ends by its own percent lines, whatever the main
    /// program has.
    fn begin_called_file(&self, _called: &mut Source, _main: &Source, _choices: &Choices) {}
}

/// Refuses a line of more characters than the limit.
pub(crate) fn within(limit: usize, length: usize) -> Result<(), StepError> {
    if length <= limit {
        return Ok(());
    }
    let message = format!("the line has {length} characters; {limit} are allowed");
    Err(refuse(rule::text::LINE_LENGTH, FaultKind::LineTooLong, message))
}
