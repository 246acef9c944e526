//! How exactly a controller reports numbers, and the largest error that it may declare.
//!
//! A declared error makes a comparison less strict. It is bounded, so that no declaration can buy a verdict, and the
//! differences that it hides are masked: a value that differs by more than the table of tolerances, and by no more than
//! the declared error, is neither a divergence nor a match.

use std::fmt;

use gaugeblock_vocabulary::{Axis, Entry, LengthUnit, Settings, Value};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Largest error of a length that a controller may declare, millimetres.
pub const LENGTH_ERROR_MAX_MM: f64 = 0.1;
/// Largest error of an angle that a controller may declare, degrees.
pub const ANGLE_ERROR_MAX_DEGREES: f64 = 0.1;
/// Largest error of another number, such as a speed or a parameter, that a controller may declare.
pub const NUMBER_ERROR_MAX: f64 = 0.1;
/// Largest error in proportion to the number that a controller may declare: some steps of 32-bit numbers.
pub const RELATIVE_ERROR_MAX: f64 = 1e-6;
/// Longest time for which a pin may have to keep a value to be seen, seconds.
pub const PIN_PERIOD_MAX_S: f64 = 1.0;

/// The accuracy that a controller declares. Reports print it next to the verdicts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Accuracy {
    /// Largest absolute error of a number, in program units.
    pub absolute: f64,
    /// Largest error in proportion to the number.
    pub relative: f64,
    /// How long a pin keeps a value that is seen for sure, seconds.
    pub pin_period: f64,
}

impl Accuracy {
    /// Whether numbers are exact and each value of a pin is seen.
    pub fn is_exact(&self) -> bool {
        [self.absolute, self.relative, self.pin_period].iter().all(|error| *error <= 0.0)
    }

    /// Checks the bounds.
    ///
    /// # Errors
    /// The first number beyond its bound, with its name and the bound.
    pub fn check(&self) -> Result<(), String> {
        let lengths = LENGTH_ERROR_MAX_MM.min(ANGLE_ERROR_MAX_DEGREES).min(NUMBER_ERROR_MAX);
        for (name, error, bound, of) in [
            ("resolution", self.absolute, lengths, "millimetres or degrees"),
            ("relative_resolution", self.relative, RELATIVE_ERROR_MAX, "of the number"),
            ("clock.wall", self.pin_period, PIN_PERIOD_MAX_S, "seconds"),
        ] {
            if !(0.0..=bound).contains(&error) {
                return Err(format!("invalid `{name}`: {error:?}; expected 0 to {bound:?} {of}"));
            }
        }
        Ok(())
    }
}

impl fmt::Display for Accuracy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { absolute, relative, pin_period } = *self;
        let mut parts = Vec::new();
        if absolute > 0.0 {
            parts.push(format!("numbers within {absolute:?}"));
        }
        if relative > 0.0 {
            parts.push(format!("numbers within {relative:?} of their value"));
        }
        if pin_period > 0.0 {
            parts.push(format!("pins read every {pin_period:?} s"));
        }
        f.write_str(&if parts.is_empty() { "exact".to_owned() } else { parts.join(", ") })
    }
}

/// What a number measures. It bounds the error that counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A length, or a feed.
    Length,
    /// An angle.
    Angle,
    /// Something that is counted or numbered: a tool, an output, turns. It has no error.
    Count,
    /// Anything else: a speed, a time, a parameter.
    Number,
}

/// Settings, fields of the state and arguments of effects that are not lengths.
const QUANTITIES: [(&str, Quantity); 30] = [
    ("analog", Quantity::Count),
    ("angle", Quantity::Angle),
    ("back_angle", Quantity::Angle),
    ("call_level", Quantity::Count),
    ("code", Quantity::Count),
    ("common", Quantity::Number),
    ("digital", Quantity::Count),
    ("front_angle", Quantity::Angle),
    ("local", Quantity::Number),
    ("macro_level", Quantity::Count),
    ("modal_call", Quantity::Count),
    ("orientation", Quantity::Count),
    ("output", Quantity::Count),
    ("parameter", Quantity::Number),
    ("points", Quantity::Count),
    ("prepared_tool", Quantity::Count),
    ("read", Quantity::Number),
    ("rotation", Quantity::Angle),
    ("seconds", Quantity::Number),
    ("spindle", Quantity::Count),
    ("spindle_limit", Quantity::Number),
    ("spindle_speed", Quantity::Number),
    ("timeout", Quantity::Number),
    ("to", Quantity::Number),
    ("tool", Quantity::Count),
    ("turns", Quantity::Count),
    ("work_offset", Quantity::Count),
    ("a", Quantity::Angle),
    ("b", Quantity::Angle),
    ("c", Quantity::Angle),
];

impl Quantity {
    /// What a setting, a field of the state or an argument of an effect measures.
    pub fn of(name: &str) -> Self {
        let found = QUANTITIES.iter().find(|(other, _)| *other == name);
        found.map_or(Self::Length, |(_, quantity)| *quantity)
    }

    /// What a coordinate measures.
    pub fn of_axis(axis: Axis) -> Self {
        Self::of(axis.word())
    }
}

/// The error of the numbers in one comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    absolute: f64,
    relative: f64,
    unit: LengthUnit,
}

/// How two values compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Match {
    /// They are equal within the table of tolerances.
    Equal,
    /// The values differ by no more than the error that the controller declares, so that no verdict is possible.
    Hidden,
    /// They differ.
    Different,
}

impl Resolution {
    /// Exact numbers.
    pub const EXACT: Self = Self { absolute: 0.0, relative: 0.0, unit: LengthUnit::Millimetre };

    /// An error in program units, and one in proportion to the number, in a program with this length unit.
    pub const fn new(absolute: f64, relative: f64, unit: LengthUnit) -> Self {
        Self { absolute, relative, unit }
    }

    /// The absolute and the relative error of a quantity, within its bounds.
    pub fn error_of(self, quantity: Quantity) -> (f64, f64) {
        const MM_PER_INCH: f64 = 25.4;
        let bound = match (quantity, self.unit) {
            (Quantity::Length, LengthUnit::Millimetre) => LENGTH_ERROR_MAX_MM,
            (Quantity::Length, LengthUnit::Inch) => LENGTH_ERROR_MAX_MM / MM_PER_INCH,
            (Quantity::Angle, _) => ANGLE_ERROR_MAX_DEGREES,
            (Quantity::Count, _) => return (0.0, 0.0),
            (Quantity::Number, _) => NUMBER_ERROR_MAX,
        };
        (self.absolute.min(bound), self.relative.min(RELATIVE_ERROR_MAX))
    }

    /// Compares with the table of tolerances alone, then with this error.
    pub fn compare(self, are_equal: impl Fn(Self) -> bool) -> Match {
        if are_equal(Self::EXACT) {
            Match::Equal
        } else if (self.absolute > 0.0 || self.relative > 0.0) && are_equal(self) {
            Match::Hidden
        } else {
            Match::Different
        }
    }
}

/// The length unit among entries; millimetres if there is none.
pub(crate) fn unit_of(entries: &[Entry]) -> LengthUnit {
    let unit = entries.iter().find(|entry| entry.field == "units").map(|entry| &entry.value);
    let is_inch = |value: &Value| *value == Value::Word(LengthUnit::Inch.word().to_owned());
    if unit.is_some_and(is_inch) { LengthUnit::Inch } else { LengthUnit::Millimetre }
}

/// The length unit in force; millimetres if it is not known.
pub(crate) fn unit_in(settings: &Settings) -> LengthUnit {
    settings.units.unwrap_or(LengthUnit::Millimetre)
}

/// What is masked if a declared error hides a difference.
pub(crate) fn hidden(what: &str) -> String {
    format!("{what} within the declared resolution")
}

/// Whether this was masked because a declared error hides a difference.
pub fn is_hidden(masked: &str) -> bool {
    masked.ends_with("within the declared resolution")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_beyond_its_bound_is_refused_and_the_bound_is_named() {
        let exact = Accuracy::default();
        assert_eq!(exact.check(), Ok(()));
        assert!(exact.is_exact());
        for (accuracy, words) in [
            (
                Accuracy { absolute: 1e300, ..exact },
                "invalid `resolution`: 1e300; expected 0 to 0.1 millimetres or degrees",
            ),
            (
                Accuracy { absolute: f64::NAN, ..exact },
                "invalid `resolution`: NaN; expected 0 to 0.1 millimetres or degrees",
            ),
            (
                Accuracy { absolute: -1.0, ..exact },
                "invalid `resolution`: -1.0; expected 0 to 0.1 millimetres or degrees",
            ),
            (
                Accuracy { relative: 1e-3, ..exact },
                "invalid `relative_resolution`: 0.001; expected 0 to 1e-6 of the number",
            ),
            (
                Accuracy { pin_period: 1e300, ..exact },
                "invalid `clock.wall`: 1e300; expected 0 to 1.0 seconds",
            ),
        ] {
            assert_eq!(accuracy.check(), Err(words.to_owned()));
        }
    }

    #[test]
    fn error_is_bounded_per_quantity() {
        let coarse = Resolution::new(1e300, 1.0, LengthUnit::Inch);
        assert_eq!(coarse.error_of(Quantity::of("tool")), (0.0, 0.0));
        assert_eq!(coarse.error_of(Quantity::of("spindle_speed")), (0.1, 1e-6));
        assert_eq!(coarse.error_of(Quantity::of_axis(Axis::A)), (0.1, 1e-6));
        assert_eq!(coarse.error_of(Quantity::of_axis(Axis::X)), (0.1 / 25.4, 1e-6));
        assert_eq!(coarse.error_of(Quantity::of("feed_rate")), (0.1 / 25.4, 1e-6));
    }

    #[test]
    fn declared_accuracy_is_printed() {
        assert_eq!(Accuracy::default().to_string(), "exact");
        let accuracy = Accuracy { absolute: 0.0001, relative: 1e-7, pin_period: 0.01 };
        let text =
            "numbers within 0.0001, numbers within 1e-7 of their value, pins read every 0.01 s";
        assert_eq!(accuracy.to_string(), text);
    }
}
