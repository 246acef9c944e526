//! Parameters: numbered, named, and those that report the state of the interpreter (11.4.3, 11.4.4).

mod item;
mod named;
mod names;
mod numbered;
mod predefined;
mod store;

pub use item::ItemName;
pub(crate) use named::{Internal, Named, ScopeMark, Slot};
pub(crate) use names::{NameId, Names};
pub(crate) use numbered::{LAST, Numbered, is_stored};
pub(crate) use predefined::Predefined;
pub(crate) use store::Parameters;
