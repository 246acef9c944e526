//! A line that is read from left to right.

use gaugeblock_vocabulary::FaultKind;

use crate::Choices;
use crate::ids::rule;
use crate::nct::refusal::{StepError, refuse, refuse_form};

/// Most brackets that may stand within each other.
const DEEPEST: u32 = 5;
/// Most characters of a number.
const LONGEST_NUMBER: usize = 40;

/// What is left of a line.
#[derive(Clone, Debug)]
pub(super) struct Reader<'a> {
    rest: &'a str,
    depth: u32,
    pub(super) choices: &'a Choices,
}

/// Rule nct.statement-form. A macro statement of another form is refused: 3064 BAD MACRO STATEMENT.
pub(super) fn bad(message: impl Into<String>) -> StepError {
    refuse(rule::nct::STATEMENT_FORM, FaultKind::Statement, message)
}

impl<'a> Reader<'a> {
    pub(super) fn new(text: &'a str, choices: &'a Choices) -> Self {
        Self { rest: text, depth: 0, choices }
    }

    pub(super) fn is_at_end(&self) -> bool {
        self.rest.is_empty()
    }

    pub(super) fn peek(&self) -> Option<char> {
        self.rest.chars().next()
    }

    /// Takes a text if it comes next.
    pub(super) fn take(&mut self, text: &str) -> bool {
        match self.rest.strip_prefix(text) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    /// Takes the first of these names that comes next.
    pub(super) fn take_one<T: Copy>(&mut self, names: &[(&str, T)]) -> Option<T> {
        names.iter().find(|(name, _)| self.take(name)).map(|(_, value)| *value)
    }

    pub(super) fn take_letter(&mut self) -> Option<char> {
        let letter = self.peek().filter(char::is_ascii_uppercase)?;
        self.rest = &self.rest[1..];
        Some(letter)
    }

    /// Rule nct.brackets. Brackets stand within each other up to five deep; those of functions and indices count.
    pub(super) fn open(&mut self) -> Result<(), StepError> {
        if !self.take("[") {
            return Err(bad(format!("an opening bracket is missing before {:?}", self.rest)));
        }
        self.depth += 1;
        if self.depth > DEEPEST {
            let message = format!("more than {DEEPEST} brackets within each other");
            return Err(refuse(rule::nct::BRACKETS, FaultKind::Statement, message));
        }
        Ok(())
    }

    pub(super) fn close(&mut self) -> Result<(), StepError> {
        if !self.take("]") {
            return Err(bad("a closing bracket is missing"));
        }
        self.depth -= 1;
        Ok(())
    }

    /// A number without a sign: digits, perhaps with a point.
    pub(super) fn number(&mut self) -> Result<f64, StepError> {
        let of_number = |c: char| c.is_ascii_digit() || c == '.';
        let length = self.rest.len() - self.rest.trim_start_matches(of_number).len();
        let (text, rest) = self.rest.split_at(length);
        let has_digit = text.contains(|c: char| c.is_ascii_digit());
        let number = text.parse().ok().filter(|_| has_digit && length <= LONGEST_NUMBER);
        let message = || format!("{text:?} is not a number");
        let number = number.ok_or_else(|| refuse_form(FaultKind::BadNumber, message()))?;
        self.rest = rest;
        Ok(number)
    }

    /// A whole number of few digits, as behind DO and END.
    pub(super) fn digits(&mut self) -> Result<u32, StepError> {
        let length =
            self.rest.len() - self.rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let (text, rest) = self.rest.split_at(length);
        let number = text.parse().map_err(|_| bad("a whole number is missing"))?;
        self.rest = rest;
        Ok(number)
    }
}
