//! How bad a divergence is.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::certify::RuleDivergence;

/// How bad a divergence is, the worst first.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum Severity {
    /// A motion is wrong, missing, or there although the program asks for none.
    Motion,
    /// A spindle, a tool, coolant or an output does something else.
    Output,
    /// A mode, a position or a parameter has another value.
    State,
    /// A lawful program is refused.
    Refused,
    /// A program is accepted that is not lawful.
    Accepted,
    /// A message has other words.
    Words,
}

/// Effects that move axes.
const MOTIONS: [&str; 7] = [
    "straight_traverse",
    "straight_feed",
    "arc_feed",
    "nurbs_feed",
    "straight_probe",
    "rigid_tap",
    "dwell",
];

/// Effects that print a text.
const WORDS: [&str; 5] = ["message", "messages", "output", "warnings", "log_open"];

impl Severity {
    /// Every one, the worst first.
    pub const ALL: [Self; 6] =
        [Self::Motion, Self::Output, Self::State, Self::Refused, Self::Accepted, Self::Words];

    /// As a heading.
    pub fn heading(self) -> &'static str {
        match self {
            Self::Motion => "wrong, missing or extra motion",
            Self::Output => "wrong output, spindle or tool",
            Self::State => "wrong state",
            Self::Refused => "refused, although lawful",
            Self::Accepted => "accepted, although not lawful",
            Self::Words => "other words of a message",
        }
    }

    /// How bad a divergence is, by its first difference, or by its failed assertion where nothing else differs.
    pub fn of(divergence: &RuleDivergence) -> Self {
        if let Some(traces) = &divergence.traces {
            let refuses = |trace: &str| {
                trace
                    .lines()
                    .rev()
                    .find_map(|line| line.strip_prefix("end "))
                    .map(|end| end.starts_with("fault"))
            };
            match (refuses(&traces.expected), refuses(&traces.found)) {
                (Some(true), Some(false)) => return Self::Accepted,
                (Some(false), Some(true)) => return Self::Refused,
                _ => {}
            }
        }
        match (&divergence.difference, &divergence.assertion) {
            (Some(difference), _) => Self::of_difference(difference),
            (None, Some((_, found))) if found.starts_with("the program is refused") => {
                Self::Refused
            }
            (None, Some((assertion, _))) => Self::of_text(assertion),
            (None, None) => Self::State,
        }
    }

    fn of_difference(difference: &str) -> Self {
        let field = difference.split(": expected ").next().unwrap_or_default();
        let field = field.rsplit(": ").next().unwrap_or_default();
        match field {
            "effect" => Self::of_text(difference),
            _ if field.starts_with("pin ") => Self::Output,
            _ => Self::State,
        }
    }

    /// By the effects that a text names.
    fn of_text(text: &str) -> Self {
        let has = |names: &[&str]| {
            let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
            words.into_iter().any(|word| names.contains(&word))
        };
        if text.starts_with("trajectory.") || has(&MOTIONS) {
            Self::Motion
        } else if has(&WORDS) {
            Self::Words
        } else if text.contains("effect") || text.contains("pin ") || text.contains("count ") {
            Self::Output
        } else {
            Self::State
        }
    }
}
