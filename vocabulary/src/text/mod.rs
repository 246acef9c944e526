//! The text form of an outcome, which a person reads and writes.
//!
//! ```text
//! gaugeblock outcome 0
//! language rs274
//! start units=mm plane=xy distance=absolute
//! block main.ngc:1
//!   set feed_rate=100
//!   do straight_feed end=(x1 y2)
//!   state motion=feed position=(x1 y2)
//! end program_end
//! parameters 31=5
//! pin digital_out[0] time=0 value=1
//! ```
//!
//! One line per record, `name=value` separated by blanks; texts stand in double quotes with the escapes of JSON, and
//! so do file names and indices with other characters than letters, digits and a few signs. A field stands once in a
//! line, the state last below its block. A pin line is one change of one pin; time is virtual, in seconds.

mod line;
mod read;
mod toml;
mod write;

use std::fmt;

pub use line::Arguments;
pub(crate) use line::{index_text, quoted};
pub(crate) use toml::from_toml;

use crate::outcome::Outcome;

/// Why a text is not in the form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextError {
    /// Line of the text, from 1, where it is known.
    pub line: Option<usize>,
    /// What is wrong.
    pub message: String,
}

impl TextError {
    /// An error whose place is not known yet.
    pub fn new(message: impl Into<String>) -> Self {
        Self { line: None, message: message.into() }
    }

    fn at(self, line: usize) -> Self {
        Self { line: self.line.or(Some(line)), ..self }
    }
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

impl std::error::Error for TextError {}

impl Outcome {
    /// The text form. It ends with a line break.
    pub fn to_text(&self) -> String {
        write::outcome(self)
    }

    /// Reads the text form; what `to_text` wrote comes back equal.
    ///
    /// # Errors
    /// The first line that is not in the form, with its number.
    pub fn from_text(text: &str) -> Result<Self, TextError> {
        read::outcome(text)
    }
}
