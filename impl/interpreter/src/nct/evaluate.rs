//! Values, variables and conditions, evaluated.

use alloc::vec::Vec;

use gaugeblock_vocabulary::FaultKind;

use super::choices::Choices;
use super::program::{
    Bits, Code, Compare, Condition, Function, Operation, Operator, Slot, Stop, Target, Value,
    refuse, slot,
};
use super::variables::Variables;
use crate::faults::{PlantedFault, planted};
use crate::index_range::IndexRange;
use crate::math;

/// Operands that wait.
pub(super) type Stack = Vec<Option<f64>>;

/// Evaluates expressions while a program runs.
#[derive(Clone, Copy)]
pub(super) struct Evaluator<'a> {
    pub(super) code: &'a Code,
    pub(super) variables: &'a Variables,
    pub(super) choices: Choices,
}

impl Evaluator<'_> {
    /// A value; nothing where it is vacant.
    #[inline]
    pub(super) fn value(&self, value: Value, stack: &mut Stack) -> Result<Option<f64>, Stop> {
        match value {
            Value::Number(number) => Ok(Some(number)),
            Value::Variable(slot) => Ok(self.variables.get(slot)),
            Value::Expression(part) => self.expression(part, stack),
        }
    }

    /// The variable that is assigned, or the refusal of a number that none has, which comes after what is assigned.
    pub(super) fn target(
        &self,
        target: Target,
        stack: &mut Stack,
    ) -> Result<Result<Slot, Stop>, Stop> {
        match target {
            Target::Variable(slot) => Ok(Ok(slot)),
            Target::Indirect(part) => match slot(self.expression(part, stack)?) {
                Err(Stop::Open(why)) => Err(Stop::Open(why)),
                found => Ok(found),
            },
        }
    }

    /// Whether a condition holds.
    pub(super) fn holds(&self, condition: Condition, stack: &mut Stack) -> Result<bool, Stop> {
        let left = self.value(condition.left, stack)?;
        let right = self.value(condition.right, stack)?;
        let (left, right) = match (left, right) {
            (Some(left), Some(right)) => (left, right),
            (left, right) if planted(PlantedFault::VacantIsZero) => {
                (left.unwrap_or(0.0), right.unwrap_or(0.0))
            }
            (left, right) => return vacant(left, condition.compare, right),
        };
        // Values are finite.
        Ok(left.partial_cmp(&right).is_some_and(|order| condition.compare.says(order)))
    }

    fn expression(&self, part: IndexRange, stack: &mut Stack) -> Result<Option<f64>, Stop> {
        stack.clear();
        for operation in part.of(&self.code.operations) {
            let value = match *operation {
                Operation::Number(number) => Some(number),
                Operation::Variable(slot) => self.variables.get(slot),
                Operation::Indirect => self.variables.get(slot(stack.pop().flatten())?),
                Operation::Plus => Some(number(stack)),
                Operation::Minus => Some(-number(stack)),
                Operation::One(function) => Some(self.function(function, number(stack))?),
                Operation::Two(operator) => {
                    let right = number(stack);
                    Some(self.operate(operator, number(stack), right)?)
                }
            };
            stack.push(value);
        }
        Ok(stack.pop().flatten())
    }

    fn function(&self, function: Function, operand: f64) -> Result<f64, Stop> {
        let radians = self.choices.radians;
        let to = |degrees: f64| if radians { degrees.to_radians() } else { degrees };
        finite(match function {
            Function::Cos if radians => math::cosine_of_radians(operand),
            Function::Cos => math::cosine(operand),
            Function::Sin if radians => math::sine_of_radians(operand),
            Function::Sin => math::sine(operand),
            Function::Tan if radians => math::tangent_of_radians(operand),
            Function::Tan => math::tangent(operand),
            Function::Asin => to(math::arcsine(operand)),
            Function::Acos => to(math::arccosine(operand)),
            Function::Atan => to(math::arctangent(operand, 1.0)),
            Function::Sqrt => math::sqrt(operand),
            Function::Abs => operand.abs(),
            Function::Round => math::round_away(operand),
            Function::Fix if self.choices.floor_and_ceiling => math::floor(operand),
            Function::Fix => math::truncate(operand),
            Function::Fup if self.choices.floor_and_ceiling || operand > 0.0 => math::ceil(operand),
            Function::Fup => math::floor(operand),
            Function::Ln => math::ln(operand),
            Function::Exp => math::exp(operand),
            Function::Not => {
                let all = if self.choices.unsigned { 4_294_967_295.0 } else { -1.0 };
                return self.bits(operand, all, Bits::Xor);
            }
        })
    }

    fn operate(&self, operator: Operator, left: f64, right: f64) -> Result<f64, Stop> {
        let is_zero = right.abs() <= 0.0;
        finite(match operator {
            Operator::Add => left + right,
            Operator::Subtract => left - right,
            Operator::Multiply => left * right,
            Operator::Divide | Operator::Modulus if is_zero => {
                return refuse(FaultKind::DivideByZero, "a division by zero");
            }
            Operator::Divide => left / right,
            Operator::Modulus => math::remainder(left, right),
            Operator::Bits(operator) => return self.bits(left, right, operator),
        })
    }

    /// An operation on 32 bits.
    fn bits(&self, left: f64, right: f64, operator: Bits) -> Result<f64, Stop> {
        let range =
            if self.choices.unsigned { 0..=0xffff_ffff } else { -0x8000_0000..=0x7fff_ffff };
        let word = |number: f64| {
            let whole = math::whole(math::round_away(number));
            match whole.filter(|whole| range.contains(whole)) {
                Some(whole) => Ok(whole),
                None => refuse(FaultKind::OutOfDomain, "3091 ERRONEOUS OPERATION WITH #"),
            }
        };
        let (left, right) = (word(left)?, word(right)?);
        let bits = match operator {
            Bits::And => left & right,
            Bits::Or => left | right,
            Bits::Xor => left ^ right,
        };
        Ok(math::from_i64(bits))
    }
}

/// The operand that comes last; what is vacant is zero.
fn number(stack: &mut Stack) -> f64 {
    stack.pop().flatten().unwrap_or(0.0)
}

fn finite(result: f64) -> Result<f64, Stop> {
    if result.is_finite() {
        return Ok(result);
    }
    refuse(FaultKind::OutOfDomain, "the result is not a number, or too large")
}

/// A comparison with a vacant side: vacant is equal to vacant alone, and zero is below it.
fn vacant(left: Option<f64>, compare: Compare, right: Option<f64>) -> Result<bool, Stop> {
    let is_ordered = !matches!(compare, Compare::Equal | Compare::NotEqual);
    let has_value = left.or(right).is_some_and(|number| number.abs() > 0.0);
    if is_ordered && has_value || matches!(compare, Compare::Less | Compare::LessOrEqual) {
        return Err(Stop::Open("a comparison with a vacant value that no table has"));
    }
    Ok(compare.says(left.is_none().cmp(&right.is_none())))
}
