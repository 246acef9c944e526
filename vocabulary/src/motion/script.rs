//! What an operator and the inputs of a machine do while it moves.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::text::TextError;

/// What happens at a servo cycle. It counts for that cycle's sample and those after it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MotionAction {
    /// The feed override; 1 is 100 %.
    FeedOverride(f64),
    /// The rapid override; 1 is 100 %.
    RapidOverride(f64),
    /// The adaptive feed input, -1 to 1; below zero the path is run backwards.
    AdaptiveFeed(f64),
    /// The feed stop input, which M53 lets act.
    FeedStop(bool),
    /// The operator holds the motion (`true`) or lets it go on (`false`), whatever the program says.
    Hold(bool),
    /// The operator aborts.
    Abort,
    /// A spindle turns so fast: turns per second.
    SpindleSpeed {
        /// Spindle number.
        spindle: u8,
        /// Turns per second.
        turns: f64,
    },
}

/// An action and its servo cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MotionEvent {
    /// The servo cycle, from 0 for the first sample.
    pub cycle: u32,
    /// What happens.
    pub action: MotionAction,
}

/// Actions in the order of their cycles. Before the first one overrides are at 1, nothing is held and no spindle's
/// speed is known.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MotionScript {
    /// What happens.
    pub events: Vec<MotionEvent>,
}

impl MotionScript {
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
    /// Not TOML, an unknown key, a value of the wrong kind, a number that is not finite, events out of order, or an
    /// override below zero.
    pub fn from_text(text: &str) -> Result<Self, TextError> {
        let script: Self = crate::text::from_toml(text)?;
        let places = script.events.windows(2).enumerate();
        for (place, pair) in places {
            if pair[1].cycle < pair[0].cycle {
                let message = format!("event {} comes before the one above it", place + 2);
                return Err(TextError::new(message));
            }
        }
        for (place, event) in script.events.iter().enumerate() {
            let (MotionAction::FeedOverride(factor) | MotionAction::RapidOverride(factor)) =
                event.action
            else {
                continue;
            };
            if factor < 0.0 {
                let message = format!("event {}: an override of {factor}, below zero", place + 1);
                return Err(TextError::new(message));
            }
        }
        Ok(script)
    }
}
