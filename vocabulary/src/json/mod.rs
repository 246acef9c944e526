//! The JSON form, where what serde derives is not enough.

mod indexed;
pub(crate) mod tagged;
