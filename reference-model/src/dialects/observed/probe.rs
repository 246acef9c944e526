//! Quirks of probing.

use gaugeblock_vocabulary::{FaultKind, FeedMode, Motion, Position};

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::probe::ProbeRules;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl ProbeRules for Observed {
    /// Quirk rs274.probe-per-revolution. In G95 mode probing is refused.
    fn check_probe_feed(
        &self,
        motion: Motion,
        words: &Words,
        state: &State,
    ) -> Result<(), StepError> {
        let rule = quirk::rs274::PROBE_PER_REVOLUTION;
        if state.modes.feed_mode == FeedMode::PerRevolution && state.has_quirk(rule) {
            return Err(refuse(rule, FaultKind::Probe, "probing under feed per revolution"));
        }
        Documented.check_probe_feed(motion, words, state)
    }

    /// Quirk rs274.probe-same-point. G38.3 and G38.5 may end where they start.
    fn probes_in_place(&self, motion: Motion, end: Position, state: &State) -> bool {
        let silent = matches!(motion, Motion::ProbeToward | Motion::ProbeAway);
        !(silent && state.has_quirk(quirk::rs274::PROBE_SAME_POINT))
            && Documented.probes_in_place(motion, end, state)
    }
}
