//! Fuzzing: [generators](generate) of programs from bytes or a seed, [properties](oracle) that hold for each of them,
//! and a [search](shrink) for the smallest program that has a property. [`motion`] has the same for motion programs.
//!
//! None of them depends on a fuzzing engine or on the comparison of two controllers: the caller runs a scenario and
//! judges its outcomes. The tests of this crate use them on stable Rust, the command `gaugeblock fuzz` uses them for
//! hours, and the targets of cargo-fuzz are glue around the same calls.

pub mod generate;
pub mod motion;
pub mod oracle;
pub mod shrink;
