//! Expressions and conditions.

use std::cmp::Ordering;

use gaugeblock_vocabulary::FaultKind;

use super::reader::Reader;
use super::statements::lone_variable;
use super::{Expression, Operator, Reference, Side, Test};
use crate::gpp::refusal::{StepError, refuse};
use crate::gpp::text::Token;
use crate::ids::rule;

/// The signs and words of comparisons, and the ways in which two sides must compare for each to hold.
const COMPARISONS: &[(&str, &str, &[Ordering])] = &[
    ("==", "_EQ_", &[Ordering::Equal]),
    ("!=", "_NE_", &[Ordering::Less, Ordering::Greater]),
    ("<=", "_LE_", &[Ordering::Less, Ordering::Equal]),
    (">=", "_GE_", &[Ordering::Greater, Ordering::Equal]),
    ("<", "_LT_", &[Ordering::Less]),
    (">", "_GT_", &[Ordering::Greater]),
];

impl Reader<'_> {
    /// A condition in its parentheses. A variable alone counts as a test of its flag where `lone` says so, and is
    /// noted.
    pub(super) fn condition(&mut self, lone: bool) -> Result<Vec<Test>, StepError> {
        self.alone = 0;
        self.expect("(")?;
        self.in_condition = true;
        let tests = self.tests(lone)?;
        self.in_condition = false;
        self.expect(")")?;
        Ok(tests)
    }

    fn tests(&mut self, lone: bool) -> Result<Vec<Test>, StepError> {
        let mut tests = vec![self.test(lone)?];
        while self.takes("&&") {
            tests.push(self.test(lone)?);
        }
        if self.is_sign("||") {
            return Err(open("whether conditions know `||`"));
        }
        Ok(tests)
    }

    fn test(&mut self, lone: bool) -> Result<Test, StepError> {
        if let Some(word @ ("VAR_SET" | "VAR_NOTSET")) = self.word() {
            let on = word == "VAR_SET";
            self.take();
            self.expect("(")?;
            let reference = self.reference()?;
            self.expect(")")?;
            self.warn_of_non_modal(reference.variable);
            return Ok(Test::Is(on, reference));
        }
        if self.is_sign("!") {
            return Err(open("whether conditions know `!`"));
        }
        let one = self.side()?;
        if let Some(comparison) = self.comparison() {
            let other = self.side()?;
            return self.compared(one, comparison, other);
        }
        match one {
            Side::Variable(reference) if lone => {
                self.alone += 1;
                self.warn_of_non_modal(reference.variable);
                Ok(Test::Is(true, reference))
            }
            Side::Variable(_) => Err(lone_variable()),
            Side::Text(_) | Side::Expression(_) => Err(self.odd("a comparison")),
        }
    }

    fn compared(
        &self,
        one: Side,
        ways: &'static [Ordering],
        other: Side,
    ) -> Result<Test, StepError> {
        let is_text = self.is_text(&one);
        self.same_type(is_text, self.is_text(&other))?;
        let orders = ways.contains(&Ordering::Less) != ways.contains(&Ordering::Greater);
        if is_text && orders {
            return Err(open("the order of texts"));
        }
        Ok(Test::Compare(one, ways, other))
    }

    fn comparison(&mut self) -> Option<&'static [Ordering]> {
        let stands = |sign: &str, word: &str| self.is_sign(sign) || self.word() == Some(word);
        let found = COMPARISONS.iter().find(|(sign, word, _)| stands(sign, word))?;
        self.take();
        Some(found.2)
    }

    /// What is assigned or compared.
    pub(super) fn side(&mut self) -> Result<Side, StepError> {
        if let Token::Text(text) = self.peek() {
            let text = text.clone();
            self.take();
            return Ok(Side::Text(text));
        }
        Ok(match self.expression()? {
            Expression::Variable(reference) => Side::Variable(reference),
            expression @ (Expression::Number(_)
            | Expression::Negated(_)
            | Expression::Chain(..)) => Side::Expression(expression),
        })
    }

    pub(super) fn is_text(&self, side: &Side) -> bool {
        match side {
            Side::Text(_) => true,
            Side::Variable(reference) => reference.is_text(&self.variables),
            Side::Expression(_) => false,
        }
    }

    /// A sum, or a single part of it.
    fn expression(&mut self) -> Result<Expression, StepError> {
        self.chain(&[("+", Operator::Add), ("-", Operator::Subtract)], Self::product)
    }

    fn product(&mut self) -> Result<Expression, StepError> {
        self.chain(&[("*", Operator::Multiply), ("/", Operator::Divide)], Self::operand)
    }

    fn chain(
        &mut self,
        operators: &[(&str, Operator)],
        part: fn(&mut Self) -> Result<Expression, StepError>,
    ) -> Result<Expression, StepError> {
        let first = part(self)?;
        let mut others = Vec::new();
        while let Some((sign, operator)) = operators.iter().find(|(sign, _)| self.is_sign(sign)) {
            self.takes(sign);
            let other = part(self)?;
            self.is_number(&other)?;
            others.push((*operator, other));
        }
        if others.is_empty() {
            return Ok(first);
        }
        self.is_number(&first)?;
        Ok(Expression::Chain(Box::new(first), others))
    }

    fn is_number(&self, expression: &Expression) -> Result<(), StepError> {
        let is_text = match expression {
            Expression::Variable(reference) => reference.is_text(&self.variables),
            Expression::Number(_) | Expression::Negated(_) | Expression::Chain(..) => false,
        };
        self.same_type(is_text, false)
    }

    fn operand(&mut self) -> Result<Expression, StepError> {
        match self.peek().clone() {
            Token::Number(number) => {
                self.take();
                let number = number.parse().map_err(|_| not_a_number(&number))?;
                Ok(Expression::Number(number))
            }
            Token::Sign(sign @ ("+" | "-")) => {
                self.deeper()?;
                self.take();
                let operand = self.operand()?;
                self.depth -= 1;
                self.is_number(&operand)?;
                let is_minus = sign == "-";
                // A sign makes an expression of a variable.
                let chain = |operand| Expression::Chain(Box::new(operand), Vec::new());
                let negated = |operand| Expression::Negated(Box::new(operand));
                Ok(if is_minus { negated(operand) } else { chain(operand) })
            }
            Token::Sign("(") => self.parenthesised(),
            Token::Word(word) => self.named_operand(&word),
            Token::Text(_) => {
                Err(self.same_type(true, false).err().unwrap_or_else(|| self.odd("a number")))
            }
            Token::HeadingWord(_)
            | Token::Sign(_)
            | Token::LineFeed
            | Token::Bad(..)
            | Token::End => Err(self.odd("a number, a variable, or an expression")),
        }
    }

    fn parenthesised(&mut self) -> Result<Expression, StepError> {
        self.deeper()?;
        self.take();
        if self.in_condition && self.is_sign("!") {
            return Err(open("whether conditions know `!`"));
        }
        let inner = self.expression()?;
        let compares = self.comparison().is_some() || self.is_sign("&&") || self.is_sign("||");
        if self.in_condition && compares {
            return Err(open("whether conditions know parentheses"));
        }
        self.expect(")")?;
        self.depth -= 1;
        Ok(inner)
    }

    fn named_operand(&mut self, word: &str) -> Result<Expression, StepError> {
        if self.in_condition && self.depth > 0 && matches!(word, "VAR_SET" | "VAR_NOTSET") {
            return Err(open("whether conditions know parentheses"));
        }
        let is_declared = self.variables.place(word).is_some();
        if !is_declared && !super::is_keyword(word) && self.comes_next("(") {
            return Err(open(&format!("which functions there are, such as {word}")));
        }
        Ok(Expression::Variable(self.reference()?))
    }

    /// A reference to a variable whose name has been read: the index belongs to arrays, and to nothing else.
    pub(super) fn indexed(&mut self, variable: usize) -> Result<Reference, StepError> {
        let is_array = self.variables.all[variable].size.is_some();
        if is_array != self.is_sign("[") {
            return Err(self.odd(if is_array { "the index of an array" } else { "no index" }));
        }
        if !is_array {
            return Ok(Reference { variable, index: None });
        }
        self.deeper()?;
        self.take();
        let in_condition = std::mem::replace(&mut self.in_condition, false);
        let index = self.expression()?;
        self.in_condition = in_condition;
        self.is_number(&index)?;
        self.expect("]")?;
        self.depth -= 1;
        Ok(Reference { variable, index: Some(Box::new(index)) })
    }
}

fn open(what: &str) -> StepError {
    StepError::Unspecified(format!("no document says {what}"))
}

fn not_a_number(text: &str) -> StepError {
    refuse(rule::gpp::STATEMENT, FaultKind::BadNumber, format!("not a number: {text}"))
}
