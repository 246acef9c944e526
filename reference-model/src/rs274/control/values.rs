//! The label and the values of an O-word, evaluated.

use gaugeblock_vocabulary::FaultKind;

use crate::ids::{Rule, rule};
use crate::math;
use crate::rs274::evaluate;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::{Expression, Label};

/// Rule subroutines.computed-o-words. The number after O can be given by a parameter or an expression.
///
/// Rules subroutines.numbered-o-words, subroutines.named-o-words. A number close to an integer is that integer; a name
/// is in lower case.
pub(crate) fn label_of(label: &Label, state: &mut State) -> Result<String, StepError> {
    match label {
        Label::Name(name) => {
            state.coverage.accepted(rule::subroutines::NAMED_O_WORDS);
            Ok(name.clone())
        }
        Label::Number(Expression::Number(number)) => {
            state.coverage.accepted(rule::subroutines::NUMBERED_O_WORDS);
            whole(*number)
        }
        Label::Number(expression) => {
            let number = evaluated(rule::subroutines::COMPUTED_O_WORDS, expression, state)?;
            state.coverage.accepted(rule::subroutines::COMPUTED_O_WORDS);
            whole(number)
        }
    }
}

/// A label as it is written, for messages: `o100`, `o<cave>`.
pub(crate) fn o_word(label: &str) -> String {
    if label.parse::<i64>().is_ok() { format!("o{label}") } else { format!("o<{label}>") }
}

/// A number close to an integer, as a label.
fn whole(number: f64) -> Result<String, StepError> {
    match math::near_integer(number) {
        // The number may be larger than an i64.
        Some(i64::MIN | i64::MAX) => Ok(format!("{number:.0}")),
        Some(label) => Ok(label.to_string()),
        None => {
            let message = format!("{number} after O is not an integer");
            Err(refuse(rule::subroutines::COMPUTED_O_WORDS, FaultKind::NotAnInteger, message))
        }
    }
}

/// Evaluates an expression for a rule. If the expression is refused, coverage counts that as a refusal by the rule.
pub(super) fn evaluated(
    rule: Rule,
    expression: &Expression,
    state: &mut State,
) -> Result<f64, StepError> {
    let value = evaluate::value_of(expression, state);
    if let Err(StepError::Refused(_)) = value {
        state.coverage.refused(rule);
    }
    value
}

/// The one value that a keyword needs: a condition, a count.
pub(super) fn single(
    rule: Rule,
    values: &[Expression],
    state: &mut State,
) -> Result<f64, StepError> {
    match values {
        [value] => evaluated(rule, value, state),
        [] | [_, _, ..] => {
            let message = format!("one value belongs here, not {}", values.len());
            Err(refuse(rule, FaultKind::BadBlock, message))
        }
    }
}

/// Rule control.truth. A condition is false when it is zero and true for every other number.
pub(super) fn condition(
    rule: Rule,
    values: &[Expression],
    state: &mut State,
) -> Result<bool, StepError> {
    let value = single(rule, values, state)?;
    state.coverage.accepted(rule::control::TRUTH);
    state.coverage.accepted(rule);
    Ok(value.abs() > 0.0)
}
