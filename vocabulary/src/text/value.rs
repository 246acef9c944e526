//! The text form of single values: `100`, `clockwise`, `"free text"`, `(x1 y2.5)`.

use alloc::borrow::ToOwned as _;
use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::{String, ToString as _};
use alloc::vec::Vec;
use core::fmt;

use crate::error::TextError;
use crate::field::{Argument, Entry, Field, Scalar, Value};
use crate::position::{Axis, Position};
use crate::words::Word;

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Word(word) => f.write_str(word),
            Self::Text(text) => f.write_str(&quoted(text)),
            Self::Position(position) => write!(f, "{position}"),
        }
    }
}

impl Entry {
    /// The name as it is written: `feed_rate`, `spindle_speed[0]`.
    pub fn name(&self) -> String {
        match &self.index {
            Some(index) => format!("{}[{}]", self.field, index_text(index)),
            None => self.field.to_owned(),
        }
    }
}

/// A text in double quotes, with the escapes of JSON.
pub(crate) fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// An index as it is written between brackets: plain where possible, else quoted.
fn index_text(index: &str) -> String {
    plain_or_quoted(index, |c| matches!(c, '(' | ')'))
}

/// The name of a file: plain where possible, else quoted.
pub(super) fn name_text(name: &str) -> String {
    plain_or_quoted(name, |c| matches!(c, '[' | ']' | '/'))
}

fn plain_or_quoted(text: &str, besides: impl Fn(char) -> bool) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '-') || besides(c);
    if !text.is_empty() && text.chars().all(plain) { text.to_owned() } else { quoted(text) }
}

/// A single value that can be read from its text form.
pub trait FromText: Scalar {
    /// Reads what `Display` of [`Value`] wrote.
    ///
    /// # Errors
    /// The text is not a value of this type.
    fn from_text(text: &str) -> Result<Self, TextError>;
}

impl<T: Word> FromText for T {
    fn from_text(text: &str) -> Result<Self, TextError> {
        Self::ALL.iter().copied().find(|member| member.word() == text).ok_or_else(|| {
            let known: Vec<_> = Self::ALL.iter().map(|member| member.word()).collect();
            TextError::new(format!("{text} is none of {}", known.join(", ")))
        })
    }
}

impl FromText for f64 {
    fn from_text(text: &str) -> Result<Self, TextError> {
        let number: Option<Self> = text.parse().ok();
        number
            .filter(|number| number.is_finite() || matches!(text, "NaN" | "inf" | "-inf"))
            .ok_or_else(|| TextError::new(format!("not a number: {text}")))
    }
}

impl FromText for String {
    fn from_text(text: &str) -> Result<Self, TextError> {
        serde_json::from_str(text)
            .map_err(|_| TextError::new(format!("not a text in double quotes: {text}")))
    }
}

impl FromText for bool {
    fn from_text(text: &str) -> Result<Self, TextError> {
        match text {
            "yes" => Ok(true),
            "no" => Ok(false),
            _ => Err(TextError::new(format!("neither yes nor no: {text}"))),
        }
    }
}

macro_rules! integers {
    ($($type:ty)*) => {$(
        impl FromText for $type {
            fn from_text(text: &str) -> Result<Self, TextError> {
                text.parse().map_err(|_| {
                    TextError::new(format!("not a whole number that fits here: {text}"))
                })
            }
        }
    )*};
}
integers!(i32 u32 u8);

impl FromText for Position {
    fn from_text(text: &str) -> Result<Self, TextError> {
        let wrong =
            |what: &str| TextError::new(format!("{what} in a position like (x1 y2): {text}"));
        let inner = text
            .strip_prefix('(')
            .and_then(|rest| rest.strip_suffix(')'))
            .ok_or_else(|| wrong("the parentheses are missing"))?;
        let mut position = Self::default();
        let mut axes = BTreeSet::new();
        for part in inner.split_whitespace() {
            let letter = part.get(..1).ok_or_else(|| wrong("an axis letter is missing"))?;
            let axis = Axis::from_text(letter)?;
            if !axes.insert(axis) {
                return Err(wrong("an axis occurs twice"));
            }
            *position.get_mut(axis) = f64::from_text(&part[1..])?;
        }
        Ok(position)
    }
}

/// An argument of an effect that can be read from its text form.
pub trait ReadArgument: Argument {
    /// Reads it; `None` when the text has no such argument.
    ///
    /// # Errors
    /// It is missing though required, or unreadable.
    fn read(text: Option<&str>) -> Result<Self, TextError>;
}

impl<T: FromText> ReadArgument for T {
    fn read(text: Option<&str>) -> Result<Self, TextError> {
        T::from_text(text.ok_or_else(|| TextError::new("it is missing"))?)
    }
}

impl<T: FromText> ReadArgument for Option<T> {
    fn read(text: Option<&str>) -> Result<Self, TextError> {
        text.map(T::from_text).transpose()
    }
}

/// A record's field that can be read from its text form.
pub(crate) trait ReadField: Field {
    /// Reads one value into the field.
    ///
    /// # Errors
    /// An index where none belongs, none where one belongs, or an unreadable value.
    fn read(slot: &mut Option<Self>, index: Option<&str>, text: &str) -> Result<(), TextError>;
}

impl<T: FromText + PartialEq> ReadField for T {
    fn read(slot: &mut Option<Self>, index: Option<&str>, text: &str) -> Result<(), TextError> {
        if let Some(index) = index {
            return Err(TextError::new(format!("no index belongs here: [{index}]")));
        }
        *slot = Some(T::from_text(text)?);
        Ok(())
    }
}
