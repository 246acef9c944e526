//! Lines of a text: what is left of each without blanks and comments, and a place in it.

use alloc::vec::Vec;

use gaugeblock_vocabulary::FaultKind;

use super::program::{Stop, refuse};
use crate::syntax;

/// Most characters of a number.
const LONGEST: usize = 40;
/// Most digits of a program or sequence number.
const MOST_DIGITS: usize = 8;

/// The lines of a text. A carriage return belongs to the end of a line where a line feed or nothing follows.
pub(super) fn lines(text: &str) -> impl Iterator<Item = &str> {
    let ends = text.split_inclusive('\n');
    ends.map(|line| {
        let line = line.strip_suffix('\n').unwrap_or(line);
        line.strip_suffix('\r').unwrap_or(line)
    })
}

/// Puts what a line says into `bytes`: capitals, without blanks and comments.
///
/// # Errors
/// The first character that belongs nowhere, or comment that is none.
pub(super) fn clean(line: &str, bytes: &mut Vec<u8>) -> Result<(), Stop> {
    bytes.clear();
    if line.trim_start_matches([' ', '\t']).starts_with('%') {
        return Ok(());
    }
    let mut rest = line.bytes();
    while let Some(byte) = rest.next() {
        match byte {
            b' ' | b'\t' => {}
            b'(' => {
                if rest.find(|byte| matches!(byte, b'(' | b')')) != Some(b')') {
                    let why = "a comment that is not closed, or with another one in it";
                    return refuse(FaultKind::BadComment, why);
                }
            }
            b'+' | b'-' | b'*' | b'/' | b'.' | b'#' | b'[' | b']' | b'=' => bytes.push(byte),
            _ if byte.is_ascii_alphanumeric() => bytes.push(byte.to_ascii_uppercase()),
            _ => return refuse(FaultKind::BadCharacter, "a character that belongs nowhere"),
        }
    }
    Ok(())
}

/// A place in what a line says.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cursor<'a>(&'a [u8]);

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    pub(super) fn is_at_end(self) -> bool {
        self.0.is_empty()
    }

    /// The next byte; 0 at the end.
    pub(super) fn peek(self) -> u8 {
        self.0.first().copied().unwrap_or(0)
    }

    /// Takes this text if it comes next.
    pub(super) fn takes(&mut self, what: &[u8]) -> bool {
        let rest = self.0.strip_prefix(what);
        self.0 = rest.unwrap_or(self.0);
        rest.is_some()
    }

    /// Takes a letter if one comes next.
    pub(super) fn letter(&mut self) -> Option<u8> {
        let (letter, rest) = self.0.split_first().filter(|(byte, _)| byte.is_ascii_uppercase())?;
        self.0 = rest;
        Some(*letter)
    }

    /// Whether digits or a point come next.
    pub(super) fn begins_number(self) -> bool {
        matches!(self.peek(), b'0'..=b'9' | b'.')
    }

    /// Whether a variable comes next, or what only a variable takes.
    pub(super) fn begins_variable(self) -> bool {
        matches!(self.peek(), b'#' | b'[')
    }

    /// Adjacent digits and points.
    fn run(&mut self) -> &'a [u8] {
        let is_of_number = |byte: &u8| matches!(byte, b'0'..=b'9' | b'.');
        let length = self.0.iter().take_while(|byte| is_of_number(byte)).count();
        let (run, rest) = self.0.split_at_checked(length).unwrap_or((self.0, &[]));
        self.0 = rest;
        run
    }

    /// A number without a sign.
    pub(super) fn number(&mut self) -> Result<f64, Stop> {
        let run = self.run();
        let value = match syntax::read_short_prefix(run).filter(|short| short.length == run.len()) {
            Some(short) => Some(short.value()),
            None => long(run),
        };
        match value.filter(|_| run.len() <= LONGEST) {
            Some(value) => Ok(value),
            None => refuse(FaultKind::BadNumber, "a number that is none"),
        }
    }

    /// The m of a loop: 1 to 3, after any number of zeros.
    pub(super) fn number_of_loop(&mut self) -> Option<u32> {
        let run = self.run();
        let zeros = run.iter().take_while(|digit| **digit == b'0').count();
        match run.get(zeros..)? {
            b"1" => Some(1),
            b"2" => Some(2),
            b"3" => Some(3),
            _ => None,
        }
    }

    /// The number after an O or N: digits alone.
    pub(super) fn plain(&mut self) -> Result<u32, Stop> {
        if self.begins_variable() {
            return refuse(FaultKind::Statement, "O and N take no variable");
        }
        let run = self.run();
        let is_one = (1..=MOST_DIGITS).contains(&run.len()) && !run.contains(&b'.');
        match core::str::from_utf8(run).ok().filter(|_| is_one).and_then(|run| run.parse().ok()) {
            Some(number) => Ok(number),
            None => refuse(FaultKind::BadNumber, "O and N take a whole number of up to 8 digits"),
        }
    }
}

/// A number of many digits, or none.
fn long(run: &[u8]) -> Option<f64> {
    let points = run.iter().filter(|byte| **byte == b'.').count();
    let is_one = points <= 1 && run.len() > points;
    core::str::from_utf8(run).ok().filter(|_| is_one)?.parse().ok()
}
