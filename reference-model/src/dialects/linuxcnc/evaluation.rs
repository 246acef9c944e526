//! Quirks of reading words and values.

use gaugeblock_vocabulary::{Compensation, FaultKind, Motion};

use super::{LinuxCnc, Shows};
use crate::Choices;
use crate::dialects::quirk;
use crate::math;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::{EvaluationRules, Words};
use crate::rs274::execute::programmed_motion::motion_of;
use crate::rs274::parameters::{self, Name};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl EvaluationRules for LinuxCnc {
    /// Quirk rs274.repeated-negative-word. A P or Q of -1 or less counts as none, so that another one may follow it.
    /// Quirk rs274.polar-repeated. So may a polar word in any case.
    fn letter_may_be_repeated(&self, letter: char, earlier: f64, choices: &Choices) -> bool {
        match letter {
            '@' | '^' => choices.shows(quirk::rs274::POLAR_REPEATED),
            'p' | 'q' => earlier <= -1.0 && choices.shows(quirk::rs274::REPEATED_NEGATIVE_WORD),
            _ => false,
        }
    }

    /// Quirk rs274.named-exists-early. A named parameter that a line creates exists already, as zero, for the values
    /// behind it on that line, and stays when the line is refused.
    fn begin_setting(&self, name: &Name, state: &mut State) {
        if state.shows(quirk::rs274::NAMED_EXISTS_EARLY) && !parameters::exists(name, state) {
            let created = parameters::assign(name, 0.0, state);
            debug_assert!(created.is_ok(), "read: the parameter is writable");
        }
    }

    /// Quirk rs274.synchronised-e-word. G33 and G33.1 take E, too.
    fn takes_e(&self, words: &Words, state: &State) -> bool {
        let synchronised = [Motion::SpindleSynchronised, Motion::RigidTap];
        Documented.takes_e(words, state)
            || state.shows(quirk::rs274::SYNCHRONISED_E_WORD)
                && motion_of(words, state).is_some_and(|motion| synchronised.contains(&motion))
    }

    /// Quirk rs274.g-code-tolerance. A G code may be off by a ten-thousandth itself.
    fn g_code_number(&self, tenfold: f64, choices: &Choices) -> Option<i64> {
        let documented = Documented.g_code_number(tenfold, choices);
        if documented.is_some() || !choices.shows(quirk::rs274::G_CODE_TOLERANCE) {
            return documented;
        }
        let near = math::near_integer(tenfold.round())?;
        ((tenfold - tenfold.round()).abs() <= 0.001).then_some(near)
    }

    /// Quirk rs274.position-under-compensation. 5420 to 5428 have no value while the cutter is compensated, but in
    /// messages.
    fn check_readable(&self, name: &Name, state: &State) -> Result<(), StepError> {
        let rule = quirk::rs274::POSITION_UNDER_COMPENSATION;
        let of_position = matches!(name, Name::Numbered(5420..=5428));
        let compensated = state.modes.compensation != Compensation::Off;
        if of_position && compensated && state.shows(rule) {
            let message = "the position while the cutter is compensated";
            return Err(refuse(rule, FaultKind::CompensationActive, message));
        }
        Documented.check_readable(name, state)
    }

    /// Quirk rs274.absolute-negative-zero. ABS leaves the sign of a zero.
    fn absolute(&self, argument: f64, choices: &Choices) -> f64 {
        let left = argument == 0.0 && choices.shows(quirk::rs274::ABSOLUTE_NEGATIVE_ZERO);
        if left { argument } else { Documented.absolute(argument, choices) }
    }

    /// Quirk rs274.rounded-zero-sign. What ROUND makes zero has no sign.
    fn sign_of_rounded(&self, rounded: f64, choices: &Choices) -> f64 {
        let zero = rounded == 0.0 && choices.shows(quirk::rs274::ROUNDED_ZERO_SIGN);
        if zero { 0.0 } else { Documented.sign_of_rounded(rounded, choices) }
    }
}
