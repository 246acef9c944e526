//! Expressions.

use super::reader::{Reader, bad};
use crate::ids::{choice, rule};
use crate::nct::refusal::StepError;

/// An expression. It is no deeper than brackets are, whatever its length.
#[derive(Clone, Debug, PartialEq)]
pub enum Expression {
    /// A number.
    Number(f64),
    /// A variable, by its number.
    Variable(Box<Self>),
    /// An operand with a plus sign.
    Affirmed(Box<Self>),
    /// An operand with a minus sign.
    Negated(Box<Self>),
    /// A function of an operand.
    Function(Function, Box<Self>),
    /// An operand, and others that are applied to it from left to right.
    Chain(Box<Self>, Vec<(Operator, Self)>),
}

/// An operator between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// `*`.
    Times,
    /// `/`.
    Over,
    /// Bit by bit.
    And,
    /// The rest of a division.
    Modulo,
    /// `+`.
    Plus,
    /// `-`.
    Minus,
    /// Bit by bit.
    Or,
    /// Bit by bit.
    ExclusiveOr,
}

/// A function of one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// Cosine.
    Cosine,
    /// Sine.
    Sine,
    /// Tangent.
    Tangent,
    /// Arc sine.
    ArcSine,
    /// Arc cosine.
    ArcCosine,
    /// Arc tangent, a quarter turn to either side of zero.
    ArcTangent,
    /// Square root.
    SquareRoot,
    /// Absolute value.
    Absolute,
    /// Rounded to the nearest whole number, halves away from zero.
    Round,
    /// The whole number next to it on one side.
    Fix,
    /// The whole number next to it on the other side.
    Fup,
    /// The logarithm to the base e.
    Logarithm,
    /// e to the power.
    Exponential,
    /// Each of the 32 bits the other way round.
    Not,
}

const DOCUMENTED: &[(&str, Function)] = &[("COS", Function::Cosine), ("NOT", Function::Not)];

const USUAL: &[(&str, Function)] = &[
    ("SIN", Function::Sine),
    ("TAN", Function::Tangent),
    ("ASIN", Function::ArcSine),
    ("ACOS", Function::ArcCosine),
    ("ATAN", Function::ArcTangent),
    ("SQRT", Function::SquareRoot),
    ("ABS", Function::Absolute),
    ("ROUND", Function::Round),
    ("FIX", Function::Fix),
    ("FUP", Function::Fup),
    ("LN", Function::Logarithm),
    ("EXP", Function::Exponential),
];

const FACTORS: &[(&str, Operator)] = &[
    ("*", Operator::Times),
    ("/", Operator::Over),
    ("AND", Operator::And),
    ("MOD", Operator::Modulo),
];

const TERMS: &[(&str, Operator)] = &[
    ("+", Operator::Plus),
    ("-", Operator::Minus),
    ("OR", Operator::Or),
    ("XOR", Operator::ExclusiveOr),
];

impl Reader<'_> {
    /// Rule nct.precedence. A function before `*`, `/` and AND, and those before `+`, `-`, OR and XOR.
    pub(super) fn expression(&mut self) -> Result<Expression, StepError> {
        self.chain(TERMS, |reader| reader.chain(FACTORS, Self::operand))
    }

    fn chain(
        &mut self,
        operators: &[(&str, Operator)],
        mut next: impl FnMut(&mut Self) -> Result<Expression, StepError>,
    ) -> Result<Expression, StepError> {
        let first = next(self)?;
        let mut others = Vec::new();
        while let Some(operator) = self.take_one(operators) {
            if operator == Operator::Modulo && self.choices.is(choice::nct::Functions::Documented) {
                return Err(bad("no document names MOD"));
            }
            others.push((operator, next(self)?));
        }
        if others.is_empty() { Ok(first) } else { Ok(Expression::Chain(Box::new(first), others)) }
    }

    /// An operand with or without a sign.
    fn operand(&mut self) -> Result<Expression, StepError> {
        self.signed(Self::unsigned_operand)
    }

    /// What comes next, with or without a sign.
    pub(super) fn signed(
        &mut self,
        next: impl FnOnce(&mut Self) -> Result<Expression, StepError>,
    ) -> Result<Expression, StepError> {
        if self.take("-") {
            return Ok(Expression::Negated(Box::new(next(self)?)));
        }
        if self.take("+") {
            return Ok(Expression::Affirmed(Box::new(next(self)?)));
        }
        next(self)
    }

    fn unsigned_operand(&mut self) -> Result<Expression, StepError> {
        if let Some(function) = self.function()? {
            let operand = if matches!(self.peek(), Some('A'..='Z')) {
                return Err(bad("expected a bracket, a variable or a number after a function"));
            } else {
                self.simple_operand()?
            };
            return Ok(Expression::Function(function, Box::new(operand)));
        }
        self.simple_operand()
    }

    fn function(&mut self) -> Result<Option<Function>, StepError> {
        if let Some(function) = self.take_one(DOCUMENTED) {
            return Ok(Some(function));
        }
        let usual = self.take_one(USUAL);
        if usual.is_some() && self.choices.is(choice::nct::Functions::Documented) {
            return Err(bad("no document names this function"));
        }
        Ok(usual)
    }

    /// A bracketed expression, a variable or a number.
    pub(super) fn simple_operand(&mut self) -> Result<Expression, StepError> {
        match self.peek() {
            Some('[') => {
                self.open()?;
                let inner = self.expression()?;
                self.close()?;
                Ok(inner)
            }
            Some('#') => self.variable().map(|number| Expression::Variable(Box::new(number))),
            Some('0'..='9' | '.') => self.number().map(Expression::Number),
            Some(other) => Err(bad(format!("{other:?} begins no operand"))),
            None => Err(bad("an operand is missing")),
        }
    }

    /// A number sign and the number of a variable.
    ///
    /// Rule nct.indirect. A number that is computed stands in brackets.
    pub(super) fn variable(&mut self) -> Result<Expression, StepError> {
        if !self.take("#") {
            return Err(bad("a variable is missing"));
        }
        match self.peek() {
            Some('[') => {
                self.open()?;
                let number = self.expression()?;
                self.close()?;
                Ok(number)
            }
            Some('0'..='9' | '.') => self.number().map(Expression::Number),
            Some('#') => {
                let message = "the number of a variable is computed in brackets";
                let kind = gaugeblock_vocabulary::FaultKind::Statement;
                Err(crate::nct::refusal::refuse(rule::nct::INDIRECT, kind, message))
            }
            Some(_) | None => Err(bad("the number of a variable is missing")),
        }
    }
}
