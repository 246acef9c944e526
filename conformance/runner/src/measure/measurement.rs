//! The result of a measurement.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The measured value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Measured {
    /// The edge is between the two.
    Edge {
        /// The last value that was accepted.
        accepted: f64,
        /// The first value that was not.
        refused: f64,
    },
    /// The largest value that was tried is accepted.
    AtLeast(f64),
    /// The smallest value that was tried is refused.
    Below(f64),
    /// A value that is not an edge, such as a distance.
    Value(f64),
    /// Nothing was measured, for this reason.
    Nothing(String),
}

/// A measurement of a controller.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Measurement {
    /// Its name, such as `arc-end-radius-10`.
    pub id: String,
    /// A phrase that names the quantity.
    pub title: String,
    /// The unit; empty for a count.
    pub unit: String,
    /// The result.
    pub measured: Measured,
    /// How many programs were run.
    pub runs: u32,
    /// The program at the edge: the first that is refused, or else the last that ran.
    pub program: String,
}
