//! What the laws of this repository need to know of it: its crates, as cargo sees them, and its files.
//!
//! The laws themselves are the tests of this crate (`tests/laws`).

pub mod files;
pub mod graph;
pub mod picture;
pub mod prose;
pub mod report;
pub mod workspace;
