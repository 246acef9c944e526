//! Quirks of codes that exclude each other, and of words that a code needs.

use gaugeblock_vocabulary::FaultKind;

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::check::codes::{CodeRules, Written};
use crate::rs274::check::needed::NeededWordRules;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::modes::{Code, ModalGroup};
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl CodeRules for Observed {
    /// Quirk rs274.save-in-spindle-group. M70 to M73 belong to the group of M3, M4 and M5.
    fn group_of_m(&self, code: &Code, state: &State) -> Option<ModalGroup> {
        let saves = (70..=73).contains(&code.number);
        if saves && state.has_quirk(quirk::rs274::SAVE_IN_SPINDLE_GROUP) {
            return Some(ModalGroup::Spindle);
        }
        Documented.group_of_m(code, state)
    }

    /// Quirk rs274.g92-codes-apart. G92.1, G92.2 and G92.3 exclude each other, but no other code of group 0; they
    /// take effect after it.
    fn exclude_each_other(&self, one: &Code, other: &Code, state: &State) -> bool {
        let clears = |code: &Code| (921..=923).contains(&code.number);
        let apart = clears(one) != clears(other) && state.has_quirk(quirk::rs274::G92_CODES_APART);
        !apart && Documented.exclude_each_other(one, other, state)
    }

    /// Quirk rs274.cancel-with-motion. G80 can be in a block with another motion code, which is executed.
    fn cancel_excludes_motion(&self, state: &State) -> bool {
        !state.has_quirk(quirk::rs274::CANCEL_WITH_MOTION)
            && Documented.cancel_excludes_motion(state)
    }

    /// Quirk rs274.cancel-beside-offset. G80 is refused in a block with G43.1 or G43.2 and axis words.
    fn check_axis_words(
        &self,
        words: &Words,
        codes: &[(Written, Code)],
        state: &mut State,
    ) -> Result<(), StepError> {
        let rule = quirk::rs274::CANCEL_BESIDE_OFFSET;
        let offset =
            words.g_tenths.iter().any(|code| [431, 432].contains(code)) && has_axis_words(words);
        if offset && words.g_tenths.contains(&800) && state.has_quirk(rule) {
            let message = "G80 in a block with the axis words of a tool length offset";
            return Err(refuse(rule, FaultKind::AxisWords, message));
        }
        Documented.check_axis_words(words, codes, state)
    }

    /// Quirk rs274.dynamic-length-with-motion. G43.1 and a motion code can be in one block.
    fn dynamic_length_excludes_motion(&self, state: &State) -> bool {
        !state.has_quirk(quirk::rs274::DYNAMIC_LENGTH_WITH_MOTION)
            && Documented.dynamic_length_excludes_motion(state)
    }
}

impl NeededWordRules for Observed {
    /// Quirk rs274.dynamic-length-without-axes. G43.1 needs no axis word.
    fn check_dynamic_length(&self, words: &Words, state: &State) -> Result<(), StepError> {
        if state.has_quirk(quirk::rs274::DYNAMIC_LENGTH_WITHOUT_AXES) {
            return Ok(());
        }
        Documented.check_dynamic_length(words, state)
    }
}
