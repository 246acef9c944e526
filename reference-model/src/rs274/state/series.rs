//! What a row of canned cycles leaves for the next one.

use gaugeblock_vocabulary::{LengthUnit, Motion, Plane, Position};

use crate::rs274::modes::Modes;

/// One or more cycles in a row, whatever they are: what the next one may leave out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Series {
    /// The cycle of the last block.
    pub(crate) motion: Motion,
    /// The number of the normal axis as it was programmed.
    pub(crate) depth: f64,
    /// The number R as it was programmed.
    pub(crate) retract: f64,
    /// P as it was programmed last for this cycle.
    pub(crate) dwell: Option<f64>,
    /// Q as it was programmed last for this cycle.
    pub(crate) peck: Option<f64>,
    /// Where the normal axis was before the first of them.
    pub(crate) initial: f64,
    /// What the initial level depends on: values of the first block.
    pub(crate) first: SeriesFrame,
    /// What the other numbers depend on: values of the last block.
    pub(crate) last: SeriesFrame,
}

/// What the numbers of a cycle depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SeriesFrame {
    /// Selected plane.
    pub(crate) plane: Plane,
    /// Length unit.
    pub(crate) unit: LengthUnit,
    /// Where the program's zero is on the machine: with another one the initial level is another number.
    pub(crate) zero: Position,
}

impl SeriesFrame {
    /// What numbers that are programmed now depend on.
    pub(crate) fn of(modes: &Modes) -> Self {
        let zero = modes.machine_point(Position::default());
        Self { plane: modes.plane, unit: modes.units, zero }
    }
}
