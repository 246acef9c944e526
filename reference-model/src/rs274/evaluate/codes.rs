//! The numbers of G and M codes.

use gaugeblock_vocabulary::FaultKind;

use crate::ids::{Rule, choice, rule};
use crate::math;
use crate::rs274::modes;
use crate::rs274::refusal::{StepError, refuse_at};
use crate::rs274::state::State;
use crate::rs274::syntax::{Expression, Word};

/// Ten times the number of a G code.
pub(super) fn g_code(word: &Word, value: f64, state: &mut State) -> Result<u32, StepError> {
    let range = rule::modal_groups::G_CODE_OUT_OF_RANGE;
    let number = if counts_hundredths(state) {
        by_hundredths(word, value, range, state)?
    } else {
        code(word, value * 10.0, range, state)?
    };
    if is_computed(word) && modes::g_code(number).is_none() {
        state.coverage.refused(rule::modal_groups::CODE_FROM_EXPRESSION);
    }
    Ok(number)
}

/// The number of an M code.
pub(super) fn m_code(word: &Word, value: f64, state: &mut State) -> Result<u32, StepError> {
    let range = rule::modal_groups::M_CODE_OUT_OF_RANGE;
    if counts_hundredths(state) {
        by_hundredths(word, value, range, state)
    } else {
        code(word, value, range, state)
    }
}

/// Rule modal-groups.code-decimals. How far a number can be from that of a code of the language is a choice.
fn counts_hundredths(state: &State) -> bool {
    state.choices.is(choice::modal_groups::CodeDecimals::Hundredths)
}

/// The number of a code whose decimals are rounded to hundredths, ten times that of a G code.
///
/// Rule modal-groups.code-decimals. Decimals that round to zero hundredths do not count; others make another code of
/// it, or none.
fn by_hundredths(
    word: &Word,
    value: f64,
    range: Rule,
    state: &mut State,
) -> Result<u32, StepError> {
    let whole = value.trunc();
    let hundredths = (100.0 * (value - whole)).round();
    let whole = math::near_integer(whole).unwrap_or(i64::MAX);
    let hundredths = math::near_integer(hundredths).unwrap_or(i64::MAX);
    let parts = (whole, hundredths);
    let (whole, hundredths) = state.dialect().parts_of_code(word.letter, parts, &state.choices);
    let is_g = word.letter == 'g';
    let is_code = hundredths == 0 || is_g && has_hundredths(whole, hundredths);
    let letter = word.letter.to_ascii_uppercase();
    if !is_code {
        let message = format!("there is no {letter}{value}");
        let rule = rule::modal_groups::CODE_DECIMALS;
        return Err(refuse_at(rule, FaultKind::UnknownCode, word.span, message));
    }
    if whole < 0 {
        let message = format!("the number after {letter} is below zero");
        return Err(refuse_at(range, FaultKind::UnknownCode, word.span, message));
    }
    state.coverage.accepted(rule::modal_groups::CODE_DECIMALS);
    let number = if is_g { whole.saturating_mul(10) + hundredths / 10 } else { whole };
    Ok(u32::try_from(number).unwrap_or(u32::MAX))
}

/// Whether there is a G code with this whole part and these hundredths.
fn has_hundredths(whole: i64, hundredths: i64) -> bool {
    match whole {
        28 | 30 | 43 | 91 | 92 => hundredths == 10,
        38 => [20, 30, 40, 50].contains(&hundredths),
        _ => false,
    }
}

/// Rules numbers.near-integer, numbers.not-near-integer and modal-groups.code-close-to-integer. An M number, and ten
/// times a G number, must lie within 0.0001 of an integer.
/// Rule modal-groups.code-from-expression. The number of a code may be an expression.
///
/// A code below zero is out of range; whether any other one exists is a matter of the table of codes.
fn code(word: &Word, value: f64, range: Rule, state: &mut State) -> Result<u32, StepError> {
    let letter = word.letter.to_ascii_uppercase();
    let g_code = range == rule::modal_groups::G_CODE_OUT_OF_RANGE;
    let near = if g_code {
        state.dialect().g_code_number(value, &state.choices)
    } else {
        math::near_integer(value)
    };
    let Some(number) = near else {
        state.coverage.refused(rule::modal_groups::CODE_CLOSE_TO_INTEGER);
        state.coverage.refused(rule::modal_groups::CODE_DECIMALS);
        let message = format!("no integer is close enough to the number after {letter}");
        return Err(refuse_at(
            rule::numbers::NOT_NEAR_INTEGER,
            FaultKind::NotAnInteger,
            word.span,
            message,
        ));
    };
    if number < 0 {
        let message = format!("the number after {letter} is below zero");
        return Err(refuse_at(range, FaultKind::UnknownCode, word.span, message));
    }
    state.coverage.accepted(rule::numbers::NEAR_INTEGER);
    state.coverage.accepted(rule::modal_groups::CODE_CLOSE_TO_INTEGER);
    if is_computed(word) {
        state.coverage.accepted(rule::modal_groups::CODE_FROM_EXPRESSION);
    }
    Ok(u32::try_from(number).unwrap_or(u32::MAX))
}

fn is_computed(word: &Word) -> bool {
    !matches!(word.value, Expression::Number(_))
}
