//! Cutter compensation: G40 to G42.1, and moves while the cutter is compensated.
//!
//! The specification is docs/compensation.md. A move in the plane is recorded at once with the end of its own curve,
//! and waits for the next one, which amends its end at an inner corner.

mod ending;
mod entry;
mod exit;
pub(crate) mod mode;
mod moves;
mod orientation;
mod surroundings;

pub(crate) use ending::{end_of_run, put_out, restored};
pub(crate) use exit::lead_away;
pub(crate) use mode::CompensationRules;
pub use mode::perform;
pub(crate) use moves::programmed_point;
pub(super) use moves::{applies, arc, line};
pub(crate) use surroundings::Surroundings;

use gaugeblock_vocabulary::FaultKind;

use crate::ids::Rule;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// A compensated move that has no place for the tool.
fn gouges(rule: impl Into<Rule>, message: &str) -> StepError {
    refuse(rule, FaultKind::Gouging, message)
}

/// How far, active length unit, a bound is moved where the last bits of a length decide.
fn slack(state: &State) -> f64 {
    let position = state.position.to_array().into_iter();
    let size = position
        .fold(state.modes.compensation_radius.abs(), |size, coordinate| size.max(coordinate.abs()));
    state.modes.rounding.margin() * size
}
