//! Quirks of modes, offsets, spindle, overrides and the program end.

use gaugeblock_vocabulary::{FaultKind, Switch};

use crate::ids::quirk;
use crate::rs274::evaluate::Words;
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

/// Quirk rs274.same-system-kept. Whether a coordinate system stays as it is, since it is selected already.
pub(crate) fn keeps_system(system: u32, state: &State) -> bool {
    state.modes.work_offset == system && state.choices.quirk(quirk::rs274::SAME_SYSTEM_KEPT)
}

/// Quirk rs274.origin-number-cut. A fraction of a half or more of P is cut off.
pub(crate) fn origin_number(number: f64, state: &State) -> f64 {
    let cut = state.choices.quirk(quirk::rs274::ORIGIN_NUMBER_CUT);
    if cut && number - number.floor() >= 0.5 { number.floor() } else { number }
}
