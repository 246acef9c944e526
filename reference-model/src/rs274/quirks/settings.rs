//! Quirks of coordinate systems.

use crate::ids::quirk;
use crate::rs274::state::State;

/// Quirk rs274.same-system-kept. Whether a coordinate system stays as it is, since it is selected already.
pub(crate) fn keeps_system(system: u32, state: &State) -> bool {
    state.modes.work_offset == system && state.choices.quirk(quirk::rs274::SAME_SYSTEM_KEPT)
}

/// Quirk rs274.origin-number-cut. A fraction of a half or more of P is cut off.
pub(crate) fn origin_number(number: f64, state: &State) -> f64 {
    let cut = state.choices.quirk(quirk::rs274::ORIGIN_NUMBER_CUT);
    if cut && number - number.floor() >= 0.5 { number.floor() } else { number }
}
