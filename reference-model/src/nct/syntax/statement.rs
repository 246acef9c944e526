//! Words and macro statements.

use gaugeblock_vocabulary::FaultKind;

use super::block::{Comparison, Condition, Content, Word};
use super::expression::Expression;
use super::reader::{Reader, bad};
use crate::Choices;
use crate::ids::{choice, rule};
use crate::nct::refusal::{StepError, open, refuse, refuse_form};

const COMPARISONS: &[(&str, Comparison)] = &[
    ("EQ", Comparison::Equal),
    ("NE", Comparison::NotEqual),
    ("GT", Comparison::Greater),
    ("LT", Comparison::Less),
    ("GE", Comparison::GreaterOrEqual),
    ("LE", Comparison::LessOrEqual),
];

/// What stands behind the numbers of a block.
pub(super) fn content(text: &str, choices: &Choices) -> Result<Content, StepError> {
    let mut reader = Reader::new(text, choices);
    let content = if text.starts_with('#') {
        reader.assignment()?
    } else if reader.take("GOTO") {
        Content::Goto(reader.target()?)
    } else if reader.take("IF") {
        reader.conditional()?
    } else if reader.take("WHILE") {
        let condition = reader.condition()?;
        if !reader.take("DO") {
            return Err(bad("WHILE without DO"));
        }
        Content::While(condition, reader.loop_number()?)
    } else if reader.take("END") {
        Content::End(reader.loop_number()?)
    } else if reader.take("DO") {
        reader.loops()?;
        return Err(open("DO without WHILE: on a page of the manual that is not available"));
    } else {
        return reader.words();
    };
    if reader.is_at_end() {
        Ok(content)
    } else {
        Err(bad("a macro statement together with other text"))
    }
}

impl Reader<'_> {
    fn assignment(&mut self) -> Result<Content, StepError> {
        let number = self.variable()?;
        if !self.take("=") {
            return Err(bad("an equals sign is missing"));
        }
        Ok(Content::Assign { number, value: self.expression()? })
    }

    fn conditional(&mut self) -> Result<Content, StepError> {
        let condition = self.condition()?;
        if self.take("THEN") {
            return Err(open("IF with THEN: on a page of the manual that is not available"));
        }
        if !self.take("GOTO") {
            return Err(bad("IF without GOTO"));
        }
        Ok(Content::If(condition, self.target()?))
    }

    /// The number behind GOTO: with a sign or not.
    fn target(&mut self) -> Result<Expression, StepError> {
        self.value()
    }

    /// Rule nct.conditions. Two expressions are compared by EQ, NE, GT, LT, GE or LE.
    fn condition(&mut self) -> Result<Condition, StepError> {
        self.open()?;
        let left = self.expression()?;
        let comparison =
            self.take_one(COMPARISONS).ok_or_else(|| bad("two values are compared"))?;
        let right = self.expression()?;
        self.close()?;
        Ok(Condition { left, comparison, right })
    }

    /// Choice nct.loops: whether there are WHILE, DO and END.
    fn loops(&self) -> Result<(), StepError> {
        if self.choices.is(choice::nct::Loops::Refused) {
            return Err(refuse(rule::nct::LOOPS, FaultKind::Statement, "there are no loops"));
        }
        Ok(())
    }

    /// Rule nct.loop-number. The number of a loop is 1, 2 or 3.
    fn loop_number(&mut self) -> Result<u32, StepError> {
        self.loops()?;
        let number = self.digits()?;
        if (1..=3).contains(&number) {
            return Ok(number);
        }
        let message = format!("{number} is not the number of a loop; expected 1, 2 or 3");
        Err(refuse(rule::nct::LOOP_NUMBER, FaultKind::Statement, message))
    }

    /// A value with or without a sign: a number, a variable, or an expression in brackets.
    fn value(&mut self) -> Result<Expression, StepError> {
        self.signed(Self::simple_operand)
    }

    fn words(&mut self) -> Result<Content, StepError> {
        let mut words = Vec::new();
        while !self.is_at_end() {
            let letter = self.take_letter().ok_or_else(|| {
                let found = self.peek().unwrap_or_default();
                refuse_form(FaultKind::BadBlock, format!("{found:?} begins no word"))
            })?;
            self.no_sequence_number(letter)?;
            words.push(Word { letter, value: self.value()? });
        }
        Ok(Content::Words(words))
    }

    /// Rule nct.sequence-number. N opens its block, and so does O.
    /// Rule nct.plain-numbers. They take no variable.
    fn no_sequence_number(&self, letter: char) -> Result<(), StepError> {
        if !matches!(letter, 'N' | 'O') {
            return Ok(());
        }
        if matches!(self.peek(), Some('#' | '[')) {
            let message = format!("{letter} takes no variable");
            return Err(refuse(rule::nct::PLAIN_NUMBERS, FaultKind::Statement, message));
        }
        let message = format!("{letter} opens its block");
        Err(refuse(rule::nct::SEQUENCE_NUMBER, FaultKind::BadBlock, message))
    }
}
