//! Files, lines, characters: line ends, percent lines, block delete, blanks and case, comments split off.

mod characters;
mod comments;
mod glyph;
mod place;
#[cfg(test)]
mod tests;

pub(crate) use characters::TextRules;
pub use characters::condense;
#[cfg(feature = "dialects")]
pub(crate) use characters::within;
pub use comments::Comment;
pub use glyph::Glyph;
pub use place::Place;

use std::ops::Range;

use super::refusal::{StepError, refuse};
use super::state::State;
use crate::Choices;
use crate::dialects::SourceMemory;
use crate::ids::{choice, rule};
use gaugeblock_vocabulary::FaultKind;

/// A file of program text, cut into lines.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// File name; the main program is `main.ngc`.
    pub name: String,
    /// Its text; a line feed ends each line.
    text: String,
    /// The place of each line in the text, without its line end.
    lines: Vec<Range<usize>>,
    /// Index in `lines` of the first useful line: after the percent line if the file begins with one.
    pub first: usize,
    /// Whether the file begins with a percent line; then the next one ends it.
    pub percent: bool,
    /// What the dialect remembers of the file; nothing by the documents.
    pub(crate) memory: SourceMemory,
}

/// What a line of a file is, before it is parsed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line<'a> {
    /// Nothing to execute: it is blank.
    Nothing,
    /// A line that block delete skips.
    Skipped(&'a str),
    /// A percent line that ends the file.
    End,
    /// A block, perhaps one that will be refused.
    Block(&'a str),
}

impl Source {
    /// Cuts a file into lines.
    pub fn new(name: &str, text: &str, choices: &Choices) -> Self {
        let text = if text.contains('\r') {
            choices.dialect().with_line_feeds(text, choices)
        } else {
            text.to_owned()
        };
        let lines = lines(&text);
        let begins = lines.iter().position(|line| first(&text[line.clone()]).is_some());
        let percent = begins.filter(|index| is_percent(&text[lines[*index].clone()]));
        Self {
            name: name.to_owned(),
            first: percent.map_or(0, |index| index + 1),
            percent: percent.is_some(),
            memory: SourceMemory::default(),
            text,
            lines,
        }
    }

    /// The kind of the line at an index of `lines`; `None` after the last line.
    ///
    /// Rule text.blank-lines. Blank lines are allowed and ignored.
    /// Rule text.block-delete-on. While block delete is on, a line that begins with a slash is skipped unread.
    pub fn line(&self, index: usize, block_delete: bool, state: &mut State) -> Option<Line<'_>> {
        let line = &self.text[self.lines.get(index)?.clone()];
        state.coverage.accepted(rule::text::LINE_END);
        let Some(begins) = first(line) else {
            state.coverage.accepted(rule::text::BLANK_LINES);
            return Some(Line::Nothing);
        };
        if block_delete && begins == b'/' {
            state.coverage.accepted(rule::text::BLOCK_DELETE_ON);
            state.coverage.accepted(rule::text::BLOCK_DELETE_PLACE);
            return Some(Line::Skipped(line));
        }
        if begins == b'%' && is_percent(line) {
            return Some(state.dialect().percent_line(line, self, state));
        }
        Some(Line::Block(line))
    }

    /// Rule text.percent-unclosed. A file with a percent line at its beginning, and neither another one nor a program
    /// end, is refused. One without any percent line needs the program end as much: see `program-end`.
    pub fn unclosed(&self) -> StepError {
        refuse(
            rule::text::PERCENT_UNCLOSED,
            FaultKind::MissingEnd,
            "the file ends without M2, M30 or a closing %",
        )
    }

    /// Rule text.percent-optional. Percent lines are optional where the program has an M2 or M30.
    /// Choice text.percent-unclosed-ended: whether a file that begins with a percent line needs the second one all
    /// the same. Called at the program end.
    ///
    /// # Errors
    /// The second percent line is missed.
    pub fn program_ends(&self, state: &mut State) -> Result<(), StepError> {
        let useful = &self.lines[self.first..];
        let second = || useful.iter().any(|line| is_percent(&self.text[line.clone()]));
        if self.percent
            && state.choices.is(choice::text::PercentUnclosedEnded::Refused)
            && !second()
        {
            return Err(self.unclosed());
        }
        state.coverage.accepted(rule::text::PERCENT_OPTIONAL);
        Ok(())
    }
}

/// What counts as blank within a line. A carriage return is one only where it does not end the line.
pub(super) const BLANKS: [char; 3] = [' ', '\t', '\r'];

/// The first byte of a line that is not a blank.
fn first(line: &str) -> Option<u8> {
    line.bytes().find(|byte| !BLANKS.contains(&char::from(*byte)))
}

/// Rule text.percent-line. A percent line holds nothing else than the percent sign and blanks.
fn is_percent(line: &str) -> bool {
    line.trim_matches(BLANKS) == "%"
}

/// The place of each line of a text, without its line feed; a last one without a line feed is a line too.
fn lines(text: &str) -> Vec<Range<usize>> {
    let mut lines = Vec::with_capacity(text.len() / 8 + 1);
    let mut begin = 0;
    let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
    for (at, _) in ends {
        let line = &text[begin..at];
        lines.push(begin..begin + line.strip_suffix('\r').unwrap_or(line).len());
        begin = at + 1;
    }
    if begin < text.len() {
        lines.push(begin..text.len());
    }
    lines
}
