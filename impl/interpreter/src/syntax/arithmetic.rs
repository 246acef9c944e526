//! Operators and functions on numbers (11.4.6 to 11.4.8).

use alloc::vec::Vec;

use gaugeblock_vocabulary::FaultKind;

use crate::faults::{PlantedFault, planted};
use crate::math;
use crate::quirks;
use crate::syntax::bytecode::{Binary, Function, Op};
use crate::syntax::{Choices, RoundHalf};

/// Why there is no result.
pub(crate) type ArithmeticError = &'static (FaultKind, &'static str);

/// A result that must be finite.
#[inline]
fn finite(value: f64) -> Result<f64, ArithmeticError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(&(FaultKind::OutOfDomain, "the result is not a number"))
    }
}

/// The number for true and false.
#[inline]
pub(crate) fn truth(value: bool, choices: &Choices) -> f64 {
    match (value, choices.true_minus_one) {
        (false, _) => 0.0,
        (true, false) => 1.0,
        (true, true) => -1.0,
    }
}

/// Whether two numbers count as equal.
#[inline]
fn equal(left: f64, right: f64) -> bool {
    if planted(PlantedFault::EqualExactly) {
        return !holds(left - right);
    }
    (left - right).abs() < math::CLOSE
}

/// Whether two numbers that are compared by order count as equal.
#[inline]
fn tied(left: f64, right: f64, choices: &Choices) -> bool {
    choices.order_tolerant && equal(left, right)
}

/// Zero is false, every other number is true.
#[inline]
fn holds(value: f64) -> bool {
    value.to_bits() << 1 != 0
}

/// The result of an operator.
#[inline(never)]
pub(crate) fn binary(
    operator: Binary,
    left: f64,
    right: f64,
    choices: &Choices,
) -> Result<f64, ArithmeticError> {
    binary_inline(operator, left, right, choices)
}

/// The same as [`binary`], inlined where most expressions are evaluated: a call would cost more than most operators.
#[inline(always)]
#[expect(clippy::inline_always, reason = "the compiler decides by what else there is in the crate")]
pub(crate) fn binary_inline(
    operator: Binary,
    left: f64,
    right: f64,
    choices: &Choices,
) -> Result<f64, ArithmeticError> {
    match operator {
        Binary::Add => finite(left + right),
        Binary::Subtract => finite(left - right),
        Binary::Multiply => finite(left * right),
        Binary::Divide if !holds(right) && planted(PlantedFault::DivideByZero) => Ok(0.0),
        Binary::Divide if !holds(right) => Err(&(FaultKind::DivideByZero, "division by zero")),
        Binary::Divide => finite(left / right),
        Binary::Modulus => modulus(left, right, choices),
        Binary::Power => power(left, right),
        Binary::And => Ok(truth(holds(left) && holds(right), choices)),
        Binary::Or if planted(PlantedFault::OrOnIntegers) => {
            Ok(truth(holds(math::truncate(left)) || holds(math::truncate(right)), choices))
        }
        Binary::Or => Ok(truth(holds(left) || holds(right), choices)),
        Binary::Xor if planted(PlantedFault::XorAsOr) => {
            Ok(truth(holds(left) || holds(right), choices))
        }
        Binary::Xor => Ok(truth(holds(left) != holds(right), choices)),
        Binary::Equal => Ok(truth(equal(left, right), choices)),
        Binary::NotEqual => Ok(truth(!equal(left, right), choices)),
        Binary::Greater => Ok(truth(left > right && !tied(left, right, choices), choices)),
        Binary::GreaterOrEqual => Ok(truth(left >= right || tied(left, right, choices), choices)),
        Binary::Less => Ok(truth(left < right && !tied(left, right, choices), choices)),
        Binary::LessOrEqual => Ok(truth(left <= right || tied(left, right, choices), choices)),
    }
}

/// MOD, on any real numbers.
fn modulus(left: f64, right: f64, choices: &Choices) -> Result<f64, ArithmeticError> {
    if !holds(right) && planted(PlantedFault::ModulusByZero) {
        return Ok(left);
    }
    if !holds(right) {
        return Err(&(FaultKind::DivideByZero, "modulus by zero"));
    }
    let rest = math::remainder(left, right);
    let dividend = choices.modulus_dividend || planted(PlantedFault::ModulusSign);
    finite(if rest < 0.0 && !dividend { rest + right.abs() } else { rest })
}

/// `**`.
fn power(base: f64, exponent: f64) -> Result<f64, ArithmeticError> {
    if !holds(base) && exponent < 0.0 && planted(PlantedFault::PowerOfZero) {
        return Ok(0.0);
    }
    if !holds(base) && exponent < 0.0 {
        return Err(&(FaultKind::DivideByZero, "a negative power of zero"));
    }
    finite(math::power(base, exponent))
}

/// The result of a function.
#[inline]
pub(crate) fn function(
    function: Function,
    value: f64,
    choices: &Choices,
) -> Result<f64, ArithmeticError> {
    if choices.emulates_rs274
        && let Some(value) = emulated(function, value)
    {
        return finite(value);
    }
    let domain = |holds: bool, wrong: ArithmeticError| if holds { Ok(()) } else { Err(wrong) };
    finite(match function {
        Function::Absolute => value.abs(),
        Function::Arccosine => {
            domain(
                (-1.0..=1.0).contains(&value),
                &(FaultKind::OutOfDomain, "ACOS of a number beyond 1"),
            )?;
            math::arccosine(value)
        }
        Function::Arcsine => {
            domain(
                (-1.0..=1.0).contains(&value),
                &(FaultKind::OutOfDomain, "ASIN of a number beyond 1"),
            )?;
            math::arcsine(value)
        }
        Function::Cosine => math::cosine(value),
        Function::Exponential => math::exp(value),
        Function::RoundDown if planted(PlantedFault::FixTowardZero) && value < 0.0 => {
            math::ceil(value)
        }
        Function::RoundDown => math::floor(value),
        Function::RoundUp => math::ceil(value),
        Function::Round => match choices.round_half {
            RoundHalf::Away => math::round_away(value),
            RoundHalf::Even => math::round_even(value),
            RoundHalf::Up => {
                let below = math::floor(value);
                // What rounds up to zero from below is a zero below zero.
                let rounded = if value - below >= 0.5 { below + 1.0 } else { below };
                rounded.copysign(value)
            }
        },
        Function::Logarithm => {
            domain(value > 0.0, &(FaultKind::OutOfDomain, "LN of a number that is not positive"))?;
            math::ln(value)
        }
        Function::Sine => math::sine(value),
        Function::SquareRoot => {
            domain(value >= 0.0, &(FaultKind::OutOfDomain, "SQRT of a negative number"))?;
            math::sqrt(value)
        }
        Function::Tangent => math::tangent(value),
    })
}

/// The result of a function as `rs274` computes it, where that differs.
#[cold]
fn emulated(function: Function, value: f64) -> Option<f64> {
    match function {
        Function::Absolute if value == 0.0 => Some(value),
        Function::Round => Some(quirks::rounded(math::round_away(value))),
        Function::Sine => quirks::sine(value),
        Function::Cosine => quirks::cosine(value),
        Function::Tangent => quirks::tangent(value),
        Function::Absolute
        | Function::Arccosine
        | Function::Arcsine
        | Function::Exponential
        | Function::RoundDown
        | Function::RoundUp
        | Function::Logarithm
        | Function::SquareRoot => None,
    }
}

/// The value of operations that depend on nothing; none where they depend on something, or do not give one value.
pub(crate) fn constant(ops: &[Op], choices: &Choices) -> Option<Result<f64, ArithmeticError>> {
    let mut stack: Vec<f64> = Vec::new();
    for op in ops {
        #[expect(clippy::wildcard_enum_match_arm, reason = "the others depend on something")]
        let value = match *op {
            Op::Number(value) => Ok(value),
            Op::Negate => Ok(-stack.pop()?),
            Op::Function(name) => function(name, stack.pop()?, choices),
            Op::BinaryNumber(operator, right) => binary(operator, stack.pop()?, right, choices),
            Op::Binary(operator) => {
                let right = stack.pop()?;
                binary(operator, stack.pop()?, right, choices)
            }
            Op::Arctangent => {
                let x = stack.pop()?;
                Ok(arctangent(stack.pop()?, x, choices))
            }
            _ => return None,
        };
        match value {
            Ok(value) => stack.push(value),
            Err(wrong) => return Some(Err(wrong)),
        }
    }
    match stack.as_slice() {
        [value] => Some(Ok(*value)),
        [] | [_, _, ..] => None,
    }
}

/// ATAN\[y\]/\[x\], degrees.
pub(crate) fn arctangent(y: f64, x: f64, choices: &Choices) -> f64 {
    let (y, x) = if planted(PlantedFault::ArctangentSwapped) { (x, y) } else { (y, x) };
    // Adding zero takes the sign from a zero.
    let (y, x) = if choices.zero_signed { (y, x) } else { (y + 0.0, x + 0.0) };
    let angle = math::arctangent(y, x);
    if choices.full_turn && angle < 0.0 { angle + 360.0 } else { angle }
}
