//! The JSON form of values by index: an object whose names are the indices.

use alloc::string::ToString as _;
use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;
use core::str::FromStr;

use serde::de::{Error, MapAccess, Visitor};
use serde::ser::SerializeMap as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::indexed::Indexed;
use crate::json::number::{JsonValue, Written};
use crate::sorted::Sorted;

impl<K: fmt::Display, T: JsonValue> Serialize for Indexed<K, T> {
    /// By the texts of the indices, in their order.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if let [(index, value)] = self.0.as_slice() {
            let mut map = serializer.serialize_map(Some(1))?;
            map.serialize_entry(&index.to_string(), &Written(value))?;
            return map.end();
        }
        let mut named: Vec<_> =
            self.0.iter().map(|(index, value)| (index.to_string(), Written(value))).collect();
        named.sort_by(|(one, _), (other, _)| one.cmp(other));
        serializer.collect_map(named)
    }
}

impl<'de, K, T> Deserialize<'de> for Indexed<K, T>
where
    K: Ord + fmt::Display + FromStr,
    T: JsonValue,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Members(PhantomData))
    }
}

impl<K, T> JsonValue for Indexed<K, T>
where
    K: Ord + fmt::Display + FromStr,
    T: JsonValue,
{
    type Read = Self;

    fn of(read: Self) -> Self {
        read
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.serialize(serializer)
    }

    fn is_finite(&self) -> bool {
        self.0.values().all(JsonValue::is_finite)
    }
}

/// Reads the members of the object.
struct Members<K, T>(PhantomData<(K, T)>);

impl<'de, K, T> Visitor<'de> for Members<K, T>
where
    K: Ord + fmt::Display + FromStr,
    T: JsonValue,
{
    type Value = Indexed<K, T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object whose names are indices")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut values = Sorted::new();
        while let Some(Index(index)) = map.next_key()? {
            values.insert(index, T::of(map.next_value()?));
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
        Indexed::<K, ()>::index_from_text(text).map(Index).map_err(E::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_are_sorted_by_text_and_have_one_spelling() {
        let indexed: Indexed<u32, f64> = [(31, 1.0), (5220, 2.0), (7, 3.0)].into_iter().collect();
        let text = serde_json::to_string(&indexed).unwrap();
        assert_eq!(text, r#"{"31":1.0,"5220":2.0,"7":3.0}"#);
        assert_eq!(serde_json::from_str::<Indexed<u32, f64>>(&text).unwrap(), indexed);
        for wrong in [r#"{"031":1}"#, r#"{"+31":1}"#, r#"{"x":1}"#, r#"{"":1}"#] {
            assert!(serde_json::from_str::<Indexed<u32, f64>>(wrong).is_err(), "{wrong}");
        }
    }
}
