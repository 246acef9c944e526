//! Lines: blanks and comments left out, block delete, program and sequence numbers split off.

use gaugeblock_vocabulary::FaultKind;

use super::refusal::{StepError, refuse, refuse_form};
use crate::ids::rule;

/// Most digits of a program or sequence number.
const MOST_DIGITS: usize = 8;

/// A line that is a block, or begins a program.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its number, from 1.
    pub number: u32,
    /// Whether a slash comes first, behind blanks and comments.
    pub is_optional: bool,
    /// The program that begins here.
    pub program: Option<u32>,
    /// The sequence number that opens the block.
    pub sequence: Option<u32>,
    /// What follows, in capitals, without blanks and comments.
    pub rest: String,
    /// Why it is refused when it is reached.
    pub fault: Option<StepError>,
}

/// The lines of a program text that are not empty.
pub fn lines(text: &str) -> Vec<Line> {
    let numbered = (1_u32..).zip(text.split('\n'));
    numbered.filter_map(|(number, text)| line(number, text)).collect()
}

/// A line that begins with a percent sign is none.
///
/// Rule nct.block-delete. The slash counts whatever is wrong behind it.
fn line(number: u32, text: &str) -> Option<Line> {
    if text.trim_start_matches([' ', '\t']).starts_with('%') {
        return None;
    }
    let (plain, fault) = plain(text);
    if plain.is_empty() && fault.is_none() {
        return None;
    }
    let (is_optional, rest) = match plain.strip_prefix('/') {
        Some(rest) => (true, rest),
        None => (false, plain.as_str()),
    };
    let (program, sequence) = (None, None);
    let mut line = Line { number, is_optional, program, sequence, rest: String::new(), fault };
    if line.fault.is_none() {
        line.fault = line.split(rest).err();
    }
    Some(line)
}

impl Line {
    /// Splits off the program number and the sequence number that a block begins with. A number counts whatever is
    /// wrong behind it.
    fn split(&mut self, mut rest: &str) -> Result<(), StepError> {
        for (letter, place) in [('O', &mut self.program), ('N', &mut self.sequence)] {
            if let Some(after) = rest.strip_prefix(letter) {
                let (number, after) = number_of(letter, after)?;
                *place = Some(number);
                rest = after;
            }
        }
        rest.clone_into(&mut self.rest);
        Ok(())
    }
}

/// A line in capitals, without blanks and comments, up to what is wrong with it. One carriage return belongs to its
/// end.
fn plain(text: &str) -> (String, Option<StepError>) {
    let mut plain = String::new();
    let mut in_comment = false;
    for character in text.strip_suffix('\r').unwrap_or(text).chars() {
        match character {
            '(' if in_comment => {
                let message = "a comment within a comment";
                return (plain, Some(refuse_form(FaultKind::BadComment, message)));
            }
            '(' => in_comment = true,
            ')' if in_comment => in_comment = false,
            _ if in_comment => {}
            ' ' | '\t' => {}
            'A'..='Z'
            | 'a'..='z'
            | '0'..='9'
            | '+'
            | '-'
            | '*'
            | '/'
            | '.'
            | '#'
            | '['
            | ']'
            | '=' => plain.push(character.to_ascii_uppercase()),
            _ => {
                let message = format!("{character:?} stands for nothing");
                return (plain, Some(refuse_form(FaultKind::BadCharacter, message)));
            }
        }
    }
    let message = "a comment that is not closed";
    let fault = in_comment.then(|| refuse_form(FaultKind::BadComment, message));
    (plain, fault)
}

/// Rule nct.plain-numbers. O and N take no variable, and neither does the slash.
fn number_of(letter: char, after: &str) -> Result<(u32, &str), StepError> {
    if after.starts_with(['#', '[']) {
        let message = format!("{letter} takes no variable");
        return Err(refuse(rule::nct::PLAIN_NUMBERS, FaultKind::Statement, message));
    }
    let digits = after.len() - after.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let (number, rest) = after.split_at(digits);
    let number = number.parse().ok().filter(|_| digits <= MOST_DIGITS);
    let message = format!("{letter} without a whole number of up to {MOST_DIGITS} digits");
    let number = number.ok_or_else(|| refuse_form(FaultKind::BadNumber, message))?;
    if rest.starts_with('.') {
        let message = format!("{letter} takes a whole number");
        return Err(refuse_form(FaultKind::BadNumber, message));
    }
    Ok((number, rest))
}
