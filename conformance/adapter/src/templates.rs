//! Adapters to begin with: they work, for a toy controller that knows G0.

/// In Python.
pub const PYTHON: &str = include_str!("../templates/template.py");

/// In C.
pub const C: &str = include_str!("../templates/template.c");

/// In C++, for an interpreter in a library that calls canonical functions.
pub const CPP: &str = include_str!("../templates/template.cpp");

/// In Rust, for an interpreter that writes its canonical calls to a file.
pub const RUST: &str = include_str!("../templates/template.rs");
