//! Expressions and conditions.

use std::cmp::Ordering;

use gaugeblock_vocabulary::FaultKind;

use super::refusal::{StepError, open, refuse, refuse_form};
use super::state::Run;
use super::syntax::{Comparison, Condition, Expression, Function, Operator};
use super::variables::VariableValue;
use crate::ids::{choice, rule};
use crate::math;

impl Run<'_> {
    /// What an expression comes to: a number, or nothing where it is a vacant variable alone.
    ///
    /// Rule nct.vacant. In arithmetic, behind a sign too, a vacant variable counts as zero.
    pub(super) fn value(&mut self, expression: &Expression) -> Result<VariableValue, StepError> {
        Ok(match expression {
            Expression::Number(number) => Some(*number),
            Expression::Variable(number) => {
                let number = self.variable_number(number)?;
                let value = self.variables.get(number)?;
                self.coverage.accepted(rule::nct::VARIABLE_NUMBERS);
                value
            }
            Expression::Affirmed(operand) => Some(self.number(operand)?),
            Expression::Negated(operand) => Some(0.0 - self.number(operand)?),
            Expression::Function(function, operand) => {
                let operand = self.number(operand)?;
                Some(self.function(*function, operand)?)
            }
            Expression::Chain(first, others) => {
                let mut result = self.number(first)?;
                for (operator, operand) in others {
                    let operand = self.number(operand)?;
                    result = self.applied(*operator, result, operand)?;
                }
                self.coverage.accepted(rule::nct::PRECEDENCE);
                self.coverage.accepted(rule::nct::BRACKETS);
                Some(result)
            }
        })
    }

    fn number(&mut self, expression: &Expression) -> Result<f64, StepError> {
        let value = self.value(expression)?;
        if value.is_none() {
            self.coverage.accepted(rule::nct::VACANT);
        }
        Ok(value.unwrap_or(0.0))
    }

    /// The number of a variable.
    ///
    /// Rule nct.indirect. It may be computed.
    pub(super) fn variable_number(&mut self, expression: &Expression) -> Result<i64, StepError> {
        if !matches!(expression, Expression::Number(_)) {
            self.coverage.accepted(rule::nct::INDIRECT);
        }
        let Some(number) = self.value(expression)? else {
            return Err(open("a vacant variable as the number of a variable"));
        };
        whole(number).ok_or_else(|| open("the number of a variable that is not a whole number"))
    }

    /// Rule nct.functions. Which functions there are, and in which unit their angles are, are choices.
    fn function(&mut self, function: Function, operand: f64) -> Result<f64, StepError> {
        if function == Function::Not {
            return self.bits(operand, 0.0, |operand, _| !operand);
        }
        self.coverage.accepted(rule::nct::FUNCTIONS);
        let radians = if self.choices.is(choice::nct::Angles::Radians) {
            operand
        } else {
            operand.to_radians()
        };
        let angle = |degrees: f64| {
            if self.choices.is(choice::nct::Angles::Radians) {
                degrees.to_radians()
            } else {
                degrees
            }
        };
        let result = match function {
            Function::Cosine => math::cosine(radians),
            Function::Sine => math::sine(radians),
            Function::Tangent => math::tangent(radians),
            Function::ArcSine => angle(math::degrees_of_sine(operand)),
            Function::ArcCosine => angle(math::degrees_of_cosine(operand)),
            Function::ArcTangent => angle(math::degrees_of(operand, 1.0)),
            Function::SquareRoot => math::square_root(operand),
            Function::Absolute => operand.abs(),
            Function::Round => operand.round(),
            Function::Fix if self.choices.is(choice::nct::FixFup::FloorAndCeiling) => {
                operand.floor()
            }
            Function::Fix => operand.trunc(),
            Function::Fup if self.choices.is(choice::nct::FixFup::FloorAndCeiling) => {
                operand.ceil()
            }
            Function::Fup if operand < 0.0 => operand.floor(),
            Function::Fup => operand.ceil(),
            Function::Logarithm => math::logarithm(operand),
            Function::Exponential => math::exponential(operand),
            Function::Not => operand,
        };
        finite(result).map_err(|()| {
            let message = format!("the function has no value at {operand}");
            refuse(rule::nct::FUNCTIONS, FaultKind::OutOfDomain, message)
        })
    }

    fn applied(&mut self, operator: Operator, left: f64, right: f64) -> Result<f64, StepError> {
        let divides = matches!(operator, Operator::Over | Operator::Modulo);
        if divides && is_zero(right) {
            return Err(refuse_form(FaultKind::DivideByZero, "division by zero"));
        }
        let result = match operator {
            Operator::Times => left * right,
            Operator::Over => left / right,
            Operator::Modulo => left % right,
            Operator::Plus => left + right,
            Operator::Minus => left - right,
            Operator::And => return self.bits(left, right, |left, right| left & right),
            Operator::Or => return self.bits(left, right, |left, right| left | right),
            Operator::ExclusiveOr => return self.bits(left, right, |left, right| left ^ right),
        };
        finite(result)
            .map_err(|()| refuse_form(FaultKind::OutOfDomain, "a number that is too large"))
    }

    /// Rule nct.bits. NOT, AND, OR and XOR take whole numbers of 32 bits: 3091 ERRONEOUS OPERATION WITH # where there
    /// is none. Choice nct.thirty-two-bits: with a sign or without.
    fn bits(
        &mut self,
        left: f64,
        right: f64,
        operation: fn(u32, u32) -> u32,
    ) -> Result<f64, StepError> {
        let unsigned = self.choices.is(choice::nct::ThirtyTwoBits::Unsigned);
        let bits = |number: f64| {
            let number = rounded(number);
            if unsigned {
                u32::try_from(number).ok()
            } else {
                i32::try_from(number).ok().map(i32::cast_unsigned)
            }
        };
        let message = format!("{left} and {right} are not whole numbers of 32 bits");
        let (Some(left), Some(right)) = (bits(left), bits(right)) else {
            return Err(refuse(rule::nct::BITS, FaultKind::OutOfDomain, message));
        };
        self.coverage.accepted(rule::nct::BITS);
        let result = operation(left, right);
        Ok(if unsigned { f64::from(result) } else { f64::from(result.cast_signed()) })
    }

    /// Rule nct.conditions. Two numbers are compared as numbers.
    pub(super) fn condition(&mut self, condition: &Condition) -> Result<bool, StepError> {
        let (left, right) = (self.value(&condition.left)?, self.value(&condition.right)?);
        let (Some(left), Some(right)) = (left, right) else {
            return self.vacant_condition(condition.comparison, left, right);
        };
        self.coverage.accepted(rule::nct::CONDITIONS);
        let order = left.partial_cmp(&right).expect("evaluate: numbers are finite");
        Ok(match condition.comparison {
            Comparison::Equal => order.is_eq(),
            Comparison::NotEqual => order.is_ne(),
            Comparison::Greater => order.is_gt(),
            Comparison::Less => order.is_lt(),
            Comparison::GreaterOrEqual => order.is_ge(),
            Comparison::LessOrEqual => order.is_le(),
        })
    }

    /// Rule nct.vacant-comparison. Vacant is equal to vacant alone, and greater than zero.
    fn vacant_condition(
        &mut self,
        comparison: Comparison,
        left: VariableValue,
        right: VariableValue,
    ) -> Result<bool, StepError> {
        if [left, right].iter().flatten().any(|number| !is_zero(*number)) {
            return match comparison {
                Comparison::Equal => Ok(false),
                Comparison::NotEqual => Ok(true),
                Comparison::Greater
                | Comparison::GreaterOrEqual
                | Comparison::Less
                | Comparison::LessOrEqual => {
                    Err(open("GT, GE, LT or LE of a vacant variable and a number that is not zero"))
                }
            }
            .inspect(|_| self.coverage.accepted(rule::nct::VACANT_COMPARISON));
        }
        let order = match (left, right) {
            (None, None) => Ordering::Equal,
            (None, Some(_)) => Ordering::Greater,
            (Some(_), None | Some(_)) => Ordering::Less,
        };
        let holds = match comparison {
            Comparison::Equal => order.is_eq(),
            Comparison::NotEqual => order.is_ne(),
            Comparison::Greater => order.is_gt(),
            Comparison::GreaterOrEqual => order.is_ge(),
            Comparison::Less | Comparison::LessOrEqual => {
                return Err(open("LT or LE with a vacant variable"));
            }
        };
        self.coverage.accepted(rule::nct::VACANT_COMPARISON);
        Ok(holds)
    }
}

fn finite(number: f64) -> Result<f64, ()> {
    if number.is_finite() { Ok(number) } else { Err(()) }
}

fn is_zero(number: f64) -> bool {
    number.abs().to_bits() == 0
}

/// A whole number as one; the nearest that has 64 bits where it has more.
pub(super) fn whole(number: f64) -> Option<i64> {
    is_zero(number - number.trunc()).then(|| rounded(number))
}

/// The nearest whole number that has 64 bits, ties away from zero.
pub(super) fn rounded(number: f64) -> i64 {
    #[expect(clippy::cast_possible_truncation, reason = "no number has more than 64 bits")]
    {
        number.round() as i64
    }
}
