//! Quirks of probing.

use gaugeblock_vocabulary::{FaultKind, FeedMode, Motion};

use crate::ids::quirk;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Quirk rs274.probe-per-revolution. Under feed per revolution probing is refused.
pub(crate) fn feed_mode(state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::PROBE_PER_REVOLUTION;
    if state.modes.feed_mode == FeedMode::PerRevolution && state.choices.quirk(rule) {
        return Err(refuse(rule, FaultKind::Probe, "probing under feed per revolution"));
    }
    Ok(())
}

/// Quirk rs274.probe-inverse-time. Under inverse time probing ignores F in its block, and goes at the rate that was
/// set before.
pub(crate) fn keeps_rate(state: &State) -> bool {
    state.choices.quirk(quirk::rs274::PROBE_INVERSE_TIME)
}

/// Quirk rs274.probe-same-point. G38.3 and G38.5 may lead to where the controlled point is.
pub(crate) fn goes_nowhere(motion: Motion, state: &State) -> bool {
    let silent = matches!(motion, Motion::ProbeToward | Motion::ProbeAway);
    silent && state.choices.quirk(quirk::rs274::PROBE_SAME_POINT)
}
