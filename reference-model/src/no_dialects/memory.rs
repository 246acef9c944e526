//! What a dialect remembers: nothing.

/// What a dialect remembers: nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {}

/// What a dialect remembers with the modes: nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ModalMemory {}

/// What a dialect remembers with the control of a program: nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct ControlMemory {}

/// What a dialect remembers of a file: nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct SourceMemory {}
