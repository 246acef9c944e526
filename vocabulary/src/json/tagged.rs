//! Objects that name their variant in one of their members, such as `{"effect": "dwell", "seconds": 1}`.
//!
//! They are read in one pass if that member is the first. The code that serde derives for them buffers all members
//! before it reads any, and outcomes consist of such objects.

use alloc::borrow::Cow;
use alloc::borrow::ToOwned as _;
use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;

use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, MapDeserializer, StrDeserializer};
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Error, IntoDeserializer, MapAccess, VariantAccess,
    Visitor,
};
use serde_json::Value;

/// Reads an object whose member `tag` names the variant of `T`, which would itself be read from an object with one
/// member of that name.
pub(crate) fn read<'de, D, T>(deserializer: D, tag: &'static str) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de>,
{
    deserializer.deserialize_map(Object { tag, read: PhantomData })
}

struct Object<T> {
    tag: &'static str,
    read: PhantomData<T>,
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for Object<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an object with `{}`", self.tag)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<T, A::Error> {
        let first = map.next_key::<Text<'de>>()?;
        if let Some(Text(name)) = &first
            && name == self.tag
        {
            let Text(variant) = map.next_value()?;
            return T::deserialize(Variant { variant, tag: self.tag, members: map });
        }
        let (mut variant, mut members) = (None, Vec::new());
        let mut next = first;
        while let Some(Text(name)) = next {
            if name != self.tag {
                members.push((name.into_owned(), map.next_value::<Value>()?));
            } else if variant.replace(map.next_value::<Text<'de>>()?).is_some() {
                return Err(A::Error::duplicate_field(self.tag));
            }
            next = map.next_key()?;
        }
        let Text(variant) = variant.ok_or_else(|| A::Error::missing_field(self.tag))?;
        let members = MapDeserializer::new(members.into_iter());
        T::deserialize(Variant { variant, tag: self.tag, members }).map_err(A::Error::custom)
    }
}

/// A text that is copied only where it has to be.
struct Text<'de>(Cow<'de, str>);

impl<'de> Deserialize<'de> for Text<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visit;

        impl<'de> Visitor<'de> for Visit {
            type Value = Text<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a text")
            }

            fn visit_borrowed_str<E>(self, text: &'de str) -> Result<Text<'de>, E> {
                Ok(Text(Cow::Borrowed(text)))
            }

            fn visit_str<E>(self, text: &str) -> Result<Text<'de>, E> {
                Ok(Text(Cow::Owned(text.to_owned())))
            }
        }

        deserializer.deserialize_str(Visit)
    }
}

/// A variant by name, and the members that are its own.
struct Variant<'de, A> {
    variant: Cow<'de, str>,
    tag: &'static str,
    members: A,
}

impl<'de, A: MapAccess<'de>> Deserializer<'de> for Variant<'de, A> {
    type Error = A::Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, A::Error> {
        visitor.visit_enum(self)
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf
        option unit unit_struct newtype_struct
        seq tuple tuple_struct map struct enum identifier ignored_any
    }
}

impl<'de, A: MapAccess<'de>> EnumAccess<'de> for Variant<'de, A> {
    type Error = A::Error;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), A::Error> {
        let name: StrDeserializer<'_, A::Error> = (*self.variant).into_deserializer();
        let variant = seed.deserialize(name)?;
        Ok((variant, self))
    }
}

impl<'de, A: MapAccess<'de>> VariantAccess<'de> for Variant<'de, A> {
    type Error = A::Error;

    fn unit_variant(mut self) -> Result<(), A::Error> {
        let other = self.members.next_key::<Text<'de>>()?;
        let unknown = |Text(name)| Err(A::Error::unknown_field(&name, &[]));
        other.map_or(Ok(()), unknown)
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, A::Error> {
        seed.deserialize(MapAccessDeserializer::new(self.members))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, _: V) -> Result<V::Value, A::Error> {
        Err(A::Error::custom(format_args!("`{}` names a list", self.tag)))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, A::Error> {
        visitor.visit_map(self.members)
    }
}
