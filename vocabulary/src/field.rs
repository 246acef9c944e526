//! How a value stands in a record: by name, in text, and as something that can be compared.
//!
//! A record (settings, state) is a set of optional fields. A field that is absent was not recorded, which means
//! *unchanged* in a sequence of records and *not shown* in the first. Records are folded with `overlay`.

use std::fmt;

use crate::position::Position;
use crate::text::TextError;

/// A value as it is compared and printed, whatever its type in the record.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A finite number; its unit is that of the field.
    Number(f64),
    /// A word of a closed list, such as `clockwise`.
    Word(String),
    /// Free text.
    Text(String),
    /// Nine coordinates.
    Position(Position),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Word(word) => f.write_str(word),
            Self::Text(text) => f.write_str(&crate::text::quoted(text)),
            Self::Position(position) => write!(f, "{position}"),
        }
    }
}

/// One named value of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The field's name, such as `feed_rate`.
    pub field: &'static str,
    /// Its index where the field has several values: a spindle, a parameter.
    pub index: Option<String>,
    /// The value.
    pub value: Value,
}

impl Entry {
    /// The name as it is written: `feed_rate`, `spindle_speed[0]`.
    pub fn name(&self) -> String {
        match &self.index {
            Some(index) => format!("{}[{}]", self.field, crate::text::index_text(index)),
            None => self.field.to_owned(),
        }
    }
}

/// A single value: number, word, text or position.
pub trait Scalar: Clone {
    /// The value, for comparing and printing.
    fn value(&self) -> Value;
    /// Reads what `Display` of [`Value`] wrote.
    ///
    /// # Errors
    /// The text is not a value of this type.
    fn from_text(text: &str) -> Result<Self, TextError>;
}

/// What a record's field can hold: one value, or several by index.
pub trait Field: Clone {
    /// Whether there is anything to record.
    fn is_recorded(&self) -> bool;
    /// Appends what is recorded.
    fn entries(&self, field: &'static str, out: &mut Vec<Entry>);
    /// Takes over a later record of the same field.
    fn overlay(&mut self, change: &Self);
    /// What is different from an earlier record of the same field.
    fn since(&self, earlier: &Self) -> Option<Self>;
    /// Reads one value into the field.
    ///
    /// # Errors
    /// An index where none belongs, none where one belongs, or an unreadable value.
    fn read(slot: &mut Option<Self>, index: Option<&str>, text: &str) -> Result<(), TextError>;
}

/// For serde: whether a field of a record has nothing to write.
pub(crate) fn unrecorded<T: Field>(field: &Option<T>) -> bool {
    !field.as_ref().is_some_and(Field::is_recorded)
}

impl<T: Scalar + PartialEq> Field for T {
    fn is_recorded(&self) -> bool {
        true
    }

    fn entries(&self, field: &'static str, out: &mut Vec<Entry>) {
        out.push(Entry { field, index: None, value: self.value() });
    }

    fn overlay(&mut self, change: &Self) {
        self.clone_from(change);
    }

    fn since(&self, earlier: &Self) -> Option<Self> {
        (self != earlier).then(|| self.clone())
    }

    fn read(slot: &mut Option<Self>, index: Option<&str>, text: &str) -> Result<(), TextError> {
        if let Some(index) = index {
            return Err(TextError::new(format!("no index belongs here: [{index}]")));
        }
        *slot = Some(T::from_text(text)?);
        Ok(())
    }
}

impl Scalar for f64 {
    fn value(&self) -> Value {
        Value::Number(*self)
    }

    fn from_text(text: &str) -> Result<Self, TextError> {
        text.parse()
            .ok()
            .filter(|number: &Self| number.is_finite())
            .ok_or_else(|| TextError::new(format!("not a finite number: {text}")))
    }
}

impl Scalar for String {
    fn value(&self) -> Value {
        Value::Text(self.clone())
    }

    fn from_text(text: &str) -> Result<Self, TextError> {
        serde_json::from_str(text)
            .map_err(|_| TextError::new(format!("not a text in double quotes: {text}")))
    }
}

impl Scalar for bool {
    fn value(&self) -> Value {
        Value::Word(if *self { "yes" } else { "no" }.to_owned())
    }

    fn from_text(text: &str) -> Result<Self, TextError> {
        match text {
            "yes" => Ok(true),
            "no" => Ok(false),
            _ => Err(TextError::new(format!("neither yes nor no: {text}"))),
        }
    }
}

macro_rules! integer_scalars {
    ($($type:ty)*) => {$(
        impl Scalar for $type {
            fn value(&self) -> Value {
                Value::Number(f64::from(*self))
            }

            fn from_text(text: &str) -> Result<Self, TextError> {
                text.parse().map_err(|_| {
                    TextError::new(format!("not a whole number that fits here: {text}"))
                })
            }
        }
    )*};
}
integer_scalars!(i32 u32 u8);

/// An argument of an effect: it stands there, or, where it is optional, may be left out.
pub trait Argument: Sized {
    /// The value, unless it was left out.
    fn written(&self) -> Option<Value>;
    /// Reads it; `None` when the text has no such argument.
    ///
    /// # Errors
    /// It is missing though required, or unreadable.
    fn read(text: Option<&str>) -> Result<Self, TextError>;
}

impl<T: Scalar> Argument for T {
    fn written(&self) -> Option<Value> {
        Some(self.value())
    }

    fn read(text: Option<&str>) -> Result<Self, TextError> {
        T::from_text(text.ok_or_else(|| TextError::new("it is missing"))?)
    }
}

impl<T: Scalar> Argument for Option<T> {
    fn written(&self) -> Option<Value> {
        self.as_ref().map(Scalar::value)
    }

    fn read(text: Option<&str>) -> Result<Self, TextError> {
        text.map(T::from_text).transpose()
    }
}

/// Declares a record: a struct whose fields are all optional, with its text form and its folding.
macro_rules! record {
    ($(#[$about:meta])* pub struct $name:ident { $($(#[$what:meta])* $field:ident: $type:ty,)* }) => {
        $(#[$about])*
        #[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        #[serde(deny_unknown_fields, default)]
        pub struct $name {
            $($(#[$what])* #[serde(skip_serializing_if = "crate::field::unrecorded")] pub $field: Option<$type>,)*
        }

        impl $name {
            /// The names of all fields, in order.
            pub const FIELDS: &'static [&'static str] = &[$(stringify!($field)),*];

            /// Takes over what a later record holds.
            pub fn overlay(&mut self, change: &Self) {
                $(if let Some(change) = &change.$field {
                    match &mut self.$field {
                        Some(old) => $crate::field::Field::overlay(old, change),
                        empty => *empty = Some(change.clone()),
                    }
                })*
            }

            /// What is recorded here and not the same in an earlier record.
            pub fn since(&self, earlier: &Self) -> Self {
                Self {
                    $($field: match (&self.$field, &earlier.$field) {
                        (Some(now), Some(before)) => $crate::field::Field::since(now, before),
                        (now, _) => now.clone(),
                    },)*
                }
            }

            /// Everything that is recorded, in the order of the fields.
            pub fn entries(&self) -> Vec<$crate::field::Entry> {
                let mut out = Vec::new();
                $(if let Some(value) = &self.$field {
                    $crate::field::Field::entries(value, stringify!($field), &mut out);
                })*
                out
            }

            /// Whether nothing is recorded.
            pub fn is_empty(&self) -> bool {
                $($crate::field::unrecorded(&self.$field))&&*
            }

            /// Reads one value by the field's name.
            ///
            /// # Errors
            /// There is no such field, or its value is unreadable.
            pub fn read(
                &mut self,
                field: &str,
                index: Option<&str>,
                text: &str,
            ) -> Result<(), $crate::text::TextError> {
                match field {
                    $(stringify!($field) => $crate::field::Field::read(&mut self.$field, index, text),)*
                    _ => Err($crate::text::TextError::new(format!("there is no field named {field}"))),
                }
            }
        }
    };
}

/// Declares a closed list of words: an enum with its text form.
macro_rules! words {
    ($(#[$about:meta])* pub enum $name:ident { $($(#[$what:meta])* $variant:ident = $word:literal,)* }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        #[derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        pub enum $name {
            $($(#[$what])* #[serde(rename = $word)] $variant,)*
        }

        impl $name {
            /// Every member, in order.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// The word as it is written in text and JSON.
            pub fn word(self) -> &'static str {
                match self {
                    $(Self::$variant => $word,)*
                }
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.word())
            }
        }

        impl $crate::field::Scalar for $name {
            fn value(&self) -> $crate::field::Value {
                $crate::field::Value::Word(self.word().to_owned())
            }

            fn from_text(text: &str) -> Result<Self, $crate::text::TextError> {
                Self::ALL.iter().copied().find(|member| member.word() == text).ok_or_else(|| {
                    let known: Vec<_> = Self::ALL.iter().map(|member| member.word()).collect();
                    $crate::text::TextError::new(format!("{text} is none of {}", known.join(", ")))
                })
            }
        }
    };
}

pub(crate) use {record, words};
