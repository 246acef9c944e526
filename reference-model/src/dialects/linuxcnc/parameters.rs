//! Quirks of parameters.

use gaugeblock_vocabulary::FeedMode;

use super::{LinuxCnc, Shows};
use crate::ids::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::parameters::ParameterRules;
use crate::rs274::state::State;

impl ParameterRules for LinuxCnc {
    /// Quirk rs274.feed-name-number: `_feed` is F as it was programmed, whatever the length unit was.
    /// Quirk rs274.feed-name-inverse-time: under inverse time it is the feed rate of the last move.
    fn feed_parameter(&self, state: &State) -> f64 {
        let by_number = state.shows(if state.modes.feed_mode == FeedMode::InverseTime {
            quirk::rs274::FEED_NAME_INVERSE_TIME
        } else {
            quirk::rs274::FEED_NAME_NUMBER
        });
        if by_number {
            return state.modes.memory.get().feed_number;
        }
        Documented.feed_parameter(state)
    }
}
