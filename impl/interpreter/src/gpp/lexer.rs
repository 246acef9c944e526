//! Words, numbers, texts and signs of a program.

use gaugeblock_vocabulary::FaultKind;

/// Most characters of a text.
pub(super) const LONGEST_TEXT: usize = 256;
/// Most characters of a number.
pub(super) const LONGEST_NUMBER: usize = 40;

/// Signs of two characters, before those of one.
const LONG_SIGNS: &[&str] = &["==", "!=", "<=", ">=", "&&", "||"];
/// Signs of one character.
const SIGNS: &str = "()[];:=<>+-*/!#$%&@?^~";

/// A piece of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Token<'a> {
    /// Letters, digits and underscores; the first is a letter or underscore.
    Word(&'a str),
    /// The first is a digit or point; it may not be a valid number.
    Number(&'a str),
    /// The text between double quotes.
    Text(&'a str),
    Sign(&'a str),
    /// `\J`
    LineFeed,
    /// Anything else, and why it is refused.
    Bad(FaultKind),
    /// There is no more.
    End,
}

/// A token and its place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<'a> {
    pub(super) token: Token<'a>,
    pub(super) line: u32,
    /// Whether only blanks are before it in its line.
    pub(super) begins_line: bool,
}

/// The rest of a program.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lexer<'a> {
    rest: &'a str,
    line: u32,
    /// Whether nothing has been read of the line yet.
    line_begins: bool,
    /// Whether only blanks have been.
    only_blanks: bool,
}

impl<'a> Lexer<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { rest: text, line: 1, line_begins: true, only_blanks: true }
    }

    /// The next token.
    pub(super) fn take(&mut self) -> Placed<'a> {
        self.skip();
        let (line, begins_line) = (self.line, self.only_blanks);
        self.only_blanks = false;
        Placed { token: self.token(), line, begins_line }
    }

    /// Blanks, line ends and comments.
    fn skip(&mut self) {
        loop {
            let mut characters = self.rest.chars();
            match characters.next() {
                Some('*') if self.line_begins => self.skip_line(),
                Some('/') if characters.next() == Some('/') => self.skip_line(),
                Some(' ' | '\t') => self.advance(1),
                Some('\n') => self.end_line(1),
                Some('\r') if characters.next() == Some('\n') => self.end_line(2),
                _ => break,
            }
        }
        self.line_begins = false;
    }

    fn skip_line(&mut self) {
        let length = self.rest.find('\n').unwrap_or(self.rest.len());
        self.advance(length);
    }

    fn end_line(&mut self, length: usize) {
        self.advance(length);
        self.line = self.line.saturating_add(1);
        self.line_begins = true;
        self.only_blanks = true;
    }

    fn advance(&mut self, length: usize) {
        self.rest = self.rest.get(length..).unwrap_or_default();
        self.line_begins = false;
    }

    /// So many bytes of the rest.
    fn piece(&mut self, length: usize) -> &'a str {
        let piece = self.rest.get(..length).unwrap_or_default();
        self.advance(length);
        piece
    }

    fn token(&mut self) -> Token<'a> {
        let Some(first) = self.rest.chars().next() else { return Token::End };
        if first.is_ascii_alphabetic() || first == '_' {
            let length = self.rest.find(|c| !is_of_word(c)).unwrap_or(self.rest.len());
            return Token::Word(self.piece(length));
        }
        if first.is_ascii_digit() || first == '.' {
            let is_of_number = |c| is_of_word(c) || c == '.';
            let length = self.rest.find(|c| !is_of_number(c)).unwrap_or(self.rest.len());
            return Token::Number(self.piece(length));
        }
        if first == '"' {
            return self.text();
        }
        if first == '\\' {
            if self.rest.get(1..2).is_some_and(|letter| letter.eq_ignore_ascii_case("j")) {
                self.advance(2);
                return Token::LineFeed;
            }
        } else if let Some(sign) = LONG_SIGNS.iter().find(|sign| self.rest.starts_with(**sign)) {
            return Token::Sign(self.piece(sign.len()));
        } else if SIGNS.contains(first) {
            return Token::Sign(self.piece(1));
        }
        self.advance(first.len_utf8());
        Token::Bad(FaultKind::BadCharacter)
    }

    fn text(&mut self) -> Token<'a> {
        self.advance(1);
        let line = self.rest.find('\n').unwrap_or(self.rest.len());
        let Some(length) = self.rest.find('"').filter(|length| *length < line) else {
            return Token::Bad(FaultKind::BadCharacter);
        };
        let text = self.piece(length);
        self.advance(1);
        if text.chars().nth(LONGEST_TEXT).is_some() {
            return Token::Bad(FaultKind::TextTooLong);
        }
        Token::Text(text)
    }
}

/// Whether a word may have a character.
pub(super) fn is_of_word(character: char) -> bool {
    character.is_ascii_alphanumeric() || character == '_'
}

/// The value of a number without a sign.
pub(super) fn number(text: &str) -> Option<f64> {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, "0"));
    let digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    let is_one = digits(whole) && digits(fraction) && !fraction.is_empty();
    let is_one = is_one && !text.is_empty() && text.len() <= LONGEST_NUMBER;
    if is_one { text.parse().ok() } else { None }
}
