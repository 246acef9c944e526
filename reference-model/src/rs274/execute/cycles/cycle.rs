//! A cycle, and the steps that cycles are made of.

use gaugeblock_vocabulary::{Axis, Effect, Plane, SpindleTurn};

use crate::rs274::order::Phase;
use crate::rs274::state::State;
use crate::rs274::task::{Record, update_pins};

/// The operation of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// G81.
    Drill,
    /// G82.
    DrillDwell,
    /// G73.
    ChipBreaking,
    /// G83.
    Peck,
    /// G74.
    TapLeft,
    /// G84.
    TapRight,
    /// G85.
    Bore,
    /// G86.
    BoreSpindleStop,
    /// G89.
    BoreDwell,
    /// G87 and G88.
    Undefined,
}

/// The first, second and normal axis of a plane.
pub(crate) fn axes_of(plane: Plane) -> [Axis; 3] {
    match plane {
        Plane::Xy => [Axis::X, Axis::Y, Axis::Z],
        Plane::Zx => [Axis::Z, Axis::X, Axis::Y],
        Plane::Yz => [Axis::Y, Axis::Z, Axis::X],
        Plane::Uv => [Axis::U, Axis::V, Axis::W],
        Plane::Wu => [Axis::W, Axis::U, Axis::V],
        Plane::Vw => [Axis::V, Axis::W, Axis::U],
    }
}

/// A cycle of one block. All values are final: from its words, from earlier blocks of the series or defaults.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cycle {
    /// Its operation.
    pub(crate) kind: Kind,
    /// First, second and normal axis.
    pub(crate) axes: [Axis; 3],
    /// Coordinate of the normal axis before the first cycle of the series: "old Z".
    #[cfg_attr(not(feature = "dialects"), expect(dead_code, reason = "only a dialect reads it"))]
    pub(crate) initial: f64,
    /// R: the height at which feeding begins.
    pub(crate) retract: f64,
    /// Bottom of the hole.
    pub(crate) bottom: f64,
    /// The clear height, where the last move of each repeat ends.
    pub(crate) clear: f64,
    /// P: seconds at the bottom.
    pub(crate) dwell: f64,
    /// Whether there is a P.
    pub(crate) dwells: bool,
    /// Q: how much deeper each peck goes, active length unit.
    pub(crate) peck: f64,
    /// The spindle that $ names, 0 without it.
    pub(crate) spindle: usize,
}

/// A rapid move along one axis.
pub(crate) fn traverse_along(axis: Axis, to: f64, state: &mut State, record: &mut Record) {
    *state.position.get_mut(axis) = to;
    record.effect(state, Effect::StraightTraverse { end: state.position });
}

/// A feed move along one axis.
pub(crate) fn feed_along(axis: Axis, to: f64, state: &mut State, record: &mut Record) {
    *state.position.get_mut(axis) = to;
    record.effect(state, Effect::StraightFeed { end: state.position });
}

/// Starts or stops the spindle of the cycle. The spindle's pins change at once.
pub(super) fn turn_spindle(turn: SpindleTurn, cycle: &Cycle, state: &mut State) {
    state.dialect().set_turn(turn, cycle.spindle, state);
    update_pins(state, Some(Phase::Motion));
}
