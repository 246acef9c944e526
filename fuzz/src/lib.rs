//! Fuzzing: programs from bytes ([`generate`]) × what must hold for each of them ([`oracle`]).
//!
//! The two know nothing of a fuzzing engine. The tests of this crate drive them on stable Rust; targets for cargo-fuzz
//! are glue around the same two calls.

pub mod generate;
pub mod oracle;
