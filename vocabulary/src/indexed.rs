//! Values of a record's field by index.

use std::collections::BTreeMap;
use std::fmt::{self, Write as _};
use std::marker::PhantomData;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::de::{Error, MapAccess, Visitor};
use serde::ser::SerializeMap as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::field::{Entry, Field, Scalar};
use crate::sorted::Sorted;
use crate::text::TextError;

/// Several values of one field, by index (spindle number, parameter name).
///
/// In JSON and TOML an object whose names are the indices. A record's field in which nothing stands is the same as an
/// absent one, and is written as absent.
#[derive(Clone, Debug, PartialEq, JsonSchema)]
#[schemars(inline, with = "BTreeMap<String, T>", bound = "T: JsonSchema")]
pub struct Indexed<K, T>(pub Sorted<K, T>);

impl<K: fmt::Display, T: Serialize> Serialize for Indexed<K, T> {
    /// By the texts of the indices, in their order.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if let [(index, value)] = self.0.as_slice() {
            let mut map = serializer.serialize_map(Some(1))?;
            map.serialize_entry(&index.to_string(), value)?;
            return map.end();
        }
        let mut named: Vec<_> =
            self.0.iter().map(|(index, value)| (index.to_string(), value)).collect();
        named.sort_by(|(one, _), (other, _)| one.cmp(other));
        serializer.collect_map(named)
    }
}

impl<'de, K, T> Deserialize<'de> for Indexed<K, T>
where
    K: Ord + fmt::Display + FromStr,
    T: Deserialize<'de>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Members(PhantomData))
    }
}

/// Reads what stands by index.
struct Members<K, T>(PhantomData<(K, T)>);

impl<'de, K, T> Visitor<'de> for Members<K, T>
where
    K: Ord + fmt::Display + FromStr,
    T: Deserialize<'de>,
{
    type Value = Indexed<K, T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object whose names are indices")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut values = Sorted::new();
        while let Some(Index(index)) = map.next_key()? {
            values.insert(index, map.next_value()?);
        }
        Ok(Indexed(values))
    }
}

/// An index as the name of a member.
struct Index<K>(K);

impl<'de, K: fmt::Display + FromStr> Deserialize<'de> for Index<K> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_str(Name(PhantomData))
    }
}

struct Name<K>(PhantomData<K>);

impl<K: fmt::Display + FromStr> Visitor<'_> for Name<K> {
    type Value = Index<K>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an index")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Index<K>, E> {
        parse_index(text).map(Index).map_err(E::custom)
    }
}

/// Reads an index in its one spelling: `01` and `1` would fall together.
fn parse_index<K: fmt::Display + FromStr>(text: &str) -> Result<K, TextError> {
    let index: Option<K> = text.parse().ok();
    index
        .filter(|index| is_spelt(index, text))
        .ok_or_else(|| TextError::new(format!("this is no index of the field: {text}")))
}

/// Whether a value is written exactly so.
fn is_spelt(value: &impl fmt::Display, text: &str) -> bool {
    struct Rest<'a>(&'a str);

    impl fmt::Write for Rest<'_> {
        fn write_str(&mut self, part: &str) -> fmt::Result {
            self.0 = self.0.strip_prefix(part).ok_or(fmt::Error)?;
            Ok(())
        }
    }

    let mut rest = Rest(text);
    write!(rest, "{value}").is_ok() && rest.0.is_empty()
}

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

    fn read(slot: &mut Option<Self>, index: Option<&str>, text: &str) -> Result<(), TextError> {
        let index = index.ok_or_else(|| TextError::new("an index is missing, as in name[0]"))?;
        let index = parse_index(index)?;
        slot.get_or_insert_with(Self::default).0.insert(index, T::from_text(text)?);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_stand_in_the_order_of_their_texts_and_have_one_spelling() {
        let indexed: Indexed<u32, f64> = [(31, 1.0), (5220, 2.0), (7, 3.0)].into_iter().collect();
        let text = serde_json::to_string(&indexed).unwrap();
        assert_eq!(text, r#"{"31":1.0,"5220":2.0,"7":3.0}"#);
        assert_eq!(serde_json::from_str::<Indexed<u32, f64>>(&text).unwrap(), indexed);
        for wrong in [r#"{"031":1}"#, r#"{"+31":1}"#, r#"{"x":1}"#, r#"{"":1}"#] {
            assert!(serde_json::from_str::<Indexed<u32, f64>>(wrong).is_err(), "{wrong}");
        }
    }
}
