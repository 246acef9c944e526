//! Quirks of cutter compensation.

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::compensation::CompensationRules;
use crate::rs274::state::State;

impl CompensationRules for Observed {
    /// Quirk rs274.orientation-too-large. L of G41.1 and G42.1 above 9 is accepted, too.
    fn is_orientation(&self, number: i32, state: &State) -> bool {
        number > 9 && state.has_quirk(quirk::rs274::ORIENTATION_TOO_LARGE)
            || Documented.is_orientation(number, state)
    }
}
