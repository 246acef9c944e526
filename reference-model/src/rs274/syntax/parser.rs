//! The parser's place in a line.

use gaugeblock_vocabulary::{FaultKind, Span};

use super::room::Room;
use crate::Choices;
use crate::ids::Rule;
use crate::rs274::refusal::{StepError, refuse_at};
use crate::rs274::text::Glyph;

/// A place in the characters of a line that count.
///
/// Recursion goes no deeper than the line is long, and lines are at most 256 characters long.
#[derive(Debug)]
pub(crate) struct Parser<'a> {
    pub(super) room: Room,
    /// Index of the next character.
    at: usize,
    pub(crate) choices: &'a Choices,
    /// Rules that refuse the line besides the one that the refusal names.
    failed: Vec<Rule>,
}

impl<'a> Parser<'a> {
    /// A parser of the characters in the room.
    pub(crate) fn new(mut room: Room, choices: &'a Choices) -> Self {
        room.reached.clear();
        Self { room, at: 0, choices, failed: Vec::new() }
    }

    /// A rule decided something.
    pub(super) fn reach(&mut self, rule: Rule) {
        self.room.reached.push(rule);
    }

    /// A rule refuses the line besides the one that the refusal names.
    pub(super) fn fail(&mut self, rule: Rule) {
        self.failed.push(rule);
    }

    /// The room, with the rules that decided something for a line that is accepted, and those for one that is refused.
    pub(super) fn into_rules(self) -> (Room, Vec<Rule>) {
        (self.room, self.failed)
    }

    /// The next character; it is not consumed.
    pub(crate) fn peek(&self) -> Option<char> {
        self.peek_after(0)
    }

    /// The character after the next `count` ones; it is not consumed.
    pub(crate) fn peek_after(&self, count: usize) -> Option<char> {
        self.room.glyphs.get(self.at + count).map(|glyph| glyph.character)
    }

    /// The character before the next one.
    pub(super) fn last(&self) -> Option<char> {
        Some(self.room.glyphs.get(self.at.checked_sub(1)?)?.character)
    }

    /// Whether the next characters are these.
    pub(crate) fn sees(&self, text: &str) -> bool {
        text.chars().enumerate().all(|(index, character)| self.peek_after(index) == Some(character))
    }

    /// Consumes these characters, if they are next.
    pub(crate) fn take(&mut self, text: &str) -> bool {
        let seen = self.sees(text);
        if seen {
            self.at += text.chars().count();
        }
        seen
    }

    /// Consumes the next character.
    pub(super) fn advance(&mut self) {
        self.at += 1;
    }

    /// Consumes and returns the characters up to the first that is not wanted.
    pub(super) fn take_while(&mut self, wanted: impl Fn(char) -> bool) -> String {
        let mut taken = String::new();
        self.take_into(&mut taken, wanted);
        taken
    }

    /// The same; they are added to a text.
    pub(super) fn take_into(&mut self, text: &mut String, wanted: impl Fn(char) -> bool) {
        while let Some(character) = self.peek().filter(|character| wanted(*character)) {
            text.push(character);
            self.advance();
        }
    }

    /// The place, for [`Self::span_from`] and for going back.
    pub(crate) fn place(&self) -> usize {
        self.at
    }

    /// Goes back to a place.
    pub(super) fn go_back(&mut self, place: usize) {
        self.at = place;
    }

    /// The part of the line from a place to here.
    pub(crate) fn span_from(&self, place: usize) -> Span {
        self.span(place, self.at.saturating_sub(1))
    }

    /// A refusal at the next character.
    pub(crate) fn refuse(
        &self,
        rule: impl Into<Rule>,
        kind: FaultKind,
        message: &str,
    ) -> StepError {
        let place = match self.peek() {
            None => "at the end of the line".to_owned(),
            Some(Glyph::COMMENT) => "before a comment".to_owned(),
            Some(character) => format!("at {character:?}"),
        };
        refuse_at(rule, kind, self.span(self.at, self.at), format!("{message} {place}"))
    }

    /// The part of the line from one character to another; the end of the line where there are none.
    fn span(&self, first: usize, last: usize) -> Span {
        let end = self.room.glyphs.last().map_or(0, |glyph| glyph.end);
        let start = self.room.glyphs.get(first).map_or(end, |glyph| glyph.start);
        Span { start, end: self.room.glyphs.get(last.max(first)).map_or(end, |glyph| glyph.end) }
    }
}
