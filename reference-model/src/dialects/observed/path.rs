//! Quirks of the path control mode.

use gaugeblock_vocabulary::{Compensation, FaultKind, PathControlMode};

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::path::PathRules;
use crate::rs274::modes::unit_size;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl PathRules for Observed {
    /// Quirk rs274.path-under-compensation. G61, G61.1 and G64 are refused while the cutter is compensated.
    fn select_path(&self, words: &Words, state: &mut State) -> Result<(), StepError> {
        path_under(state.modes.compensation, state)?;
        Documented.select_path(words, state)?;
        if state.modes.path == PathControlMode::Continuous {
            let modes = &mut state.modes;
            modes.memory.get_mut().tolerance_unit = modes.units;
        }
        Ok(())
    }
}

/// Quirk rs274.path-under-compensation. Refuses a path control mode if `compensation` is on.
pub(super) fn path_under(compensation: Compensation, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::PATH_UNDER_COMPENSATION;
    if compensation != Compensation::Off && state.has_quirk(rule) {
        let message = "a path control mode is selected while the cutter is compensated";
        return Err(refuse(rule, FaultKind::CompensationActive, message));
    }
    Ok(())
}

/// Quirk rs274.tolerance-unit. G64 is programmed again with its tolerances as numbers: a change of the length unit
/// since then changes the lengths.
pub(super) fn tolerances_as_numbers(state: &mut State) {
    if state.has_quirk(quirk::rs274::TOLERANCE_UNIT) {
        let modes = &mut state.modes;
        let unit = &mut modes.memory.get_mut().tolerance_unit;
        let factor = unit_size(modes.units) / unit_size(*unit);
        modes.blend_tolerance *= factor;
        modes.naive_cam_tolerance *= factor;
        *unit = modes.units;
    }
}
