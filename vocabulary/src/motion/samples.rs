//! Servo samples: a table of numbers, a row per sample.

use alloc::borrow::ToOwned as _;
use alloc::format;
use alloc::string::{String, ToString as _};
use alloc::vec::Vec;
use core::fmt;

use crate::pin::Pin;
use crate::position::{Axis, Position};

/// What a column of samples holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Column {
    /// The commanded machine position of an axis, millimetres or degrees.
    Position(Axis),
    /// The element of the path that the controller reports as executing, from 0.
    Element,
    /// The line of the program that the controller reports as executing, from 1.
    Line,
    /// How many elements of the path it had been given when it computed the sample.
    Queued,
    /// The value of an output.
    Output(Pin),
    /// The speed of a spindle, turns per second.
    SpindleSpeed(u8),
}

impl fmt::Display for Column {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Position(axis) => write!(f, "{axis}"),
            Self::Element => f.write_str("element"),
            Self::Line => f.write_str("line"),
            Self::Queued => f.write_str("queued"),
            Self::Output(pin) => write!(f, "{pin}"),
            Self::SpindleSpeed(spindle) => write!(f, "spindle_turns[{spindle}]"),
        }
    }
}

impl Column {
    /// Reads a column's name, such as `x`, `element`, `digital_out[0]` or `spindle_turns[0]`.
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "element" => return Some(Self::Element),
            "line" => return Some(Self::Line),
            "queued" => return Some(Self::Queued),
            _ => (),
        }
        if let Some(axis) = Axis::from_word(name) {
            return Some(Self::Position(axis));
        }
        let spindle = name.strip_prefix("spindle_turns[").and_then(|rest| rest.strip_suffix(']'));
        if let Some(digits) = spindle {
            let spindle = digits.parse().ok().map(Self::SpindleSpeed);
            return spindle.filter(|column| column.to_string() == name);
        }
        name.parse().ok().map(Self::Output)
    }

    /// Whether its values are whole numbers from zero.
    pub(super) fn counts(self) -> bool {
        matches!(self, Self::Element | Self::Line | Self::Queued)
    }
}

/// Why something is not a table of samples, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SamplesError {
    /// Where: `line 4`, `byte 12`, `row 3`.
    pub place: String,
    /// What is wrong.
    pub message: String,
}

impl SamplesError {
    pub(super) fn at(place: impl fmt::Display, message: impl Into<String>) -> Self {
        Self { place: place.to_string(), message: message.into() }
    }
}

impl fmt::Display for SamplesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}

impl core::error::Error for SamplesError {}

/// Largest error of a sample, millimetres or degrees: a larger one hides what the laws of motion forbid.
const RESOLUTION_MAX: f64 = 0.1;

/// Refuses a period that is not above zero, and a resolution that is not between zero and its bound.
pub(super) fn can_be(period: f64, resolution: f64) -> Result<(), SamplesError> {
    let wrong = |message: String| Err(SamplesError::at("header", message));
    if !(period.is_finite() && period > 0.0) {
        return wrong(format!("a period of {period} seconds"));
    }
    if !(0.0..=RESOLUTION_MAX).contains(&resolution) {
        return wrong(format!("a resolution of {resolution:?}; expected 0 to {RESOLUTION_MAX:?}"));
    }
    Ok(())
}

/// What a controller commanded, sample by sample, evenly in time.
///
/// **Invariant:** every number is finite, every row has a value for each column, no column occurs twice.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    period: f64,
    resolution: f64,
    columns: Vec<Column>,
    values: Vec<f64>,
}

impl Samples {
    /// No sample yet.
    ///
    /// The period is in seconds. The resolution is how far a recorded position may be from the commanded one,
    /// millimetres and degrees: half of the last digit that is written; zero where positions are written in full.
    ///
    /// # Errors
    /// A period that is not above zero, a resolution below it, no column at all, or one that occurs twice.
    pub fn new(period: f64, resolution: f64, columns: Vec<Column>) -> Result<Self, SamplesError> {
        let wrong = |message: String| Err(SamplesError::at("header", message));
        can_be(period, resolution)?;
        if columns.is_empty() {
            return wrong("no column".to_owned());
        }
        for (place, column) in columns.iter().enumerate() {
            if columns[..place].contains(column) {
                return wrong(format!("the column {column} occurs twice"));
            }
        }
        Ok(Self { period, resolution, columns, values: Vec::new() })
    }

    /// Appends a sample: a value for each column, in their order.
    ///
    /// # Errors
    /// Too few or too many values, one that is not finite, or a count that is not a whole number from zero.
    pub fn push(&mut self, row: &[f64]) -> Result<(), SamplesError> {
        self.check_row(self.len(), row)?;
        self.values.extend_from_slice(row);
        Ok(())
    }

    /// Checks a sample with a number: a value for each column, in their order.
    ///
    /// # Errors
    /// As [`Self::push`].
    pub fn check_row(&self, number: usize, row: &[f64]) -> Result<(), SamplesError> {
        let wrong = |message: String| Err(SamplesError::at(format!("row {number}"), message));
        if row.len() != self.columns.len() {
            return wrong(format!("{} values for {} columns", row.len(), self.columns.len()));
        }
        for (column, value) in self.columns.iter().zip(row) {
            if !value.is_finite() {
                return wrong(format!("{column} is {value}"));
            }
            if column.counts() && (*value < 0.0 || *value % 1.0 != 0.0) {
                return wrong(format!("{column} is {value}, not a count"));
            }
        }
        Ok(())
    }

    /// Period, resolution and columns, without a sample.
    #[must_use]
    pub fn without_rows(&self) -> Self {
        Self { columns: self.columns.clone(), values: Vec::new(), ..*self }
    }

    /// Seconds between two samples.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// How far a recorded position may be from the commanded one, millimetres and degrees.
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// What is recorded, in order.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Whether something is recorded.
    pub fn has(&self, column: Column) -> bool {
        self.columns.contains(&column)
    }

    /// How many samples there are.
    pub fn len(&self) -> usize {
        self.values.len() / self.columns.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The samples in order, each a value for each column.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.values.chunks_exact(self.columns.len())
    }

    /// All values of a column, if it is recorded.
    pub fn column(&self, column: Column) -> Option<Vec<f64>> {
        let place = self.columns.iter().position(|known| *known == column)?;
        Some(self.rows().map(|row| row[place]).collect())
    }

    /// The positions; an axis that is not recorded has its coordinate in `elsewhere`.
    pub fn positions(&self, elsewhere: Position) -> Vec<Position> {
        let axes: Vec<(usize, Axis)> = self.columns.iter().enumerate().filter_map(axis).collect();
        let position = |row: &[f64]| {
            let mut position = elsewhere;
            for (place, axis) in &axes {
                *position.get_mut(*axis) = row[*place];
            }
            position
        };
        self.rows().map(position).collect()
    }
}

fn axis((place, column): (usize, &Column)) -> Option<(usize, Axis)> {
    match column {
        Column::Position(axis) => Some((place, *axis)),
        Column::Element
        | Column::Line
        | Column::Queued
        | Column::Output(_)
        | Column::SpindleSpeed(_) => None,
    }
}
