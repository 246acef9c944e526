//! What the pins were brought up to date for.

use gaugeblock_vocabulary::Switch;

use crate::rs274::modes::Spindle;

/// What the pins were brought up to date for, while no spindle was turning to an angle.
#[derive(Clone, Debug, PartialEq)]
pub struct PinSnapshot {
    /// The commanded turn and speed of each spindle.
    pub(crate) spindles: Vec<Spindle>,
    /// Speed override of each spindle.
    pub(crate) overrides: Vec<f64>,
    /// Mist coolant.
    pub(crate) mist: Switch,
    /// Flood coolant.
    pub(crate) flood: Switch,
    /// How many changes of pins there had been.
    pub(crate) changes: usize,
}
