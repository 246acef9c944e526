//! Operators and functions.

use gaugeblock_vocabulary::FaultKind;

use crate::Choices;
use crate::ids::choice::expressions::{RoundHalf, TrueValue};
use crate::ids::{choice, rule};
use crate::math;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::{Function, Operator};

/// Numbers that differ by less are equal.
const TOLERANCE: f64 = 0.0001;

/// The value of an operation.
///
/// Rule expressions.arithmetic. Plus, minus, asterisk and slash add, subtract, multiply and divide real numbers.
/// Rule expressions.logical. AND, OR and XOR take any real numbers; zero is false, every other number is true.
pub(super) fn operate(
    operator: Operator,
    left: f64,
    right: f64,
    state: &mut State,
) -> Result<f64, StepError> {
    let choices = &state.choices;
    let (rule, value) = match operator {
        Operator::Power => (rule::expressions::POWER, power(left, right)?),
        Operator::Divide => (rule::expressions::ARITHMETIC, divide(left, right)?),
        Operator::Modulus => (rule::expressions::MODULUS, modulus(left, right, choices)?),
        Operator::Multiply => (rule::expressions::ARITHMETIC, left * right),
        Operator::Add => (rule::expressions::ARITHMETIC, left + right),
        Operator::Subtract => (rule::expressions::ARITHMETIC, left - right),
        Operator::Equal => (rule::expressions::TOLERANCE, truth(equal(left, right), choices)),
        Operator::NotEqual => (rule::expressions::TOLERANCE, truth(!equal(left, right), choices)),
        Operator::Greater => {
            (rule::expressions::RELATIONAL, truth(greater(left, right, choices), choices))
        }
        Operator::Less => {
            (rule::expressions::RELATIONAL, truth(greater(right, left, choices), choices))
        }
        Operator::GreaterOrEqual => {
            (rule::expressions::RELATIONAL, truth(!greater(right, left, choices), choices))
        }
        Operator::LessOrEqual => {
            (rule::expressions::RELATIONAL, truth(!greater(left, right, choices), choices))
        }
        Operator::And => {
            (rule::expressions::LOGICAL, truth(!is_zero(left) && !is_zero(right), choices))
        }
        Operator::Or => {
            (rule::expressions::LOGICAL, truth(!is_zero(left) || !is_zero(right), choices))
        }
        Operator::ExclusiveOr => {
            (rule::expressions::LOGICAL, truth(is_zero(left) != is_zero(right), choices))
        }
    };
    if !value.is_finite() {
        let message = format!("the result of an operation on {left} and {right} is too great");
        return Err(refuse(rule::expressions::DOMAIN, FaultKind::OutOfDomain, message));
    }
    state.coverage.accepted(rule);
    if rule == rule::expressions::TOLERANCE {
        state.coverage.accepted(rule::expressions::RELATIONAL);
    }
    Ok(value)
}

/// Rule expressions.division-by-zero. A division by zero gives no number and is refused.
fn divide(left: f64, right: f64) -> Result<f64, StepError> {
    if is_zero(right) {
        let message = format!("{left} is divided by zero");
        return Err(refuse(rule::expressions::DIVISION_BY_ZERO, FaultKind::DivideByZero, message));
    }
    Ok(left / right)
}

/// Rule expressions.modulus. MOD gives the remainder of a division of any real numbers.
/// Rule expressions.modulus-zero. A modulus of zero gives no number and is refused.
/// Choice expressions.modulus-sign: never negative, or with the sign of the number on the left.
fn modulus(left: f64, right: f64, choices: &Choices) -> Result<f64, StepError> {
    if is_zero(right) {
        let message = format!("the remainder of {left} by zero is not defined");
        return Err(refuse(rule::expressions::MODULUS_ZERO, FaultKind::DivideByZero, message));
    }
    if choices.is(choice::expressions::ModulusSign::Dividend) {
        return Ok(left % right);
    }
    Ok(left.rem_euclid(right))
}

/// Rule expressions.power. Two asterisks raise the number on the left to the power on the right.
/// Rule expressions.power-domain. A power that is not a real number is refused.
fn power(base: f64, exponent: f64) -> Result<f64, StepError> {
    let value = math::power(base, exponent);
    if !value.is_finite() {
        let message = format!("{base} to the power {exponent} is not a real number");
        return Err(refuse(rule::expressions::POWER_DOMAIN, FaultKind::OutOfDomain, message));
    }
    Ok(value)
}

/// Rule expressions.tolerance. EQ and NE take two numbers as equal when they differ by less than 0.0001.
fn equal(left: f64, right: f64) -> bool {
    (left - right).abs() < TOLERANCE
}

/// Rule expressions.relational. GT, GE, LT and LE compare two numbers.
/// Choice expressions.order-tolerance: as they are, or with the tolerance of equality.
fn greater(left: f64, right: f64, choices: &Choices) -> bool {
    left > right
        && !(choices.is(choice::expressions::OrderTolerance::Tolerant) && equal(left, right))
}

/// Choice expressions.true-value: what a true comparison gives.
fn truth(holds: bool, choices: &Choices) -> f64 {
    match (holds, choices.get::<TrueValue>()) {
        (false, _) => 0.0,
        (true, TrueValue::MinusOne) => -1.0,
        (true, TrueValue::One) => 1.0,
    }
}

/// The value of a function.
///
/// Rule expressions.domain. A function of an argument outside its domain gives no number and is refused.
pub(super) fn function(
    function: Function,
    argument: f64,
    state: &mut State,
) -> Result<f64, StepError> {
    let (rule, value) = match function {
        Function::Absolute => {
            (rule::expressions::ABSOLUTE, state.dialect().absolute(argument, &state.choices))
        }
        Function::Sine => (rule::expressions::ANGLES, math::sine_of_degrees(argument)),
        Function::Cosine => (rule::expressions::ANGLES, math::cosine_of_degrees(argument)),
        Function::Tangent => (rule::expressions::ANGLES, math::tangent_of_degrees(argument)),
        Function::ArcSine => (rule::expressions::ANGLES, math::degrees_of_sine(argument)),
        Function::ArcCosine => (rule::expressions::ANGLES, math::degrees_of_cosine(argument)),
        Function::Exponential => (rule::expressions::EXPONENTIAL, math::exponential(argument)),
        Function::Logarithm => (rule::expressions::EXPONENTIAL, math::logarithm(argument)),
        Function::SquareRoot => (rule::expressions::SQUARE_ROOT, argument.sqrt()),
        Function::RoundDown => (rule::expressions::ROUNDING_FUNCTIONS, argument.floor()),
        Function::RoundUp => (rule::expressions::ROUNDING_FUNCTIONS, argument.ceil()),
        Function::Round => {
            let rounded = round(argument, &state.choices);
            (
                rule::expressions::ROUNDING_FUNCTIONS,
                state.dialect().sign_of_rounded(rounded, &state.choices),
            )
        }
    };
    if !value.is_finite() {
        let message = outside_of_domain(function, argument);
        return Err(refuse(rule::expressions::DOMAIN, FaultKind::OutOfDomain, message));
    }
    state.coverage.accepted(rule);
    Ok(value)
}

/// The message about an argument of which a function has no finite value.
fn outside_of_domain(function: Function, argument: f64) -> String {
    match function {
        Function::ArcSine => format!("ASIN needs a number from -1 to 1: found {argument}"),
        Function::ArcCosine => format!("ACOS needs a number from -1 to 1: found {argument}"),
        Function::Logarithm => format!("LN needs a number above zero: found {argument}"),
        Function::SquareRoot => format!("SQRT needs a number not below zero: found {argument}"),
        Function::Exponential => format!("EXP of {argument} is larger than any number"),
        Function::Absolute
        | Function::Cosine
        | Function::RoundDown
        | Function::RoundUp
        | Function::Round
        | Function::Sine
        | Function::Tangent => format!("{argument} is beyond what its function takes"),
    }
}

/// Choice expressions.round-half: away from zero, to the greater one, or to the even one.
fn round(number: f64, choices: &Choices) -> f64 {
    match choices.get::<RoundHalf>() {
        RoundHalf::Up if is_half(number) => number.ceil(),
        RoundHalf::Even => number.round_ties_even(),
        RoundHalf::Up | RoundHalf::Away => number.round(),
    }
}

fn is_half(number: f64) -> bool {
    is_zero((number - number.floor()) - 0.5)
}

/// Whether a number is zero, of either sign.
fn is_zero(number: f64) -> bool {
    number == 0.0
}
