//! References, expressions and conditions: what they are worth now.

use std::cmp::Ordering;

use gaugeblock_vocabulary::{Channel, FaultKind};

use super::formats::REAL;
use super::refusal::{StepError, refuse, refuse_form};
use super::run::Run;
use super::status::too_long;
use super::syntax::{Condition, Expression, Operator, Reference, Side, Test};
use super::variables::Value;
use crate::ids::{choice, rule};

impl Run<'_> {
    /// Rule gpp.index. An index is rounded to the nearest number of a member, and leads to one.
    ///
    /// # Errors
    /// It cannot be evaluated, or there is no such member.
    pub(super) fn cell(&mut self, reference: &Reference) -> Result<usize, StepError> {
        let declared = &self.variables.all[reference.variable];
        let (first, size) = (declared.cell, declared.size.unwrap_or(1));
        let Some(index) = &reference.index else { return Ok(first) };
        let index = self.number(index)?.round();
        if !(1.0..=f64::from(size)).contains(&index) {
            let message = format!("an index is from 1 to {size}, not {index}");
            return Err(refuse(rule::gpp::INDEX, FaultKind::IndexOutOfRange, message));
        }
        self.coverage.accepted(rule::gpp::INDEX);
        let member: usize = index.to_string().parse().expect("index: a whole number in range");
        Ok(first + member - 1)
    }

    /// What a variable holds.
    ///
    /// # Errors
    /// Nothing, where that counts for nothing, or it is no member of its array.
    fn value_of(&mut self, reference: &Reference) -> Result<Value, StepError> {
        let cell = self.cell(reference)?;
        if let Some(value) = &self.variables.cells[cell].value {
            return Ok(value.clone());
        }
        if !self.choices.is(choice::gpp::WithoutValue::Zero) {
            let name = self.variables.shown_name(reference.variable, cell);
            return Err(refuse_form(FaultKind::NoValue, format!("{name} has no value")));
        }
        let is_text = reference.is_text(&self.variables);
        Ok(if is_text { Value::Text(String::new()) } else { Value::Number(0.0) })
    }

    /// What is assigned.
    ///
    /// # Errors
    /// It cannot be evaluated.
    pub(super) fn value(&mut self, side: &Side) -> Result<Value, StepError> {
        match side {
            Side::Text(text) => Ok(Value::Text(text.clone())),
            Side::Variable(reference) => self.value_of(reference),
            Side::Expression(expression) => self.number(expression).map(Value::Number),
        }
    }

    /// A number that is finite.
    fn number(&mut self, expression: &Expression) -> Result<f64, StepError> {
        let number = match expression {
            Expression::Number(number) => *number,
            Expression::Variable(reference) => match self.value_of(reference)? {
                Value::Number(number) => number,
                Value::Text(_) => unreachable!("syntax: an expression has no texts"),
            },
            Expression::Negated(operand) => -self.number(operand)?,
            Expression::Chain(first, others) => {
                let mut result = self.number(first)?;
                for (operator, operand) in others {
                    let operand = self.number(operand)?;
                    result = finite(calculated(result, *operator, operand)?)?;
                }
                result
            }
        };
        finite(number)
    }

    /// Whether all that an IF tests holds.
    ///
    /// # Errors
    /// Something of it cannot be evaluated.
    pub(super) fn condition(&mut self, condition: &Condition) -> Result<bool, StepError> {
        match condition {
            Condition::All(tests) => self.tests(tests),
            Condition::Flag(reference) => {
                let cell = self.cell(reference)?;
                if !self.variables.all[reference.variable].modal {
                    let name = self.variables.shown_name(reference.variable, cell);
                    self.record.say(Channel::Display, format!("warning: {name} is not modal"));
                }
                self.coverage.accepted(rule::gpp::TESTED);
                Ok(self.variables.cells[cell].on)
            }
        }
    }

    /// Tests from the left up to the first that does not hold.
    ///
    /// # Errors
    /// One of them cannot be evaluated.
    pub(super) fn tests(&mut self, tests: &[Test]) -> Result<bool, StepError> {
        for test in tests {
            if !self.test(test)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Rule gpp.tested. `VAR_SET` holds where the flag is on, `VAR_NOTSET` where it is off.
    fn test(&mut self, test: &Test) -> Result<bool, StepError> {
        match test {
            Test::Is(on, reference) => {
                let cell = self.cell(reference)?;
                self.coverage.accepted(rule::gpp::TESTED);
                Ok(self.variables.cells[cell].on == *on)
            }
            Test::Compare(one, ways, other) => {
                let ordering = self.compared(one, other)?;
                self.coverage.accepted(rule::gpp::COMPARISON);
                Ok(ways.contains(&ordering))
            }
        }
    }

    /// Rule gpp.comparison. Numbers are compared as they are printed: a variable in its own format, an expression in
    /// that of the variable on the other side, and two expressions in that of reals.
    fn compared(&mut self, one: &Side, other: &Side) -> Result<Ordering, StepError> {
        let (left, right) = (self.value(one)?, self.value(other)?);
        let (left, right) = match (left, right) {
            (Value::Number(left), Value::Number(right)) => (left, right),
            (Value::Text(left), Value::Text(right)) => return Ok(left.cmp(&right)),
            (Value::Number(_), Value::Text(_)) | (Value::Text(_), Value::Number(_)) => {
                unreachable!("syntax: both sides are of one type")
            }
        };
        let (of_one, of_other) = (self.format(one), self.format(other));
        let left = self.read_back(left, of_one.or(of_other).unwrap_or(REAL))?;
        let right = self.read_back(right, of_other.or(of_one).unwrap_or(REAL))?;
        Ok(left.partial_cmp(&right).expect("formats: what is read back is a number"))
    }

    /// The format of a variable alone.
    fn format(&self, side: &Side) -> Option<usize> {
        match side {
            Side::Variable(reference) => Some(self.variables.all[reference.variable].format),
            Side::Text(_) | Side::Expression(_) => None,
        }
    }

    fn read_back(&self, number: f64, format: usize) -> Result<f64, StepError> {
        let format = &self.variables.formats[format];
        format.read_back(number, self.choices.get::<choice::gpp::Tie>()).map_err(|_| too_long())
    }
}

fn calculated(left: f64, operator: Operator, right: f64) -> Result<f64, StepError> {
    match operator {
        Operator::Add => Ok(left + right),
        Operator::Subtract => Ok(left - right),
        Operator::Multiply => Ok(left * right),
        Operator::Divide if right.abs() > 0.0 => Ok(left / right),
        Operator::Divide => Err(refuse_form(FaultKind::DivideByZero, "a division by zero")),
    }
}

fn finite(number: f64) -> Result<f64, StepError> {
    if number.is_finite() {
        return Ok(number);
    }
    Err(refuse_form(FaultKind::OutOfDomain, "the result is too large to be a number"))
}
