//! Quirks of reading text, words, parameters and comments.
//!
//! Some have nothing of their own and stand where they are decided: rs274.lone-return (`text`), rs274.repeated-signs
//! and rs274.exists-numbered (`syntax`), rs274.hal-assignment (`parameters`), rs274.log-closed (`execute::message`),
//! rs274.percent-in-file (`text`).

use gaugeblock_vocabulary::{Compensation, FaultKind};

use crate::Choices;
use crate::ids::{Quirk, quirk};
use crate::math;
use crate::rs274::parameters::{self, Name};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::Comment;

/// Quirk rs274.shorter-lines: a line has at most so many characters without its line end.
pub(crate) const LONGEST_LINE: usize = 252;

/// Quirk rs274.last-parameter: the greatest number of a parameter.
pub(crate) const LAST_PARAMETER: u32 = 5601;

/// Quirk rs274.comment-before-o-word: a comment at the beginning of a block leaves neither an O-word nor M98 behind it.
pub(crate) const COMMENT_FIRST: Quirk = quirk::rs274::COMMENT_BEFORE_O_WORD;

/// Quirk rs274.semicolon-plain: the comment that may be active is the last one in parentheses.
pub(crate) fn active_comment(comments: Vec<Comment>) -> Option<Comment> {
    comments.into_iter().rfind(|comment| !comment.semicolon)
}

/// Quirk rs274.message-blanks: blanks may only stand before the keyword of an active comment.
pub(crate) fn keyword(text: &str) -> String {
    text.trim_start().to_ascii_lowercase()
}

/// Quirk rs274.wrong-format-sign: what begins like a format with decimals and is none loses its percent sign.
pub(crate) fn loses_percent_sign(text: &str) -> bool {
    text.starts_with("%.")
}

/// Quirk rs274.position-under-compensation: 5420 to 5428 have no value while the cutter is compensated, but in
/// messages.
pub(crate) fn read_under_compensation(name: &Name, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::POSITION_UNDER_COMPENSATION;
    let of_position = matches!(name, Name::Numbered(5420..=5428));
    if of_position && state.modes.compensation != Compensation::Off && state.choices.quirk(rule) {
        let message = "the position while the cutter is compensated";
        return Err(refuse(rule, FaultKind::CompensationActive, message));
    }
    Ok(())
}

/// Quirk rs274.named-exists-early: a named parameter that a line creates exists already, as zero, for the values behind
/// it on that line, and stays when the line is refused.
pub(crate) fn create_early(name: &Name, state: &mut State) {
    if !parameters::exists(name, state) {
        let created = parameters::assign(name, 0.0, state);
        debug_assert!(created.is_ok(), "read: the parameter is writable");
    }
}

/// Quirk rs274.g-code-tolerance: a G code may be off by a ten-thousandth itself. The integer that ten times it means.
pub(crate) fn close_g_code(tenfold: f64, choices: &Choices) -> Option<i64> {
    let near = math::near_integer(tenfold.round())?;
    let close = (tenfold - tenfold.round()).abs() <= 0.001;
    Some(near).filter(|_| close && choices.quirk(quirk::rs274::G_CODE_TOLERANCE))
}

/// Quirk rs274.absolute-negative-zero: ABS leaves the sign of a zero.
pub(crate) fn absolute(argument: f64, choices: &Choices) -> f64 {
    let left = argument == 0.0 && choices.quirk(quirk::rs274::ABSOLUTE_NEGATIVE_ZERO);
    if left { argument } else { argument.abs() }
}

/// Quirk rs274.repeated-negative-word: a P or Q of -1 or less counts as none, so that another one may follow it.
/// Quirk rs274.polar-repeated: so may a polar word in any case.
pub(crate) fn may_be_repeated(letter: char, earlier: f64, choices: &Choices) -> bool {
    match letter {
        '@' | '^' => choices.quirk(quirk::rs274::POLAR_REPEATED),
        'p' | 'q' => earlier <= -1.0 && choices.quirk(quirk::rs274::REPEATED_NEGATIVE_WORD),
        _ => false,
    }
}

/// Quirk rs274.rounded-zero-sign: what ROUND makes zero has no sign.
pub(crate) fn rounded(value: f64, choices: &Choices) -> f64 {
    let zero = value == 0.0 && choices.quirk(quirk::rs274::ROUNDED_ZERO_SIGN);
    if zero { 0.0 } else { value }
}

/// Quirk rs274.dynamic-compensation-code: `_ccomp` does not tell G41.1 and G42.1 from G41 and G42.
pub(crate) fn compensation_code(compensation: Compensation) -> u32 {
    match compensation {
        Compensation::Off => 400,
        Compensation::Left | Compensation::DynamicLeft => 410,
        Compensation::Right | Compensation::DynamicRight => 420,
    }
}

/// Quirk rs274.zero-tool-offset-off: `_tool_offset` tells whether an offset is not zero.
pub(crate) fn has_tool_offset(state: &State) -> bool {
    state.modes.tool_offset.to_array().iter().any(|offset| offset.abs() > 0.0)
}

/// Quirk rs274.selected-tool-zero: `_selected_tool` is 0 before the first T.
pub(crate) fn selected_tool(state: &State) -> i32 {
    state.selected_tool.max(0)
}

/// Quirk rs274.message-small-value. A message shows what is nearer to zero than a ten-thousandth as zero.
pub(crate) fn reported_value(value: f64, choices: &Choices) -> f64 {
    let small = value.abs() < 1e-4 && choices.quirk(quirk::rs274::MESSAGE_SMALL_VALUE);
    if small { 0.0 } else { value }
}

/// Quirk rs274.message-parameter-zero. #0 stands for zero in a message: what stands behind it.
pub(crate) fn parameter_zero<'a>(text: &'a str, choices: &Choices) -> Option<&'a str> {
    if !choices.quirk(quirk::rs274::MESSAGE_PARAMETER_ZERO) {
        return None;
    }
    let number = text.strip_prefix('#')?;
    let behind = number.trim_start_matches(|character: char| character.is_ascii_digit());
    let digits = &number[..number.len() - behind.len()];
    (digits.parse() == Ok(0_u32)).then_some(behind)
}
