//! Variables of a program.

/// A variable that a program may use.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    /// Its name.
    pub(super) name: String,
    /// Whether it is a text.
    pub(super) text: bool,
    /// How many members it has, where it is an array.
    pub(super) size: Option<u32>,
    /// Whether the toolpath declares it.
    pub(super) system: bool,
}
