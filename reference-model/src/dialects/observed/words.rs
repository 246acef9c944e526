//! Quirks of words that no code uses.

use gaugeblock_vocabulary::Motion;

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::check::words::WordRules;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::programmed_motion::motion_of;
use crate::rs274::execute::whole;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl WordRules for Observed {
    /// [`is_ignored`] lists the quirks: words that are accepted although no code uses them.
    fn check_unused(
        &self,
        letter: char,
        words: &Words,
        state: &mut State,
    ) -> Result<(), StepError> {
        if is_ignored(letter, words, state) {
            return Ok(());
        }
        Documented.check_unused(letter, words, state)
    }

    /// Quirk rs274.per-revolution-dollar. G95 does not use $. Quirk rs274.rpm-mode-dollar. G97 does not use $.
    /// Quirk rs274.cycle-dollar. Canned cycles do not use $. Quirk rs274.left-tap-repeat. G74 does not use L.
    fn is_used_by_g(&self, letter: char, code: u32, words: &Words, state: &State) -> bool {
        let unused = match (letter, code) {
            ('$', 950) => state.has_quirk(quirk::rs274::PER_REVOLUTION_DOLLAR),
            ('$', 970) => state.has_quirk(quirk::rs274::RPM_MODE_DOLLAR),
            ('$', 730 | 740 | 810..=890) => state.has_quirk(quirk::rs274::CYCLE_DOLLAR),
            ('l', 740) => state.has_quirk(quirk::rs274::LEFT_TAP_REPEAT),
            _ => false,
        };
        !unused && Documented.is_used_by_g(letter, code, words, state)
    }

    /// Quirk rs274.override-dollar. M48 and M49 do not use $.
    fn is_used_by_m(&self, letter: char, code: u32, state: &State) -> bool {
        let unused = letter == '$'
            && [48, 49].contains(&code)
            && state.has_quirk(quirk::rs274::OVERRIDE_DOLLAR);
        !unused && Documented.is_used_by_m(letter, code, state)
    }

    /// Quirk rs274.offset-data-words. G10 accepts words that G10 with another L uses.
    fn is_used_by_offset_data(&self, letter: char, kind: Option<i32>, state: &State) -> bool {
        let of_others = match kind {
            Some(0) => "pqrijxyzabcuvw",
            Some(2 | 20) => "q",
            _ => "",
        };
        of_others.contains(letter) && state.has_quirk(quirk::rs274::OFFSET_DATA_WORDS)
            || Documented.is_used_by_offset_data(letter, kind, state)
    }

    /// Quirk rs274.blend-q-without-p. G64 accepts Q without P.
    fn check_naive_cam_alone(&self, state: &State) -> Result<(), StepError> {
        if state.has_quirk(quirk::rs274::BLEND_Q_WITHOUT_P) {
            return Ok(());
        }
        Documented.check_naive_cam_alone(state)
    }
}

/// Quirk rs274.unused-q-minus-one. An unused Q-1 counts as absent.
/// Quirk rs274.compensation-l-word. G41 and G42 take L, an integer.
/// Quirk rs274.dynamic-compensation-r-word. G41.1 and G42.1 take R, any number.
/// Quirk rs274.synchronised-e-word. G33 and G33.1 take E.
fn is_ignored(letter: char, words: &Words, state: &State) -> bool {
    let value = words.letters.get(&letter).copied();
    let has = |codes: [u32; 2]| words.g_tenths.iter().any(|code| codes.contains(code));
    match letter {
        'q' => value == Some(-1.0) && state.has_quirk(quirk::rs274::UNUSED_Q_MINUS_ONE),
        'l' => {
            let order = value.and_then(whole);
            has([410, 420])
                && order.is_some_and(|order| order >= 0)
                && state.has_quirk(quirk::rs274::COMPENSATION_L_WORD)
        }
        'r' => has([411, 421]) && state.has_quirk(quirk::rs274::DYNAMIC_COMPENSATION_R_WORD),
        'e' => {
            let synchronised = [Motion::SpindleSynchronised, Motion::RigidTap];
            motion_of(words, state).is_some_and(|motion| synchronised.contains(&motion))
                && state.has_quirk(quirk::rs274::SYNCHRONISED_E_WORD)
        }
        _ => false,
    }
}
