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
                let written = |digits| [number(*accepted, digits), number(*refused, digits)];
                let differ = |[accepted, refused]: &[String; 2]| accepted != refused;
                let of = (DIGITS..=MOST_DIGITS).map(written).find(differ);
                let [accepted, refused] = of.unwrap_or_else(|| written(MOST_DIGITS));
                format!("{accepted}{unit} accepted, {refused}{unit} not")
            }
            Measured::AtLeast(value) => format!("{}{unit} or more", number(*value, DIGITS)),
            Measured::Below(value) => format!("below {}{unit}", number(*value, DIGITS)),
            Measured::Value(value) => format!("{}{unit}", number(*value, DIGITS)),
            Measured::Nothing(why) => format!("not measured: {why}"),
        }
    }
}

/// How many digits a number is written with, where both sides of an edge differ then.
const DIGITS: usize = 5;

/// The most digits that a number is written with.
const MOST_DIGITS: usize = 15;

/// A number with so many significant digits.
fn number(value: f64, digits: usize) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 {
        return format!("{value:.0}");
    }
    // Of five digits, the decimals of `1.2346e-3` are four and three more.
    let scientific = format!("{value:.*e}", digits - 1);
    let exponent = scientific.split_once('e').and_then(|(_, exponent)| exponent.parse().ok());
    let exponent: i32 = exponent.unwrap_or(0);
    let most = i32::try_from(digits).unwrap_or(i32::MAX) - 1;
    let decimals = usize::try_from(most - exponent.clamp(-10, most)).unwrap_or_default();
    let text = format!("{value:.decimals$}");
    if decimals == 0 {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::{Measured, Measurement};

    #[test]
    fn both_sides_of_an_edge_differ() {
        for ([accepted, refused], expected) in [
            ([1.000_999_6, 1.001_000_1], "1.0009996 mm accepted, 1.0010001 mm not"),
            ([0.005, 0.005_1], "0.005 mm accepted, 0.0051 mm not"),
            ([10.0, 11.0], "10 mm accepted, 11 mm not"),
            ([1.234_567e-7, 1.234_6e-6], "0.00000012346 mm accepted, 0.0000012346 mm not"),
        ] {
            let measurement = Measurement {
                id: String::new(),
                title: String::new(),
                unit: "mm".to_owned(),
                measured: Measured::Edge { accepted, refused },
                runs: 0,
                program: String::new(),
            };
            assert_eq!(measurement.result(), expected);
        }
    }
}
