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

impl Measurement {
    /// The result in words, such as `0.005 mm accepted, 0.0050001 mm not`.
    pub fn result(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        match &self.measured {
            Measured::Edge { accepted, refused } => {
                format!("{}{unit} accepted, {}{unit} not", number(*accepted), number(*refused))
            }
            Measured::AtLeast(value) => format!("{}{unit} or more", number(*value)),
            Measured::Below(value) => format!("below {}{unit}", number(*value)),
            Measured::Value(value) => format!("{}{unit}", number(*value)),
            Measured::Nothing(why) => format!("not measured: {why}"),
        }
    }
}

/// A number with as many digits as it was searched with.
fn number(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 {
        return format!("{value:.0}");
    }
    // Five digits: the decimals of `1.2346e-3` are four and three more.
    let scientific = format!("{value:.4e}");
    let exponent = scientific.split_once('e').and_then(|(_, exponent)| exponent.parse().ok());
    let decimals = usize::try_from(4 - exponent.unwrap_or(0).clamp(-10, 4)).unwrap_or_default();
    let text = format!("{value:.decimals$}");
    if decimals == 0 {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
