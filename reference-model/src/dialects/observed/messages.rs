//! Quirks of active comments.

use super::{HasQuirk, Observed};
use crate::Choices;
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::message::MessageRules;
use crate::rs274::state::State;

impl MessageRules for Observed {
    /// Quirk rs274.message-blanks. Blanks are only accepted before the keyword of an active comment.
    fn keyword(&self, before: &str, choices: &Choices) -> String {
        if choices.has_quirk(quirk::rs274::MESSAGE_BLANKS) {
            return before.trim_start().to_ascii_lowercase();
        }
        Documented.keyword(before, choices)
    }

    /// Quirk rs274.log-closed. LOG and LOGCLOSE act even if no log file is open.
    fn log_is_open(&self, state: &State) -> bool {
        Documented.log_is_open(state) || state.has_quirk(quirk::rs274::LOG_CLOSED)
    }

    /// Quirk rs274.long-format. %lf is not a format.
    fn has_long_format(&self, choices: &Choices) -> bool {
        !choices.has_quirk(quirk::rs274::LONG_FORMAT)
    }

    /// Quirk rs274.wrong-format-sign. A text that begins like a format with decimals, and is not a format, loses its
    /// percent sign.
    fn drops_percent_sign(&self, text: &str, choices: &Choices) -> bool {
        text.starts_with("%.") && choices.has_quirk(quirk::rs274::WRONG_FORMAT_SIGN)
    }

    /// Quirk rs274.message-parameter-zero. In a message, #0 has the value zero.
    fn parameter_zero<'a>(&self, text: &'a str, choices: &Choices) -> Option<&'a str> {
        if !choices.has_quirk(quirk::rs274::MESSAGE_PARAMETER_ZERO) {
            return None;
        }
        let number = text.strip_prefix('#')?;
        let rest = number.trim_start_matches(|character: char| character.is_ascii_digit());
        let digits = &number[..number.len() - rest.len()];
        (digits.parse() == Ok(0_u32)).then_some(rest)
    }

    /// Quirk rs274.message-small-value. A message prints values below a ten-thousandth as zero.
    fn reported_value(&self, value: f64, choices: &Choices) -> f64 {
        let small = value.abs() < 1e-4 && choices.has_quirk(quirk::rs274::MESSAGE_SMALL_VALUE);
        if small { 0.0 } else { Documented.reported_value(value, choices) }
    }
}
