//! Values of words: integers and ranges.

use alloc::format;

use gaugeblock_vocabulary::FaultKind;

use crate::math;

use super::refusal::{Refusal, refuse};

/// A value that is close to an integer (11.4.2.4).
pub(crate) fn integer(value: f64, word: &str) -> Result<i32, Refusal> {
    let Some(number) = math::near_integer(value) else {
        return refuse(FaultKind::NotAnInteger, format!("{word} is not an integer"));
    };
    i32::try_from(number)
        .or_else(|_| refuse(FaultKind::WordOutOfRange, format!("{word} is too large")))
}

/// An integer within a range.
pub(crate) fn integer_in(
    value: f64,
    lowest: i32,
    highest: i32,
    word: &str,
) -> Result<i32, Refusal> {
    let number = integer(value, word)?;
    if (lowest..=highest).contains(&number) {
        Ok(number)
    } else {
        refuse(FaultKind::WordOutOfRange, format!("{word} must be {lowest} to {highest}"))
    }
}

/// A value that is zero or greater.
pub(crate) fn not_negative(value: f64, word: &str) -> Result<f64, Refusal> {
    if value >= 0.0 {
        Ok(value)
    } else {
        refuse(FaultKind::WordOutOfRange, format!("{word} is negative"))
    }
}
