//! Reads values, numbers of programs and counts for the quirks of subroutines and loops.

use gaugeblock_vocabulary::FaultKind;

use super::HasQuirk;
use crate::dialects::quirk;
use crate::ids::rule;
use crate::rs274::control::{Control, Place};
use crate::rs274::evaluate;
use crate::rs274::parameters::{self, Name};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::{self, Expression, Parameter};

/// The number that single precision holds.
pub(super) fn in_single_precision(number: f64) -> f64 {
    #[expect(clippy::cast_possible_truncation, reason = "the loss is what was observed")]
    let single = number as f32;
    f64::from(single)
}

/// The value after an endsub or a return. The rest of the block is not read.
pub(super) fn value_after(text: &str, state: &mut State) -> Result<Option<Expression>, StepError> {
    let word = match syntax::parse(text, state) {
        Ok(block) => block.o_word,
        Err(StepError::Refused(refusal)) if refusal.rule == rule::control::UNRELATED_WORDS => {
            syntax::o_word_of(text, state)
        }
        Err(error) => return Err(error),
    };
    Ok(word.and_then(|word| word.arguments.into_iter().next()))
}

/// Sets the value parameters as if a sub had returned this value.
pub(super) fn set_returned(value: Option<&Expression>, state: &mut State) -> Result<(), StepError> {
    let value = value.map(|value| evaluate::value_of(value, state)).transpose()?;
    state.parameters.returned = value.unwrap_or(0.0);
    state.parameters.has_returned = value.is_some();
    Ok(())
}

/// An expression with zero for each named parameter that does not exist.
pub(super) fn with_zeros(expression: &Expression, state: &State) -> Expression {
    let inside = |inner: &Expression| Box::new(with_zeros(inner, state));
    match expression {
        Expression::Parameter(Parameter::Named(name))
            if !parameters::exists(&Name::Named(name.clone()), state) =>
        {
            Expression::Number(0.0)
        }
        Expression::Parameter(Parameter::Numbered(number)) => {
            Expression::Parameter(Parameter::Numbered(inside(number)))
        }
        Expression::Negate(inner) => Expression::Negate(inside(inner)),
        Expression::Function(function, inner) => Expression::Function(*function, inside(inner)),
        Expression::ArcTangent(y, x) => Expression::ArcTangent(inside(y), inside(x)),
        Expression::Binary(operator, left, right) => {
            Expression::Binary(*operator, inside(left), inside(right))
        }
        Expression::Number(_)
        | Expression::Parameter(Parameter::Named(_))
        | Expression::Exists(_) => expression.clone(),
    }
}

/// Quirk rs274.numbers-of-all-files. The numbered program of this number that was called first, in any file.
pub(super) fn known_number(control: &Control, label: &str, state: &State) -> Option<Place> {
    let first = control.memory.numbers_called.get(label).copied();
    first.filter(|_| state.has_quirk(quirk::rs274::NUMBERS_OF_ALL_FILES))
}

/// Quirk rs274.fanuc-count-too-large. L of M98 is refused from 2147483648 on, like a negative L.
pub(super) fn count_too_large(turns: f64, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::FANUC_COUNT_TOO_LARGE;
    if turns.round() > f64::from(i32::MAX) && state.has_quirk(rule) {
        return Err(refuse(rule, FaultKind::WordOutOfRange, "L of M98 is too large"));
    }
    Ok(())
}
