//! Samples as a table that a person or a spreadsheet reads.
//!
//! ```text
//! # gaugeblock samples 0 period=0.001 resolution=0
//! x,y,z,digital_out[0]
//! 0,0,0,0
//! 0.001,0,0,1
//! ```
//!
//! The first line says form, version, seconds between samples, and how far a written position may be from the
//! commanded one. The second names the columns. Numbers are written so that they come back bit by bit.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt::Write as _;

use super::samples::{Column, Samples, SamplesError, can_be};

/// What the first line begins with.
const HEAD: &str = "# gaugeblock samples 0 ";

impl Samples {
    /// The table.
    pub fn to_csv(&self) -> String {
        let mut text = self.csv_header();
        for row in self.rows() {
            push_csv_row(row, &mut text);
        }
        text
    }

    /// The first two lines of the table.
    pub fn csv_header(&self) -> String {
        let names: Vec<_> = self.columns().iter().map(ToString::to_string).collect();
        let (period, resolution, names) = (self.period(), self.resolution(), names.join(","));
        format!("{HEAD}period={period} resolution={resolution}\n{names}\n")
    }

    /// Reads the table; what `to_csv` wrote comes back equal.
    ///
    /// # Errors
    /// The first line that is not in the form, with its number.
    pub fn from_csv(text: &str) -> Result<Self, SamplesError> {
        let mut lines = text.lines().enumerate().map(|(place, line)| (place + 1, line));
        let mut next = |what: &str| {
            lines
                .next()
                .ok_or_else(|| SamplesError::at("end of file", format!("{what} is missing")))
        };
        let (_, head) = next("the line that says what this is")?;
        let (period, resolution) = head.strip_prefix(HEAD).and_then(settings).ok_or_else(|| {
            SamplesError::at("line 1", format!("not `{HEAD}period=… resolution=…`"))
        })?;
        let at = |line: usize| {
            move |error: SamplesError| SamplesError::at(line_name(line), error.message)
        };
        can_be(period, resolution).map_err(at(1))?;
        let (_, names) = next("the line of the columns")?;
        let columns = columns(names)?;
        let mut samples = Self::new(period, resolution, columns).map_err(at(2))?;
        let mut row = Vec::new();
        for (number, line) in lines {
            row.clear();
            for cell in line.split(',') {
                let value = cell.parse().map_err(|_| {
                    SamplesError::at(line_name(number), format!("not a number: {cell}"))
                })?;
                row.push(value);
            }
            samples.push(&row).map_err(at(number))?;
        }
        Ok(samples)
    }
}

/// Appends the line of a sample to a table.
pub fn push_csv_row(row: &[f64], text: &mut String) {
    for (place, value) in row.iter().enumerate() {
        let comma = if place == 0 { "" } else { "," };
        let _infallible = write!(text, "{comma}{value}");
    }
    text.push('\n');
}

fn line_name(number: usize) -> String {
    format!("line {number}")
}

fn settings(rest: &str) -> Option<(f64, f64)> {
    let (period, resolution) = rest.split_once(' ')?;
    let period = period.strip_prefix("period=")?.parse().ok()?;
    let resolution = resolution.strip_prefix("resolution=")?.parse().ok()?;
    Some((period, resolution))
}

fn columns(names: &str) -> Result<Vec<Column>, SamplesError> {
    let column = |name: &str| {
        Column::from_name(name)
            .ok_or_else(|| SamplesError::at("line 2", format!("there is no column named {name}")))
    };
    names.split(',').map(column).collect()
}
