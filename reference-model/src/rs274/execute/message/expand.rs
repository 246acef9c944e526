//! Values of parameters in messages.

use gaugeblock_vocabulary::FaultKind;

use crate::Choices;
use crate::ids::{choice, rule};
use crate::rs274::parameters::{self, Name};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// The text with values for its parameters.
///
/// Rule active-comments.format-lasts. A format holds for the rest of the line until another one; it need not stand next
/// to the parameter.
/// Rule active-comments.format-per-line. A format does not outlast its line.
pub(super) fn expand(text: &str, state: &mut State) -> Result<String, StepError> {
    let mut decimals = default_decimals(&state.choices);
    let mut expanded = String::new();
    let mut rest = text;
    while let Some(next) = rest.chars().next() {
        if let Some((format, behind)) = format_at(rest, state) {
            decimals = format;
            rest = behind;
        } else if let Some(behind) = state.dialect().parameter_zero(rest, &state.choices) {
            expanded += &format!("{:.decimals$}", 0.0);
            rest = behind;
        } else if let Some((name, behind)) = parameter_at(rest, state) {
            expanded += &shown(name.as_ref(), decimals, state)?;
            rest = behind;
        } else {
            let loses_sign =
                next == '%' && state.dialect().drops_percent_sign(rest, &state.choices);
            if next == '%' {
                state.coverage.accepted(rule::active_comments::WRONG_FORMAT);
            }
            if !loses_sign {
                expanded.push(next);
            }
            rest = &rest[next.len_utf8()..];
        }
    }
    Ok(expanded)
}

/// A format, as a number of decimals, and the text after it.
///
/// Rule active-comments.integer-format. After %d values are rounded to integers.
/// Rule active-comments.decimals-format. After %.0f to %.9f values have that number of decimals.
/// Choice active-comments.plain-f-format: the decimals of %f.
/// Rule active-comments.long-format. %lf is the format that holds where none is written.
fn format_at<'a>(text: &'a str, state: &mut State) -> Option<(usize, &'a str)> {
    let format = text.strip_prefix('%')?;
    let long =
        format.strip_prefix("lf").filter(|_| state.dialect().has_long_format(&state.choices));
    let (decimals, behind) = if let Some(behind) = long {
        state.coverage.accepted(rule::active_comments::LONG_FORMAT);
        (default_decimals(&state.choices), behind)
    } else if let Some(behind) = format.strip_prefix('d') {
        state.coverage.accepted(rule::active_comments::INTEGER_FORMAT);
        (0, behind)
    } else if let Some(behind) = format.strip_prefix('f') {
        let four = state.choices.is(choice::active_comments::PlainFFormat::FourDecimals);
        (if four { 4 } else { 6 }, behind)
    } else {
        let format = format.strip_prefix('.')?;
        let digit = format.chars().next()?.to_digit(10)?;
        (digit as usize, format[1..].strip_prefix('f')?)
    };
    state.coverage.accepted(rule::active_comments::DECIMALS_FORMAT);
    state.coverage.accepted(rule::active_comments::FORMAT_LASTS);
    state.coverage.accepted(rule::active_comments::FORMAT_PER_LINE);
    Some((decimals, behind))
}

/// Choice active-comments.default-format: the decimals of a value before any format.
fn default_decimals(choices: &Choices) -> usize {
    if choices.is(choice::active_comments::DefaultFormat::SixDecimals) { 6 } else { 4 }
}

/// A parameter, or `None` for an invalid number, and the text after it.
///
/// Rule active-comments.numbered. A number sign and a number are replaced by the value of that parameter. Rule
/// active-comments.named. A number sign and a name in <> are replaced by the value of that parameter; blanks in the
/// name do not count.
fn parameter_at<'a>(text: &'a str, state: &mut State) -> Option<(Option<Name>, &'a str)> {
    let rest = text.strip_prefix('#')?;
    if let Some(named) = rest.strip_prefix('<') {
        let (name, behind) = named.split_once('>')?;
        let name: String =
            name.chars().filter(|character| !matches!(character, ' ' | '\t')).collect();
        state.coverage.accepted(rule::active_comments::NAMED);
        return Some((Some(Name::Named(name.to_ascii_lowercase())), behind));
    }
    let digits =
        rest.len() - rest.trim_start_matches(|character: char| character.is_ascii_digit()).len();
    let (number, behind) = rest.split_at(digits);
    if number.is_empty() {
        return None;
    }
    state.coverage.accepted(rule::active_comments::NUMBERED);
    let last = parameters::last(&state.choices);
    let number = number.parse().ok().filter(|number| (1..=last).contains(number));
    Some((number.map(Name::Numbered), behind))
}

/// A value as it is printed.
///
/// Rule active-comments.absent-named. A named parameter that does not exist is printed as number signs, not refused.
/// Choice active-comments.absent-name: by one or by six of them.
fn shown(name: Option<&Name>, decimals: usize, state: &mut State) -> Result<String, StepError> {
    let value = name.map(|name| shown_value(name, state));
    match value {
        Some(Ok(value)) => {
            if let Some(name) = name {
                parameters::rules_of(name, state)
                    .into_iter()
                    .for_each(|rule| state.coverage.accepted(rule));
            }
            let value = state.dialect().reported_value(value, &state.choices);
            let signed = value != 0.0 || state.choices.is(choice::expressions::NegativeZero::Kept);
            let value = if signed { value } else { 0.0 };
            let text = format!("{value:.decimals$}");
            // An integer has no negative zero.
            Ok(if text == "-0" { "0".to_owned() } else { text })
        }
        None | Some(Err(StepError::Refused(_))) => {
            state.coverage.accepted(rule::active_comments::ABSENT_NAMED);
            let one = state.choices.is(choice::active_comments::AbsentName::NumberSign);
            Ok(if one { "#" } else { "######" }.to_owned())
        }
        Some(Err(error)) => Err(error),
    }
}

/// The value that a message prints for a parameter.
///
/// Rule active-comments.absent-named. What does not exist has none, also where it would be zero in an expression.
/// Choice active-comments.same-block-setting: a parameter that is set in the block of the message has its new value
/// or its old one.
pub(super) fn shown_value(name: &Name, state: &State) -> Result<f64, StepError> {
    let new = state.choices.is(choice::active_comments::SameBlockSetting::New)
        && !parameters::is_told(name);
    match state.parameters.announced(name) {
        Some(value) if new => Ok(value),
        _ if matches!(name, Name::Named(_)) && !parameters::exists(name, state) => {
            let message = "the parameter of a message does not exist";
            let rule = rule::active_comments::ABSENT_NAMED;
            Err(refuse(rule, FaultKind::NoSuchParameter, message))
        }
        _ => parameters::value(name, state),
    }
}
