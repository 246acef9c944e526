//! Observing LinuxCNC's interpreter from within a program, for every controller that has it.
//!
//! A program is run with a probe line after each line (`instrument`), which prints the place and what parameters show
//! there. `probe` reads what was printed, `state` tells it in the fields of the vocabulary; `faults` knows the
//! interpreter's error messages, `source` the little that must be known of a program's text.

pub(super) mod faults;
pub(super) mod instrument;
pub(super) mod probe;
pub(super) mod source;
pub(super) mod state;
