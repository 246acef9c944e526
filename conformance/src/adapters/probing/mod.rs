//! Observing LinuxCNC's interpreter from within a program, for every controller that has it.
//!
//! A program is run with a probe line after each line (`instrument`), which prints the place and what parameters show
//! there. `probe` reads what was printed, `state` tells it in the fields of the vocabulary, `steps` makes executed
//! blocks of one probe after the other. `refusal` and `faults` know the interpreter's error messages, `lengths`
//! follows what was shown once into another unit, `source` knows the little that must be known of a program's text,
//! `workspace` writes what a machine stores.

pub(super) mod faults;
pub(super) mod instrument;
pub(super) mod lengths;
pub(super) mod probe;
pub(super) mod refusal;
pub(super) mod source;
pub(super) mod state;
pub(super) mod steps;
pub(super) mod workspace;
