//! Quirks of planes, units and the return mode.

use gaugeblock_vocabulary::{Compensation, FaultKind, FeedMode};

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::units_planes::UnitsAndPlanesRules;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl UnitsAndPlanesRules for Observed {
    /// Quirk linuxcnc.feed-per-revolution-unit. A feed per revolution keeps its number.
    /// Quirk linuxcnc.inverse-time-unit. F of inverse time is converted.
    fn rescales_feed(&self, state: &State) -> bool {
        match state.modes.feed_mode {
            FeedMode::PerRevolution
                if state.has_quirk(quirk::linuxcnc::FEED_PER_REVOLUTION_UNIT) =>
            {
                false
            }
            FeedMode::InverseTime if state.has_quirk(quirk::linuxcnc::INVERSE_TIME_UNIT) => true,
            FeedMode::PerMinute | FeedMode::PerRevolution | FeedMode::InverseTime => {
                Documented.rescales_feed(state)
            }
        }
    }

    /// Quirk rs274.retract-under-compensation. G98 and G99 are refused while the cutter is compensated.
    fn select_retract(&self, words: &Words, state: &mut State) -> Result<(), StepError> {
        retract_under_compensation(state)?;
        Documented.select_retract(words, state)
    }
}

/// Quirk rs274.retract-under-compensation. Refuses a change of the return mode while the cutter is compensated.
pub(super) fn retract_under_compensation(state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::RETRACT_UNDER_COMPENSATION;
    if state.modes.compensation != Compensation::Off && state.has_quirk(rule) {
        let message = "a return mode is selected while the cutter is compensated";
        return Err(refuse(rule, FaultKind::CompensationActive, message));
    }
    Ok(())
}
