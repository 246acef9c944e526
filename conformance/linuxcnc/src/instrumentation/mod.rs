//! Observing LinuxCNC's interpreter from within a program, for every controller that has it.
//!
//! A program is run with a probe line after each line (`instrument`), which prints the place and what parameters show
//! there. `probe` reads what was printed, `state` tells it in the fields of the vocabulary, `steps` makes executed
//! blocks of one probe after the other. `refusal` and `faults` know the interpreter's error messages, `lengths`
//! follows what was shown once into another unit, `source` knows the little that must be known of a program's text,
//! `workspace` writes what a machine stores.

pub(crate) mod faults;
pub(crate) mod host;
pub(crate) mod instrument;
pub(crate) mod lengths;
pub(crate) mod probe;
pub(crate) mod refusal;
pub(crate) mod source;
pub(crate) mod state;
pub(crate) mod steps;
pub(crate) mod workspace;
