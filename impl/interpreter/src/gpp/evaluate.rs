//! Expressions, places and tests, evaluated.

use gaugeblock_vocabulary::FaultKind;

use super::formats::{Format, REAL};
use super::program::{IndexRange, Operation, Program, Source, Sum, Test, VariableRef};
use super::variables::Variables;
use super::words::Compare;
use crate::faults::{PlantedFault, planted};
use crate::math;

/// Why a statement is not executed: the kind, and a message.
pub(super) type StatementError = (FaultKind, &'static str);

const NO_VALUE: StatementError = (FaultKind::NoValue, "a variable has no value");
const TOO_LONG: StatementError =
    (FaultKind::NumberTooLong, "a number has more digits before the point than its format");

/// The refusal of a number that is too long.
pub(super) fn too_long<E>(_: E) -> StatementError {
    TOO_LONG
}

/// Evaluates expressions while a program runs.
#[derive(Clone, Copy)]
pub(super) struct Evaluator<'a> {
    pub(super) program: &'a Program,
    pub(super) variables: &'a Variables,
    pub(super) formats: &'a [Format],
    pub(super) absent_zero: bool,
    pub(super) tie_even: bool,
}

/// Operands that wait.
pub(super) type Stack = alloc::vec::Vec<f64>;

impl<'a> Evaluator<'a> {
    /// The value of an expression.
    pub(super) fn number(
        &self,
        part: IndexRange,
        stack: &mut Stack,
    ) -> Result<f64, StatementError> {
        let base = stack.len();
        for operation in part.of(&self.program.operations) {
            let value = match *operation {
                Operation::Number(number) => number,
                Operation::Value(slot) => self.value(slot)?,
                Operation::Member(variable) => {
                    let index = stack.pop().unwrap_or_default();
                    self.value(self.member(variable, index)?)?
                }
                Operation::Negate => -stack.pop().unwrap_or_default(),
                Operation::Two(operation) => {
                    let right = stack.pop().unwrap_or_default();
                    operate(operation, stack.pop().unwrap_or_default(), right)?
                }
            };
            stack.push(value);
        }
        let value = stack.pop().unwrap_or_default();
        stack.truncate(base);
        Ok(value)
    }

    /// The number that a variable is worth in an expression.
    fn value(&self, slot: usize) -> Result<f64, StatementError> {
        match self.variables.number(slot) {
            Some(number) => Ok(number),
            None if self.absent_zero => Ok(0.0),
            None => Err(NO_VALUE),
        }
    }

    /// The slot of the member that an index leads to.
    fn member(&self, variable: usize, index: f64) -> Result<usize, StatementError> {
        const OUT: StatementError = (FaultKind::IndexOutOfRange, "the array has no such member");
        let array = self.variables.variables.get(variable).ok_or(OUT)?;
        let rounded = if planted(PlantedFault::IndexCut) {
            math::floor(index)
        } else {
            math::round_away(index)
        };
        if !(1.0..=1e6).contains(&rounded) {
            return Err(OUT);
        }
        let member = usize::try_from(math::to_count(rounded)).map_err(|_| OUT)?;
        if array.size.is_none_or(|size| member > size) {
            return Err(OUT);
        }
        array.first.checked_add(member).and_then(|place| place.checked_sub(1)).ok_or(OUT)
    }

    /// The slot of a place.
    pub(super) fn slot(
        &self,
        place: VariableRef,
        stack: &mut Stack,
    ) -> Result<usize, StatementError> {
        match place {
            VariableRef::Alone(slot) => Ok(slot),
            VariableRef::Member { variable, index } => {
                let index = self.number(index, stack)?;
                self.member(variable, index)
            }
        }
    }

    pub(super) fn text(
        &self,
        source: Source,
        stack: &mut Stack,
    ) -> Result<&'a str, StatementError> {
        match source {
            Source::Text(place) => {
                Ok(self.program.texts.get(place).map_or("", |text| text.as_str()))
            }
            Source::Variable(place) => {
                let slot = self.slot(place, stack)?;
                if !self.variables.has_value(slot) && !self.absent_zero {
                    return Err(NO_VALUE);
                }
                Ok(self.variables.slots.get(slot).map_or("", |slot| slot.text.as_str()))
            }
            Source::Expression(_) => Ok(""),
        }
    }

    /// A number, and the format of the variable that it alone is the value of.
    pub(super) fn source(
        &self,
        source: Source,
        stack: &mut Stack,
    ) -> Result<(f64, Option<usize>), StatementError> {
        match source {
            Source::Text(_) => Ok((0.0, None)),
            Source::Expression(part) => Ok((self.number(part, stack)?, None)),
            Source::Variable(place) => {
                let slot = self.slot(place, stack)?;
                let format = self.variables.variable_of(slot).map(|variable| variable.format);
                Ok((self.value(slot)?, format))
            }
        }
    }

    /// Whether a test holds.
    pub(super) fn holds(&self, test: &Test, stack: &mut Stack) -> Result<bool, StatementError> {
        match *test {
            Test::Flag { place, on } => {
                let slot = self.slot(place, stack)?;
                Ok(self.variables.is_on(slot) == on)
            }
            Test::Texts { left, compare, right } => {
                let left = self.text(left, stack)?;
                let right = self.text(right, stack)?;
                Ok((left == right) == (compare == Compare::Equal))
            }
            Test::Numbers { left, compare, right } => {
                let (left, left_format) = self.source(left, stack)?;
                let (right, right_format) = self.source(right, stack)?;
                if planted(PlantedFault::ComparedExactly) {
                    return Ok(compare.holds(left, right));
                }
                let left = self.rounded(left, left_format.or(right_format))?;
                let right = self.rounded(right, right_format.or(left_format))?;
                Ok(compare.holds(left, right))
            }
        }
    }

    /// A number as it is printed in a format, or as a real.
    fn rounded(&self, value: f64, format: Option<usize>) -> Result<f64, StatementError> {
        let format = self.formats.get(format.unwrap_or(REAL)).ok_or(TOO_LONG)?;
        format.rounded(value, self.tie_even).map(super::formats::Decimal::nearest).map_err(too_long)
    }
}

fn operate(operation: Sum, left: f64, right: f64) -> Result<f64, StatementError> {
    let value = match operation {
        Sum::Add => left + right,
        Sum::Subtract => left - right,
        Sum::Multiply => left * right,
        Sum::Divide if right.abs() > 0.0 => left / right,
        Sum::Divide => return Err((FaultKind::DivideByZero, "a division by zero")),
    };
    if value.is_finite() {
        Ok(value)
    } else {
        Err((FaultKind::OutOfDomain, "a result that is beyond all numbers"))
    }
}
