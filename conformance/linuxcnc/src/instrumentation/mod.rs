//! Observing LinuxCNC's interpreter from within a program, for every controller that has it.
//!
//! A program runs with checkpoint lines after each of its lines (`instrument`). They print the place and the values of
//! parameters. The values printed at one place are a *checkpoint*. `checkpoint` reads what was printed, `state`
//! converts it to the fields of the vocabulary, `steps` turns consecutive checkpoints into executed blocks. `refusal`
//! and `faults` know the interpreter's error messages, `lengths` converts printed lengths to another unit, `source`
//! knows the little that must be known of a program's text, `workspace` writes what a machine stores.

pub(crate) mod checkpoint;
pub(crate) mod faults;
pub(crate) mod host;
pub(crate) mod instrument;
pub(crate) mod lengths;
pub(crate) mod refusal;
pub(crate) mod source;
pub(crate) mod state;
pub(crate) mod steps;
pub(crate) mod workspace;
