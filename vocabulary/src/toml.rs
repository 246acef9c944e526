//! The TOML form of scenarios, paths, limits and scripts.

use alloc::borrow::ToOwned as _;
use alloc::format;
use alloc::string::{String, ToString as _};
use core::ops::Range;

use ::toml::Spanned;
use ::toml::de::{DeTable, DeValue, Error};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::TextError;
use crate::motion::{MotionAction, MotionLimits, MotionScript, ProgrammedPath};
use crate::scenario::Scenario;

impl Scenario {
    /// The TOML form.
    ///
    /// # Errors
    /// A value that TOML cannot hold.
    pub fn to_text(&self) -> Result<String, TextError> {
        write(self)
    }

    /// Reads the TOML form.
    ///
    /// ```
    /// use gaugeblock_vocabulary::Scenario;
    ///
    /// let scenario = Scenario::from_text("[program]\nmain = 'm2'\n")?;
    /// assert_eq!(scenario, Scenario::of("m2"));
    /// # Ok::<(), gaugeblock_vocabulary::TextError>(())
    /// ```
    ///
    /// # Errors
    /// Not TOML, an unknown key, a value of the wrong kind, or a number that is not finite, with its line.
    pub fn from_text(text: &str) -> Result<Self, TextError> {
        read(text)
    }
}

impl MotionLimits {
    /// The TOML form.
    ///
    /// # Errors
    /// A value that TOML cannot hold.
    pub fn to_text(&self) -> Result<String, TextError> {
        write(self)
    }

    /// Reads the TOML form.
    ///
    /// # Errors
    /// Not TOML, an unknown key, a value of the wrong kind, a number that is not finite, a period or a limit that is
    /// not above zero.
    pub fn from_text(text: &str) -> Result<Self, TextError> {
        let limits: Self = read(text)?;
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

impl ProgrammedPath {
    /// The TOML form.
    ///
    /// # Errors
    /// A value that TOML cannot hold.
    pub fn to_text(&self) -> Result<String, TextError> {
        write(self)
    }

    /// Reads the TOML form.
    ///
    /// # Errors
    /// Not TOML, an unknown key, a value of the wrong kind, or a number that is not finite, with its line.
    pub fn from_text(text: &str) -> Result<Self, TextError> {
        read(text)
    }
}

impl MotionScript {
    /// The TOML form.
    ///
    /// # Errors
    /// A value that TOML cannot hold.
    pub fn to_text(&self) -> Result<String, TextError> {
        write(self)
    }

    /// Reads the TOML form.
    ///
    /// # Errors
    /// Not TOML, an unknown key, a value of the wrong kind, a number that is not finite, events out of order, or an
    /// override below zero.
    pub fn from_text(text: &str) -> Result<Self, TextError> {
        let script: Self = read(text)?;
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

/// Writes a value.
fn write<T: Serialize>(value: &T) -> Result<String, TextError> {
    ::toml::to_string_pretty(value).map_err(|error| TextError::new(error.to_string()))
}

/// Reads a value whose numbers are all finite: TOML has words for infinity, this vocabulary has not.
fn read<T: DeserializeOwned>(text: &str) -> Result<T, TextError> {
    let refused = |error: Error| TextError {
        line: error.span().map(|span| line_at(text, &span)),
        message: error.message().to_owned(),
    };
    let table = DeTable::parse(text).map_err(refused)?;
    if let Some(span) = table.get_ref().values().find_map(not_finite) {
        let number = text.get(span.clone()).unwrap_or_default();
        return Err(
            TextError::new(format!("not a finite number: {number}")).at(line_at(text, &span))
        );
    }
    ::toml::from_str(text).map_err(refused)
}

fn line_at(text: &str, span: &Range<usize>) -> usize {
    text.bytes().take(span.start).filter(|byte| *byte == b'\n').count() + 1
}

fn not_finite(value: &Spanned<DeValue<'_>>) -> Option<Range<usize>> {
    match value.get_ref() {
        DeValue::Float(float) => {
            let number: Option<f64> = float.as_str().parse().ok();
            number.filter(|number| !number.is_finite()).map(|_| value.span())
        }
        DeValue::Array(values) => values.iter().find_map(not_finite),
        DeValue::Table(table) => table.values().find_map(not_finite),
        DeValue::String(_) | DeValue::Integer(_) | DeValue::Boolean(_) | DeValue::Datetime(_) => {
            None
        }
    }
}
