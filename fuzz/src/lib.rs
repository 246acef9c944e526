//! Fuzzing: programs from bytes or a seed ([`generate`]) × what must hold for each of them ([`oracle`]), and the
//! smallest program of which something still holds ([`shrink`]).
//!
//! None of the three knows a fuzzing engine or a referee: whoever calls says how a scenario is run and what two
//! outcomes have in common. The tests of this crate drive them on stable Rust, the command `gaugeblock fuzz` drives
//! them for hours, and targets for cargo-fuzz are glue around the same calls.

pub mod generate;
pub mod motion;
pub mod oracle;
pub mod shrink;
