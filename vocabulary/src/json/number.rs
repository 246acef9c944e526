//! Numbers in the JSON form of outcomes, and the values that consist of them.
//!
//! JSON has no form for the numbers that a broken controller computes. The strings `"nan"`, `"inf"` and `"-inf"` stand
//! for them; null in place of a number, which JavaScript writes, reads as `"nan"`.

use alloc::string::String;
use core::fmt;

use serde::de::{DeserializeOwned, Error, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The texts for numbers that JSON cannot write.
pub(crate) const NOT_FINITE: [&str; 3] = ["nan", "inf", "-inf"];

/// A value with a JSON form: what serde derives for it, except that numbers need not be finite.
pub(crate) trait JsonValue: Sized {
    /// The type that is read.
    type Read: DeserializeOwned;

    /// The value that was read.
    fn of(read: Self::Read) -> Self;

    /// Writes the value.
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error>;

    /// Whether all of its numbers are finite.
    fn is_finite(&self) -> bool;
}

/// A number that need not be finite.
pub(crate) struct Number(f64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberVisitor).map(Self)
    }
}

struct NumberVisitor;

impl Visitor<'_> for NumberVisitor {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number")
    }

    fn visit_f64<E>(self, number: f64) -> Result<f64, E> {
        Ok(number)
    }

    #[expect(clippy::cast_precision_loss, reason = "JSON has one kind of number, and reads it so")]
    fn visit_i64<E>(self, number: i64) -> Result<f64, E> {
        Ok(number as f64)
    }

    #[expect(clippy::cast_precision_loss, reason = "JSON has one kind of number, and reads it so")]
    fn visit_u64<E>(self, number: u64) -> Result<f64, E> {
        Ok(number as f64)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<f64, E> {
        match text {
            "nan" => Ok(f64::NAN),
            "inf" => Ok(f64::INFINITY),
            "-inf" => Ok(f64::NEG_INFINITY),
            _ => Err(E::invalid_value(Unexpected::Str(text), &self)),
        }
    }

    fn visit_unit<E>(self) -> Result<f64, E> {
        Ok(f64::NAN)
    }
}

impl JsonValue for f64 {
    type Read = Number;

    fn of(Number(number): Number) -> Self {
        number
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let [nan, inf, minus_inf] = NOT_FINITE;
        if Self::is_finite(*self) {
            serializer.serialize_f64(*self)
        } else if self.is_nan() {
            serializer.serialize_str(nan)
        } else {
            serializer.serialize_str(if *self > 0.0 { inf } else { minus_inf })
        }
    }

    fn is_finite(&self) -> bool {
        Self::is_finite(*self)
    }
}

impl<T: JsonValue> JsonValue for Option<T> {
    type Read = Option<T::Read>;

    fn of(read: Self::Read) -> Self {
        read.map(T::of)
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Some(value) => value.write(serializer),
            None => serializer.serialize_none(),
        }
    }

    fn is_finite(&self) -> bool {
        self.as_ref().is_none_or(JsonValue::is_finite)
    }
}

/// Types that have a form of their own.
macro_rules! own_form {
    ($($type:ty, |$value:ident| $finite:expr;)*) => {$(
        impl $crate::json::number::JsonValue for $type {
            type Read = Self;

            fn of(read: Self) -> Self {
                read
            }

            fn write<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serde::Serialize::serialize(self, serializer)
            }

            fn is_finite(&self) -> bool {
                let $value = self;
                $finite
            }
        }
    )*};
}
pub(crate) use own_form;

own_form! {
    i32, |_any| true;
    u32, |_any| true;
    u8, |_any| true;
    bool, |_any| true;
    String, |_any| true;
}

/// A value that serde writes in its JSON form.
pub(crate) struct Written<'a, T>(pub(crate) &'a T);

impl<T: JsonValue> Serialize for Written<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.write(serializer)
    }
}

/// Writes a field.
pub(crate) fn write<T: JsonValue, S: Serializer>(
    value: &T,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    value.write(serializer)
}

/// Reads a field.
pub(crate) fn read<'de, T: JsonValue, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<T, D::Error> {
    T::Read::deserialize(deserializer).map(T::of)
}

/// Reads a field of a scenario: there all numbers are finite.
pub(crate) fn read_finite<'de, T: JsonValue, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<T, D::Error> {
    let value: T = read(deserializer)?;
    if value.is_finite() { Ok(value) } else { Err(D::Error::custom("not a finite number")) }
}

#[cfg(test)]
mod tests {
    use alloc::format;
    use alloc::string::ToString as _;

    use crate::{Effect, PinChange, Position, Rs274State, Scenario, Settings};

    #[test]
    fn number_that_is_not_finite_is_a_text() {
        for (number, text) in
            [(f64::NAN, r#""nan""#), (f64::INFINITY, r#""inf""#), (f64::NEG_INFINITY, r#""-inf""#)]
        {
            let settings = Settings {
                feed_rate: Some(number),
                tool_offset: Some(Position { y: number, ..Position::default() }),
                spindle_speed: Some([(0, number)].into_iter().collect()),
                ..Settings::default()
            };
            let form = format!(
                r#"{{"feed_rate":{text},"tool_offset":{{"y":{text}}},"spindle_speed":{{"0":{text}}}}}"#
            );
            assert_eq!(serde_json::to_string(&settings).unwrap(), form);
            let read: Settings = serde_json::from_str(&form).unwrap();
            assert_eq!(format!("{read:?}"), format!("{settings:?}"));
            let effect = Effect::Dwell { seconds: number };
            for form in [
                format!(r#"{{"effect":"dwell","seconds":{text}}}"#),
                format!(r#"{{"seconds":{text},"effect":"dwell"}}"#),
            ] {
                let read: Effect = serde_json::from_str(&form).unwrap();
                assert_eq!(format!("{read:?}"), format!("{effect:?}"));
            }
        }
    }

    #[test]
    fn null_reads_as_a_coordinate_that_is_no_number() {
        let end: Position = serde_json::from_str(r#"{"x":null}"#).unwrap();
        assert!(end.x.is_nan());
        let change = r#"{"time":0,"pin":"coolant_mist","value":null}"#;
        assert!(serde_json::from_str::<PinChange>(change).unwrap().value.is_nan());
        let state: Rs274State = serde_json::from_str(r#"{"parameter":{"31":null}}"#).unwrap();
        assert!(
            state.parameter.unwrap().0.get(&alloc::string::String::from("31")).unwrap().is_nan()
        );
    }

    #[test]
    fn another_text_is_no_number() {
        for text in ["NaN", "infinity", "1", ""] {
            let form = format!(r#"{{"feed_rate":"{text}"}}"#);
            assert!(serde_json::from_str::<Settings>(&form).is_err(), "{form}");
        }
    }

    #[test]
    fn scenario_has_finite_numbers_only() {
        for machine in
            [r#""parameters":{"31":"nan"}"#, r#""tools":[{"number":1,"offset":{"z":"inf"}}]"#]
        {
            let form = format!(r#"{{"program":{{"main":"m2"}},"machine":{{{machine}}}}}"#);
            let error = serde_json::from_str::<Scenario>(&form).unwrap_err().to_string();
            assert!(error.contains("not a finite number"), "{error}");
        }
        let form = r#"{"program":{"main":"m2"},"environment":{"probe":{"at":{"x":"nan"}}}}"#;
        assert!(serde_json::from_str::<Scenario>(form).is_err());
    }
}
