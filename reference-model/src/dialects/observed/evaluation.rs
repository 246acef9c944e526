//! Quirks of reading words and values.

use gaugeblock_vocabulary::{Compensation, FaultKind, Motion};

use super::values::in_single_precision;
use super::{HasQuirk, Observed};
use crate::Choices;
use crate::dialects::quirk;
use crate::math;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::{EvaluationRules, Words};
use crate::rs274::execute::programmed_motion::motion_of;
use crate::rs274::parameters::{self, Name};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Fourteen bits of a number that single precision holds.
fn fourteen_bits(number: i64) -> i64 {
    #[expect(clippy::cast_precision_loss, reason = "single precision loses more")]
    let number = in_single_precision(number as f64);
    math::near_integer(number % 16384.0).unwrap_or(0)
}

impl EvaluationRules for Observed {
    /// Quirk rs274.repeated-negative-word. A P or Q of -1 or less counts as absent: another one may follow it.
    /// Quirk rs274.polar-repeated. Polar words may be repeated whatever their value.
    fn letter_may_be_repeated(&self, letter: char, earlier: f64, choices: &Choices) -> bool {
        match letter {
            '@' | '^' => choices.has_quirk(quirk::rs274::POLAR_REPEATED),
            'p' | 'q' => earlier <= -1.0 && choices.has_quirk(quirk::rs274::REPEATED_NEGATIVE_WORD),
            _ => false,
        }
    }

    /// Quirk rs274.named-exists-early. A named parameter that a line creates already exists, with the value zero, for
    /// the values after it on that line. It still exists if the line is refused.
    fn begin_setting(&self, name: &Name, state: &mut State) {
        if state.has_quirk(quirk::rs274::NAMED_EXISTS_EARLY) && !parameters::exists(name, state) {
            let created = parameters::assign(name, 0.0, state);
            debug_assert!(created.is_ok(), "read: the parameter is writable");
        }
    }

    /// Quirk rs274.synchronised-e-word. G33 and G33.1 take E, too.
    fn takes_e(&self, words: &Words, state: &State) -> bool {
        let synchronised = [Motion::SpindleSynchronised, Motion::RigidTap];
        Documented.takes_e(words, state)
            || state.has_quirk(quirk::rs274::SYNCHRONISED_E_WORD)
                && motion_of(words, state).is_some_and(|motion| synchronised.contains(&motion))
    }

    /// Quirk rs274.g-code-tolerance. The number of a G code may differ from the code by a ten-thousandth.
    fn g_code_number(&self, tenfold: f64, choices: &Choices) -> Option<i64> {
        let documented = Documented.g_code_number(tenfold, choices);
        if documented.is_some() || !choices.has_quirk(quirk::rs274::G_CODE_TOLERANCE) {
            return documented;
        }
        let near = math::near_integer(tenfold.round())?;
        ((tenfold - tenfold.round()).abs() <= 0.001).then_some(near)
    }

    /// Quirk grbl.code-number-bits. Fourteen bits of the whole part count.
    /// Quirk grbl.length-off-decimals. G49 has any decimals.
    /// Quirk grblhal.negative-code. A negative code number is read as zero.
    fn parts_of_code(
        &self,
        letter: char,
        (whole, hundredths): (i64, i64),
        choices: &Choices,
    ) -> (i64, i64) {
        let is_negative = whole < 0 || hundredths < 0;
        if is_negative && choices.has_quirk(quirk::grblhal::NEGATIVE_CODE) {
            return (0, 0);
        }
        let wraps = whole > 0x3fff && choices.has_quirk(quirk::grbl::CODE_NUMBER_BITS);
        let whole = if wraps { fourteen_bits(whole) } else { whole };
        let is_off = letter == 'g' && whole == 49 && hundredths != 0;
        if is_off && choices.has_quirk(quirk::grbl::LENGTH_OFF_DECIMALS) {
            return (whole, 0);
        }
        Documented.parts_of_code(letter, (whole, hundredths), choices)
    }

    /// Quirk rs274.position-under-compensation. 5420 to 5428 have no value while the cutter is compensated, except in
    /// messages.
    fn check_readable(&self, name: &Name, state: &State) -> Result<(), StepError> {
        let rule = quirk::rs274::POSITION_UNDER_COMPENSATION;
        let of_position = matches!(name, Name::Numbered(5420..=5428));
        let compensated = state.modes.compensation != Compensation::Off;
        if of_position && compensated && state.has_quirk(rule) {
            let message = "the position while the cutter is compensated";
            return Err(refuse(rule, FaultKind::CompensationActive, message));
        }
        Documented.check_readable(name, state)
    }

    /// Quirk rs274.absolute-negative-zero. ABS keeps the sign of a zero.
    fn absolute(&self, argument: f64, choices: &Choices) -> f64 {
        let left = argument == 0.0 && choices.has_quirk(quirk::rs274::ABSOLUTE_NEGATIVE_ZERO);
        if left { argument } else { Documented.absolute(argument, choices) }
    }

    /// Quirk rs274.round-32-bits. ROUND returns -2147483648 for a number beyond 32 bits.
    /// Quirk rs274.rounded-zero-sign. A zero that ROUND returns has no sign.
    fn sign_of_rounded(&self, rounded: f64, choices: &Choices) -> f64 {
        let is_held = f64::from(i32::MIN) <= rounded && rounded <= f64::from(i32::MAX);
        if !is_held && choices.has_quirk(quirk::rs274::ROUND_32_BITS) {
            return f64::from(i32::MIN);
        }
        let zero = rounded == 0.0 && choices.has_quirk(quirk::rs274::ROUNDED_ZERO_SIGN);
        if zero { 0.0 } else { Documented.sign_of_rounded(rounded, choices) }
    }
}
