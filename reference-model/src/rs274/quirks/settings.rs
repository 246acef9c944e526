//! Quirks of modes, offsets, spindle, overrides and the program end.

use gaugeblock_vocabulary::{FaultKind, Motion, Switch};

use crate::ids::quirk;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::motion::motion_of;
use crate::rs274::execute::whole;
use crate::rs274::modes::ModalGroup;
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Quirk rs274.override-any-p. Any P but zero enables.
pub(crate) fn switch_of_any_p(value: f64) -> Switch {
    if value == 0.0 { Switch::Off } else { Switch::On }
}

/// Quirk rs274.override-dollar. M48 and M49 do not use $: whether one of them stands in a block where it is not theirs.
pub(crate) fn is_of_others(words: &Words, state: &State) -> bool {
    let both = words.m.iter().any(|code| [48, 49].contains(code));
    both && state.choices.quirk(quirk::rs274::OVERRIDE_DOLLAR)
}

/// Quirk rs274.override-dollar. M48 and M49 do not use $.
pub(crate) fn m_uses_no_dollar(m_code: u32, state: &State) -> bool {
    [48, 49].contains(&m_code) && state.choices.quirk(quirk::rs274::OVERRIDE_DOLLAR)
}

/// Quirk rs274.speed-override-dollar. M51 takes no $0, nor what is rounded toward that.
pub(crate) fn override_dollar(spindle: f64, state: &State) -> Result<(), StepError> {
    if spindle.trunc() == 0.0 && state.choices.quirk(quirk::rs274::SPEED_OVERRIDE_DOLLAR) {
        let message = "M51 with $0";
        return Err(refuse(
            quirk::rs274::SPEED_OVERRIDE_DOLLAR,
            FaultKind::SpindleOutOfRange,
            message,
        ));
    }
    Ok(())
}

/// Quirk rs274.per-revolution-dollar. G95 does not use $, another code or S may.
/// Quirk rs274.rpm-mode-dollar. Neither does G97.
pub(crate) fn uses_no_dollar(g_code: u32, state: &State) -> bool {
    match g_code {
        950 => state.choices.quirk(quirk::rs274::PER_REVOLUTION_DOLLAR),
        970 => state.choices.quirk(quirk::rs274::RPM_MODE_DOLLAR),
        _ => false,
    }
}

/// Quirk rs274.same-system-kept. Whether a coordinate system stays as it is, since it is selected already.
pub(crate) fn keeps_system(system: u32, state: &State) -> bool {
    state.modes.work_offset == system && state.choices.quirk(quirk::rs274::SAME_SYSTEM_KEPT)
}

/// Quirk rs274.origin-number-cut. A fraction of a half or more of P is cut off.
pub(crate) fn origin_number(number: f64, state: &State) -> f64 {
    let cut = state.choices.quirk(quirk::rs274::ORIGIN_NUMBER_CUT);
    if cut && number - number.floor() >= 0.5 { number.floor() } else { number }
}

/// Quirk rs274.save-in-spindle-group. M70 to M73 belong to the group of M3, M4 and M5.
pub(crate) fn group_of(m_code: u32, state: &State) -> Option<ModalGroup> {
    let saves = (70..=73).contains(&m_code);
    (saves && state.choices.quirk(quirk::rs274::SAVE_IN_SPINDLE_GROUP))
        .then_some(ModalGroup::Spindle)
}

/// Quirk rs274.g92-codes-apart. G92.1, G92.2 and G92.3 exclude each other and no other code of group 0, after which
/// they act.
pub(crate) fn group_of_g(g_code: u32, state: &State) -> Option<ModalGroup> {
    let clears = (921..=923).contains(&g_code);
    (clears && state.choices.quirk(quirk::rs274::G92_CODES_APART))
        .then_some(ModalGroup::LocalOffset)
}

/// Quirk rs274.cancel-beside-offset. G80 is refused beside G43.1 and G43.2 with axis words.
pub(crate) fn cancel_beside_offset(words: &Words, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::CANCEL_BESIDE_OFFSET;
    let offset = words.g.iter().any(|code| [431, 432].contains(code)) && has_axis_words(words);
    if offset && words.g.contains(&800) && state.choices.quirk(rule) {
        let message = "G80 in a block with the axis words of a tool length offset";
        return Err(refuse(rule, FaultKind::AxisWords, message));
    }
    Ok(())
}

/// Quirk rs274.unused-q-minus-one. An unused Q-1 is taken for no word.
/// Quirk rs274.compensation-l-word. G41 and G42 take L, an integer.
/// Quirk rs274.dynamic-compensation-r-word. G41.1 and G42.1 take R, any number.
/// Quirk rs274.synchronised-e-word. G33 and G33.1 take E.
pub(crate) fn is_ignored(letter: char, words: &Words, state: &State) -> bool {
    match letter {
        'q' => {
            words.letters.get(&'q') == Some(&-1.0)
                && state.choices.quirk(quirk::rs274::UNUSED_Q_MINUS_ONE)
        }
        'l' => {
            let order = words.letters.get(&'l').copied().and_then(whole);
            words.g.iter().any(|code| [410, 420].contains(code))
                && order.is_some_and(|order| order >= 0)
                && state.choices.quirk(quirk::rs274::COMPENSATION_L_WORD)
        }
        'r' => {
            words.g.iter().any(|code| [411, 421].contains(code))
                && state.choices.quirk(quirk::rs274::DYNAMIC_COMPENSATION_R_WORD)
        }
        'e' => {
            let synchronised = [Motion::SpindleSynchronised, Motion::RigidTap];
            motion_of(words, state).is_some_and(|motion| synchronised.contains(&motion))
                && state.choices.quirk(quirk::rs274::SYNCHRONISED_E_WORD)
        }
        _ => false,
    }
}

/// Quirk rs274.offset-data-words. With G10 a word may stand that another of its kinds uses.
pub(crate) fn goes_with_offset_data(letter: char, kind: Option<i32>, state: &State) -> bool {
    let letters = match kind {
        Some(0) => "pqrijxyzabcuvw",
        Some(2 | 20) => "q",
        _ => return false,
    };
    letters.contains(letter) && state.choices.quirk(quirk::rs274::OFFSET_DATA_WORDS)
}
