//! Adapters to begin with: they work, for a controller that knows G0 and G1.

/// In Python.
pub const PYTHON: &str = include_str!("../templates/template.py");

/// In C.
pub const C: &str = include_str!("../templates/template.c");
