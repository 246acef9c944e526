//! Quirks of dwells.

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::dwell::DwellRules;
use crate::rs274::execute::whole;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl DwellRules for Observed {
    /// Quirk rs274.negative-dwell. A negative dwell is accepted, unless it is -1.
    fn check_dwell(&self, seconds: f64, state: &State) -> Result<(), StepError> {
        if whole(seconds) != Some(-1) && state.has_quirk(quirk::rs274::NEGATIVE_DWELL) {
            return Ok(());
        }
        Documented.check_dwell(seconds, state)
    }
}
