//! Reading TOML, the text form of scenarios.

use std::ops::Range;

use ::toml::Spanned;
use ::toml::de::{DeTable, DeValue, Error};
use serde::de::DeserializeOwned;

use super::TextError;

/// Reads a value whose numbers are all finite: TOML has words for infinity, this vocabulary has not.
pub(crate) fn from_toml<T: DeserializeOwned>(text: &str) -> Result<T, TextError> {
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
