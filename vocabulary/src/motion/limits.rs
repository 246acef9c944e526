//! What a machine's axes can do.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::position::Axis;
use crate::scenario::AxisLimits;
use crate::text::TextError;

/// What a machine's axes can do, and how often a controller commands them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MotionLimits {
    /// Seconds of a servo cycle.
    pub period: f64,
    /// Limits by axis in millimetres, degrees and seconds. Of what is not listed nothing is known.
    pub axes: BTreeMap<Axis, AxisLimits>,
}

impl MotionLimits {
    /// The text form, which is TOML.
    ///
    /// # Errors
    /// A value that TOML cannot hold.
    pub fn to_text(&self) -> Result<String, TextError> {
        toml::to_string_pretty(self).map_err(|error| TextError::new(error.to_string()))
    }

    /// Reads the text form.
    ///
    /// # Errors
    /// Not TOML, an unknown key, a value of the wrong kind, a number that is not finite, a period or a limit that is
    /// not above zero.
    pub fn from_text(text: &str) -> Result<Self, TextError> {
        let limits: Self = crate::text::from_toml(text)?;
        if limits.period <= 0.0 {
            return Err(TextError::new("the servo period is not above zero"));
        }
        for (axis, limit) in &limits.axes {
            let each = [
                ("velocity", limit.velocity),
                ("acceleration", limit.acceleration),
                ("jerk", limit.jerk),
            ];
            for (name, value) in each {
                if value.is_some_and(|value| value <= 0.0) {
                    return Err(TextError::new(format!("the {name} of {axis} is not above zero")));
                }
            }
        }
        Ok(limits)
    }
}
