//! Quirks of cutter compensation.

use super::{LinuxCnc, Shows};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::compensation::CompensationRules;
use crate::rs274::state::State;

impl CompensationRules for LinuxCnc {
    /// Quirk rs274.orientation-too-large. Any number above 9 is one, too.
    fn is_orientation(&self, number: i32, state: &State) -> bool {
        number > 9 && state.shows(quirk::rs274::ORIENTATION_TOO_LARGE)
            || Documented.is_orientation(number, state)
    }
}
