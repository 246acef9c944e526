//! Values of a record's field by index.

use alloc::format;
use alloc::string::ToString as _;
use alloc::vec::Vec;
use core::fmt;
use core::str::FromStr;

use crate::error::TextError;
use crate::field::{Entry, Field, Scalar};
use crate::sorted::Sorted;
#[cfg(feature = "text")]
use crate::text::value::{FromText, ReadField};

/// Several values of one field, by index (spindle number, parameter name).
///
/// In JSON and TOML an object whose names are the indices. A record's field without values is the same as an absent
/// one, and is written as absent.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "schema",
    derive(schemars::JsonSchema),
    schemars(
        inline,
        with = "alloc::collections::BTreeMap<alloc::string::String, T>",
        bound = "T: schemars::JsonSchema"
    )
)]
pub struct Indexed<K, T>(pub Sorted<K, T>);

impl<K, T> Default for Indexed<K, T> {
    fn default() -> Self {
        Self(Sorted::new())
    }
}

impl<K: Ord, T> Indexed<K, T> {
    /// One value at one index.
    pub fn one(index: K, value: T) -> Self {
        Self(Sorted::from([(index, value)]))
    }
}

impl<K: fmt::Display + FromStr, T> Indexed<K, T> {
    /// Reads an index, which has one spelling: `1` is an index, `01` is not.
    ///
    /// # Errors
    /// The text is not what `Display` of an index writes.
    pub fn index_from_text(text: &str) -> Result<K, TextError> {
        let index: Option<K> = text.parse().ok();
        index
            .filter(|index| index.to_string() == text)
            .ok_or_else(|| TextError::new(format!("not an index of this field: {text}")))
    }
}

impl<K: Ord, T> FromIterator<(K, T)> for Indexed<K, T> {
    fn from_iter<I: IntoIterator<Item = (K, T)>>(values: I) -> Self {
        Self(values.into_iter().collect())
    }
}

impl<K: Ord + Clone + fmt::Display + FromStr, T: Scalar + PartialEq> Field for Indexed<K, T> {
    fn is_recorded(&self) -> bool {
        !self.0.is_empty()
    }

    fn entries(&self, field: &'static str, out: &mut Vec<Entry>) {
        out.extend(self.0.iter().map(|(index, value)| Entry {
            field,
            index: Some(index.to_string()),
            value: value.value(),
        }));
    }

    fn overlay(&mut self, change: &Self) {
        self.0.extend(change.0.iter().map(|(index, value)| (index.clone(), value.clone())));
    }

    fn since(&self, earlier: &Self) -> Option<Self> {
        let changed = self.0.iter().filter(|(index, value)| earlier.0.get(index) != Some(value));
        let changed: Self = changed.map(|(index, value)| (index.clone(), value.clone())).collect();
        (!changed.0.is_empty()).then_some(changed)
    }
}

#[cfg(feature = "text")]
impl<K: Ord + Clone + fmt::Display + FromStr, T: FromText + PartialEq> ReadField for Indexed<K, T> {
    fn read(slot: &mut Option<Self>, index: Option<&str>, text: &str) -> Result<(), TextError> {
        let index = index.ok_or_else(|| TextError::new("an index is missing, as in name[0]"))?;
        let index = Self::index_from_text(index)?;
        slot.get_or_insert_with(Self::default).0.insert(index, T::from_text(text)?);
        Ok(())
    }
}
