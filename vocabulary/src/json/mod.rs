//! The JSON form, where what serde derives is not enough.

mod indexed;
pub(crate) mod number;
pub(crate) mod tagged;
