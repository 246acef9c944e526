//! Operators and functions.

use gaugeblock_vocabulary::FaultKind;

use crate::math;
use crate::rs274::choices::Choices;
use crate::rs274::quirks::text as quirks;
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
        Operator::Power => ("expressions.power", power(left, right)?),
        Operator::Divide => ("expressions.arithmetic", divide(left, right)?),
        Operator::Modulus => ("expressions.modulus", modulus(left, right, choices)?),
        Operator::Multiply => ("expressions.arithmetic", left * right),
        Operator::Add => ("expressions.arithmetic", left + right),
        Operator::Subtract => ("expressions.arithmetic", left - right),
        Operator::Equal => ("expressions.tolerance", truth(equal(left, right), choices)),
        Operator::NotEqual => ("expressions.tolerance", truth(!equal(left, right), choices)),
        Operator::Greater => {
            ("expressions.relational", truth(greater(left, right, choices), choices))
        }
        Operator::Less => ("expressions.relational", truth(greater(right, left, choices), choices)),
        Operator::GreaterOrEqual => {
            ("expressions.relational", truth(!greater(right, left, choices), choices))
        }
        Operator::LessOrEqual => {
            ("expressions.relational", truth(!greater(left, right, choices), choices))
        }
        Operator::And => ("expressions.logical", truth(!is_zero(left) && !is_zero(right), choices)),
        Operator::Or => ("expressions.logical", truth(!is_zero(left) || !is_zero(right), choices)),
        Operator::ExclusiveOr => {
            ("expressions.logical", truth(is_zero(left) != is_zero(right), choices))
        }
    };
    if !value.is_finite() {
        let message = format!("the result of an operation on {left} and {right} is too great");
        return Err(refuse("expressions.domain", FaultKind::OutOfDomain, message));
    }
    state.coverage.accepted(rule);
    if rule == "expressions.tolerance" {
        state.coverage.accepted("expressions.relational");
    }
    Ok(value)
}

/// Rule expressions.division-by-zero. A division by zero gives no number and is refused.
fn divide(left: f64, right: f64) -> Result<f64, StepError> {
    if is_zero(right) {
        let message = format!("{left} is divided by zero");
        return Err(refuse("expressions.division-by-zero", FaultKind::DivideByZero, message));
    }
    Ok(left / right)
}

/// Rule expressions.modulus. MOD gives the remainder of a division of any real numbers.
/// Rule expressions.modulus-zero. A modulus of zero gives no number and is refused.
/// Choice expressions.modulus-sign: never negative, or with the sign of the number on the left.
fn modulus(left: f64, right: f64, choices: &Choices) -> Result<f64, StepError> {
    if is_zero(right) {
        let message = format!("the remainder of {left} by zero is no number");
        return Err(refuse("expressions.modulus-zero", FaultKind::DivideByZero, message));
    }
    if choices.is("expressions.modulus-sign", "dividend") {
        return Ok(left % right);
    }
    Ok(left.rem_euclid(right))
}

/// Rule expressions.power. Two asterisks raise the number on the left to the power on the right.
/// Rule expressions.power-domain. A power that is no real number is refused.
fn power(base: f64, exponent: f64) -> Result<f64, StepError> {
    let value = math::power(base, exponent);
    if !value.is_finite() {
        let message = format!("{base} to the power {exponent} is no real number");
        return Err(refuse("expressions.power-domain", FaultKind::OutOfDomain, message));
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
    left > right && !(choices.is("expressions.order-tolerance", "tolerant") && equal(left, right))
}

/// Choice expressions.true-value: what a true comparison gives.
fn truth(holds: bool, choices: &Choices) -> f64 {
    match (holds, choices.choice("expressions.true-value")) {
        (false, _) => 0.0,
        (true, "minus-one") => -1.0,
        (true, _) => 1.0,
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
        Function::Absolute => ("expressions.absolute", quirks::absolute(argument, &state.choices)),
        Function::Sine => ("expressions.angles", math::sine_of_degrees(argument)),
        Function::Cosine => ("expressions.angles", math::cosine_of_degrees(argument)),
        Function::Tangent => ("expressions.angles", math::tangent_of_degrees(argument)),
        Function::ArcSine => ("expressions.angles", math::degrees_of_sine(argument)),
        Function::ArcCosine => ("expressions.angles", math::degrees_of_cosine(argument)),
        Function::Exponential => ("expressions.exponential", math::exponential(argument)),
        Function::Logarithm => ("expressions.exponential", math::logarithm(argument)),
        Function::SquareRoot => ("expressions.square-root", argument.sqrt()),
        Function::RoundDown => ("expressions.rounding-functions", argument.floor()),
        Function::RoundUp => ("expressions.rounding-functions", argument.ceil()),
        Function::Round => {
            let rounded = round(argument, &state.choices);
            ("expressions.rounding-functions", quirks::rounded(rounded, &state.choices))
        }
    };
    if !value.is_finite() {
        let message = format!("{argument} lies outside of the domain of its function");
        return Err(refuse("expressions.domain", FaultKind::OutOfDomain, message));
    }
    state.coverage.accepted(rule);
    Ok(value)
}

/// Choice expressions.round-half: away from zero, to the greater one, or to the even one.
fn round(number: f64, choices: &Choices) -> f64 {
    match choices.choice("expressions.round-half") {
        "up" if is_half(number) => number.ceil(),
        "even" => number.round_ties_even(),
        _ => number.round(),
    }
}

fn is_half(number: f64) -> bool {
    is_zero((number - number.floor()) - 0.5)
}

/// Whether a number is zero, of either sign.
fn is_zero(number: f64) -> bool {
    number == 0.0
}
