//! What a machine's axes can do.

use alloc::collections::BTreeMap;

use crate::position::Axis;
use crate::scenario::AxisLimits;

/// What a machine's axes can do, and how often a controller commands them.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MotionLimits {
    /// Seconds of a servo cycle.
    pub period: f64,
    /// Limits by axis in millimetres, degrees and seconds. Of what is not listed nothing is known.
    pub axes: BTreeMap<Axis, AxisLimits>,
}
