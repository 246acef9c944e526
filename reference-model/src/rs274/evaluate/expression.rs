//! The value of an expression.

use gaugeblock_vocabulary::FaultKind;

use super::operate::{function, operate};
use crate::ids::{choice, rule};
use crate::math;
use crate::rs274::parameters::{self, Name};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::{Expression, Parameter};

/// The value of an expression: a finite number.
///
/// # Errors
/// It has none: a division by zero, an argument outside a function's domain, a parameter that does not exist.
pub fn value_of(expression: &Expression, state: &mut State) -> Result<f64, StepError> {
    match expression {
        Expression::Number(number) => Ok(*number),
        Expression::Parameter(parameter) => {
            let name = name(parameter, state)?;
            parameter_value(&name, state)
        }
        Expression::Negate(inner) => Ok(-value_of(inner, state)?),
        Expression::Function(name, argument) => {
            let argument = value_of(argument, state)?;
            function(*name, argument, state)
        }
        Expression::ArcTangent(opposite, adjacent) => {
            let opposite = value_of(opposite, state)?;
            let adjacent = value_of(adjacent, state)?;
            Ok(arc_tangent(opposite, adjacent, state))
        }
        Expression::Exists(parameter) => exists(parameter, state),
        Expression::Binary(operator, left, right) => {
            let left = value_of(left, state)?;
            let right = value_of(right, state)?;
            operate(*operator, left, right, state)
        }
    }
}

/// Which parameter is meant.
///
/// Rule parameters.range. The number of a parameter is an integer from 1 to 5602.
/// Rule parameters.greatest. Whether there are parameters above 5399 is a choice.
/// Rule parameters.index-integer. The number of a parameter must be close to an integer.
pub(super) fn name(parameter: &Parameter, state: &mut State) -> Result<Name, StepError> {
    let number = match parameter {
        Parameter::Named(name) => return Ok(Name::Named(name.clone())),
        Parameter::Numbered(number) => number,
    };
    let indirect = !matches!(**number, Expression::Number(_));
    let value = value_of(number, state)?;
    let Some(number) = math::near_integer(value) else {
        state.coverage.refused(rule::numbers::NOT_NEAR_INTEGER);
        if indirect {
            state.coverage.refused(rule::parameters::INDIRECT);
        }
        let message = format!("the number of a parameter is an integer, not {value}");
        return Err(refuse(
            rule::parameters::INDEX_INTEGER,
            FaultKind::ParameterNotInteger,
            message,
        ));
    };
    let last = parameters::last(&state.choices);
    match u32::try_from(number) {
        Ok(number) if (1..=last).contains(&number) => {
            state.coverage.accepted(rule::parameters::RANGE);
            state.coverage.accepted(rule::parameters::GREATEST);
            state.coverage.accepted(rule::parameters::INDEX_INTEGER);
            state.coverage.accepted(rule::numbers::NEAR_INTEGER);
            Ok(Name::Numbered(number))
        }
        _ => {
            let message = format!("there is no parameter {number}");
            // Those that are only missing by a choice.
            let rule = match number {
                5400..=5602 => rule::parameters::GREATEST,
                _ => rule::parameters::RANGE,
            };
            Err(refuse(rule, FaultKind::ParameterOutOfRange, message))
        }
    }
}

fn parameter_value(name: &Name, state: &mut State) -> Result<f64, StepError> {
    state.dialect().check_readable(name, state)?;
    let value = parameters::value(name, state);
    match &value {
        Ok(_) => parameters::rules_of(name, state)
            .into_iter()
            .for_each(|rule| state.coverage.accepted(rule)),
        Err(_) => parameters::refused_too(name, state)
            .into_iter()
            .for_each(|rule| state.coverage.refused(rule)),
    }
    value
}

/// Rule expressions.exists. EXISTS is 1 when the named parameter exists and 0 when it does not.
fn exists(parameter: &Parameter, state: &mut State) -> Result<f64, StepError> {
    let name = name(parameter, state)?;
    let exists = parameters::exists(&name, state);
    state.coverage.accepted(rule::expressions::EXISTS);
    parameters::rules_of_existence(&name, state)
        .into_iter()
        .for_each(|rule| state.coverage.accepted(rule));
    Ok(f64::from(u8::from(exists)))
}

/// Rule expressions.arctangent. ATAN distinguishes all four quadrants.
/// Choice expressions.arctangent-range: above -180 up to 180 degrees, or from 0 to below 360.
/// Choice expressions.negative-zero: whether a zero has a sign, which selects a quadrant.
fn arc_tangent(opposite: f64, adjacent: f64, state: &mut State) -> f64 {
    state.coverage.accepted(rule::expressions::ARCTANGENT);
    state.coverage.accepted(rule::expressions::ANGLES);
    let angle = if state.choices.is(choice::expressions::NegativeZero::Kept) {
        math::degrees_of_signed(opposite, adjacent)
    } else {
        math::degrees_of(opposite, adjacent)
    };
    if angle < 0.0 && state.choices.is(choice::expressions::ArctangentRange::FullTurn) {
        return angle + 360.0;
    }
    angle
}
