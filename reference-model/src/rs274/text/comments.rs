//! Comments in parentheses and after a semicolon.

use gaugeblock_vocabulary::{FaultKind, Span};

use super::glyph::span;
use crate::Choices;
use crate::ids::{choice, rule};
use crate::rs274::refusal::{StepError, refuse_at};

/// A comment: the text in parentheses or after a semicolon, verbatim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comment {
    /// Its text without the marks.
    pub text: String,
    /// Whether a semicolon began it.
    pub semicolon: bool,
    /// Its place in the line.
    pub span: Span,
}

/// Whether a comment that a left parenthesis begins at a byte of the line has no right one.
pub(super) fn is_open(line: &str, at: usize) -> bool {
    line[at..].starts_with('(') && !line[at..].contains(')')
}

/// The comment that begins at a byte of the line, which is a semicolon or a parenthesis.
///
/// Rule text.comment-semicolon. A semicolon begins a comment that takes the rest of the line, but not inside
/// parentheses.
/// Rule text.comment-unclosed. A comment whose right parenthesis is missing, and a right parenthesis without a comment,
/// are refused.
/// Choice text.comment-nested: whether a comment may contain a left parenthesis.
/// Choice text.comment-to-line-end: whether a comment without its right parenthesis takes the rest of the line. Then
/// everything up to a right parenthesis is its text, a left one too.
///
/// # Errors
/// It is not closed, or closed without having begun.
pub(super) fn comment_at(line: &str, at: usize, choices: &Choices) -> Result<Comment, StepError> {
    let rest = &line[at..];
    let wrong = |end: usize, message: &str| {
        Err(refuse_at(rule::text::COMMENT_UNCLOSED, FaultKind::BadComment, span(at, end), message))
    };
    if let Some(text) = rest.strip_prefix(';') {
        let span = span(at, line.len());
        return Ok(Comment { text: text.to_owned(), semicolon: true, span });
    }
    let Some(text) = rest.strip_prefix('(') else {
        return wrong(at + 1, "a right parenthesis without a comment");
    };
    let to_line_end = choices.is(choice::text::CommentToLineEnd::ToLineEnd);
    let Some((text, _)) = text.split_once(')') else {
        if to_line_end {
            let span = span(at, line.len());
            return Ok(Comment { text: text.to_owned(), semicolon: false, span });
        }
        return wrong(line.len(), "the comment is not closed");
    };
    let end = at + 1 + text.len() + 1;
    let is_refused = !to_line_end && choices.is(choice::text::CommentNested::Refused);
    if is_refused && text.contains('(') {
        return wrong(end, "a left parenthesis within a comment");
    }
    Ok(Comment { text: text.to_owned(), semicolon: false, span: span(at, end) })
}
