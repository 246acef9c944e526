//! Lines: blanks and comments left out, block delete, program and sequence numbers split off.

use gaugeblock_trace::FaultKind;

use super::refusal::{Halt, refuse, refuse_form};

/// Most digits of a program or sequence number.
const MOST_DIGITS: usize = 8;

/// A line that is a block, or begins a program.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its number, from 1.
    pub number: u32,
    /// Whether it begins with a slash.
    pub is_optional: bool,
    /// The program that begins here.
    pub program: Option<u32>,
    /// The sequence number that opens the block.
    pub sequence: Option<u32>,
    /// What follows, in capitals, without blanks and comments.
    pub rest: String,
    /// Why it is refused when it is reached.
    pub fault: Option<Halt>,
}

/// The lines of a program text that are not empty.
pub fn lines(text: &str) -> Vec<Line> {
    let numbered = (1_u32..).zip(text.split('\n'));
    numbered.filter_map(|(number, text)| line(number, text)).collect()
}

/// A line that begins with a percent sign is none.
fn line(number: u32, text: &str) -> Option<Line> {
    let begin = text.trim_start_matches([' ', '\t']);
    if begin.starts_with('%') {
        return None;
    }
    let mut line = Line {
        number,
        is_optional: begin.starts_with('/'),
        program: None,
        sequence: None,
        rest: String::new(),
        fault: None,
    };
    let plain = match plain(text) {
        Ok(plain) => plain,
        Err(fault) => {
            line.fault = Some(fault);
            return Some(line);
        }
    };
    if plain.is_empty() {
        return None;
    }
    let mut rest = plain.as_str();
    if let Some(after) = rest.strip_prefix('/') {
        line.is_optional = true;
        rest = after;
    }
    match numbers(rest) {
        Ok((program, sequence, rest)) => {
            (line.program, line.sequence) = (program, sequence);
            line.rest = rest.to_owned();
        }
        Err(fault) => line.fault = Some(fault),
    }
    Some(line)
}

/// The program number and the sequence number that a block begins with, and what follows.
fn numbers(mut rest: &str) -> Result<(Option<u32>, Option<u32>, &str), Halt> {
    let mut numbers = [None, None];
    for (letter, place) in ['O', 'N'].into_iter().zip(&mut numbers) {
        if let Some(after) = rest.strip_prefix(letter) {
            let (number, after) = number_of(letter, after)?;
            *place = Some(number);
            rest = after;
        }
    }
    let [program, sequence] = numbers;
    Ok((program, sequence, rest))
}

/// A line in capitals, without blanks and comments.
fn plain(text: &str) -> Result<String, Halt> {
    let mut plain = String::new();
    let mut in_comment = false;
    for character in text.trim_end_matches('\r').chars() {
        match character {
            '(' if in_comment => {
                return Err(refuse_form(FaultKind::BadComment, "a comment within a comment"));
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
                return Err(refuse_form(FaultKind::BadCharacter, message));
            }
        }
    }
    if in_comment {
        return Err(refuse_form(FaultKind::BadComment, "a comment that is not closed"));
    }
    Ok(plain)
}

/// Rule nct.plain-numbers. O and N take no variable, and neither does the slash.
fn number_of(letter: char, after: &str) -> Result<(u32, &str), Halt> {
    if after.starts_with(['#', '[']) {
        let message = format!("{letter} takes no variable");
        return Err(refuse("nct.plain-numbers", FaultKind::Statement, message));
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
