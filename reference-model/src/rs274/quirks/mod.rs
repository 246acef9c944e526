//! Where a real controller departs from its own document: off the main path, shown only when a scenario asks for it.
//!
//! Each section states what was observed, not what is right; the page of the same id in `suite/quirks` has the program
//! that shows it. The main path calls a section by one line, `if state.choices.quirk("rs274.…")`.

pub mod settings;
