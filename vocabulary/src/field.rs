//! Fields of records: by name, as values that can be compared, and folded one onto another.

use alloc::borrow::ToOwned as _;
use alloc::string::String;
use alloc::vec::Vec;

use crate::position::Position;
use crate::words::Word;

/// A value as it is compared and printed, whatever its type in the record.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number; its unit is that of the field. A broken controller may report one that is not finite.
    Number(f64),
    /// A word of a closed list, such as `clockwise`.
    Word(String),
    /// Free text.
    Text(String),
    /// Nine coordinates.
    Position(Position),
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

/// A single value: number, word, text or position.
pub trait Scalar: Clone {
    /// The value, for comparing and printing.
    fn value(&self) -> Value;
}

impl<T: Word> Scalar for T {
    fn value(&self) -> Value {
        Value::Word(self.word().to_owned())
    }
}

impl Scalar for f64 {
    fn value(&self) -> Value {
        Value::Number(*self)
    }
}

impl Scalar for String {
    fn value(&self) -> Value {
        Value::Text(self.clone())
    }
}

impl Scalar for bool {
    fn value(&self) -> Value {
        Value::Word(if *self { "yes" } else { "no" }.to_owned())
    }
}

impl Scalar for Position {
    fn value(&self) -> Value {
        Value::Position(*self)
    }
}

macro_rules! integer_scalars {
    ($($type:ty)*) => {$(
        impl Scalar for $type {
            fn value(&self) -> Value {
                Value::Number(f64::from(*self))
            }
        }
    )*};
}
integer_scalars!(i32 u32 u8);

/// An argument of an effect: required, or optional.
pub trait Argument: Sized {
    /// The value, unless it is left out.
    fn written(&self) -> Option<Value>;
}

impl<T: Scalar> Argument for T {
    fn written(&self) -> Option<Value> {
        Some(self.value())
    }
}

impl<T: Scalar> Argument for Option<T> {
    fn written(&self) -> Option<Value> {
        self.as_ref().map(Scalar::value)
    }
}

/// What a record's field can hold: one value, or several by index.
pub(crate) trait Field: Clone {
    /// Whether there is anything to record.
    fn is_recorded(&self) -> bool;
    /// Appends what is recorded.
    fn entries(&self, field: &'static str, out: &mut Vec<Entry>);
    /// Takes over a later record of the same field.
    fn overlay(&mut self, change: &Self);
    /// What differs from an earlier record of the same field.
    fn since(&self, earlier: &Self) -> Option<Self>;
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
}

/// Whether a field of a record has nothing to write.
pub(crate) fn unrecorded<T: Field>(field: &Option<T>) -> bool {
    !field.as_ref().is_some_and(Field::is_recorded)
}
