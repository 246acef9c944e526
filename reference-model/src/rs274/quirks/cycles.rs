//! Quirks of canned cycles.

use gaugeblock_vocabulary::{Axis, Plane, Position};

use crate::ids::quirk;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::whole;
use crate::rs274::state::State;

/// Quirk rs274.cycle-rise. Whether there is a rise before the first move in the plane goes by the level at which the
/// row of cycles began, not by the current one.
pub(crate) fn rises(below: bool, began_below: bool, state: &State) -> bool {
    if state.choices.quirk(quirk::rs274::CYCLE_RISE) { began_below } else { below }
}

/// Quirk rs274.cycle-rise. In a row that began above R the first move in the plane rises to the clear height on its
/// way, when it begins at R or below.
pub(crate) fn rise_on_the_way(normal: Axis, [retract, clear]: [f64; 2], state: &mut State) {
    let at_retract = state.position.get(normal) <= retract;
    if at_retract && state.choices.quirk(quirk::rs274::CYCLE_RISE) {
        *state.position.get_mut(normal) = clear;
    }
}

/// Quirk rs274.tap-axes. Where a feed of G74 or G84 leads: outside of the XY plane its axes are in another order, and
/// the point is none the less where it should be.
pub(crate) fn tapped(state: &State) -> Position {
    let end = state.position;
    let Position { x, y, z, .. } = end;
    let mixed = state.choices.quirk(quirk::rs274::TAP_AXES);
    match state.modes.plane {
        Plane::Zx if mixed => Position { x: y, y: z, z: x, ..end },
        Plane::Yz if mixed => Position { x: z, y: x, z: y, ..end },
        Plane::Xy | Plane::Zx | Plane::Yz | Plane::Uv | Plane::Wu | Plane::Vw => end,
    }
}

/// Quirk rs274.cycle-retract-from-initial. In incremental distance mode R counts from where the row of cycles began.
pub(crate) fn retract_from(position: f64, initial: f64, state: &State) -> f64 {
    if state.choices.quirk(quirk::rs274::CYCLE_RETRACT_FROM_INITIAL) { initial } else { position }
}

/// Quirk rs274.cycle-negative-dwell. A negative dwell is accepted, unless it is -1.
pub(crate) fn negative_dwell(seconds: f64, state: &State) -> bool {
    whole(seconds) != Some(-1) && state.choices.quirk(quirk::rs274::CYCLE_NEGATIVE_DWELL)
}

/// Quirk rs274.tap-dwell-kept. A tap without P dwells as the last cycle did that had one.
pub(crate) fn dwell_of_tap(state: &State) -> Option<f64> {
    state.choices.quirk(quirk::rs274::TAP_DWELL_KEPT).then_some(state.cycle_dwell)
}

/// Quirk rs274.unused-q-minus-one. A Q-1 is none for a cycle either.
pub(crate) fn peck(words: &Words, state: &State) -> Option<f64> {
    let peck = words.letters.get(&'q').copied();
    let none = peck == Some(-1.0) && state.choices.quirk(quirk::rs274::UNUSED_Q_MINUS_ONE);
    peck.filter(|_| !none)
}
