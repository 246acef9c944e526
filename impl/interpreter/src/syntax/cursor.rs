//! A walk over the characters of a line. Blanks mean nothing outside of comments and are stepped over (11.4.2).

use gaugeblock_vocabulary::FaultKind;

use crate::syntax::{LineError, Parsed};

/// A place in a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cursor<'a> {
    line: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    /// Before the first character that is not a blank.
    pub(crate) fn new(line: &'a [u8]) -> Self {
        let mut cursor = Self { line, at: 0 };
        cursor.skip_blanks();
        cursor
    }

    /// Bytes before this place.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    /// The next character, in lower case; 0 at the end; a NUL in the text is not allowed either.
    #[inline]
    pub(crate) fn peek(&self) -> u8 {
        self.line.get(self.at).map_or(0, u8::to_ascii_lowercase)
    }

    /// The rest of the line, unchanged.
    #[inline]
    pub(crate) fn rest(&self) -> &'a [u8] {
        self.line.get(self.at..).unwrap_or(&[])
    }

    /// Moves on by so many bytes, and over the blanks after them.
    #[inline]
    pub(crate) fn advance(&mut self, bytes: usize) {
        self.at = self.at.wrapping_add(bytes);
        self.skip_blanks();
    }

    /// Moves on by so many bytes, which no blank follows.
    #[inline]
    pub(crate) fn advance_to_next(&mut self, bytes: usize) {
        self.at = self.at.wrapping_add(bytes);
    }

    /// Whether nothing is left.
    #[inline]
    pub(crate) fn is_at_end(&self) -> bool {
        self.at >= self.line.len()
    }

    /// Goes to the next character that is not a blank.
    #[inline]
    pub(crate) fn step(&mut self) {
        self.at = self.at.wrapping_add(1);
        self.skip_blanks();
    }

    #[inline]
    fn skip_blanks(&mut self) {
        while let Some(b' ' | b'\t') = self.line.get(self.at) {
            self.at = self.at.wrapping_add(1);
        }
    }

    /// Takes a character if it is the next one.
    #[inline]
    pub(crate) fn take(&mut self, byte: u8) -> bool {
        let taken = self.peek() == byte && !self.is_at_end();
        if taken {
            self.step();
        }
        taken
    }

    /// Takes letters if they come next, in lower case.
    pub(crate) fn take_word(&mut self, word: &[u8]) -> bool {
        let mut ahead = *self;
        for byte in word {
            if !ahead.take(*byte) {
                return false;
            }
        }
        *self = ahead;
        true
    }

    /// The raw text from the character after this one on, blanks included.
    pub(crate) fn raw_after(&self) -> &'a [u8] {
        self.line.get(self.at.wrapping_add(1)..).unwrap_or(&[])
    }

    /// Skips raw text, this character and `length` bytes after it.
    pub(crate) fn skip_raw(&mut self, length: usize) {
        self.at = self.at.wrapping_add(length);
        self.step();
    }

    /// Goes to the end of the line.
    pub(crate) fn finish(&mut self) {
        self.at = self.line.len();
    }

    /// Refuses the character here.
    #[cold]
    pub(crate) fn refuse<T>(&self, kind: FaultKind, message: &'static str) -> Parsed<T> {
        let start = u32::try_from(self.at).unwrap_or(u32::MAX);
        Err(LineError { kind, message, start, end: start.saturating_add(1) }.into())
    }

    /// Refuses the text between an earlier place and this one.
    #[cold]
    pub(crate) fn refuse_from<T>(
        &self,
        start: usize,
        kind: FaultKind,
        message: &'static str,
    ) -> Parsed<T> {
        let start = u32::try_from(start).unwrap_or(u32::MAX);
        let end = u32::try_from(self.at).unwrap_or(u32::MAX).max(start.saturating_add(1));
        Err(LineError { kind, message, start, end }.into())
    }
}
