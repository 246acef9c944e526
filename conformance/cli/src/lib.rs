//! The command `gaugeblock`: its arguments, its messages, and its progress on a terminal.

mod arguments;
mod call;
mod command;
mod documents;
mod error;
mod program;
mod progress;
mod signals;
mod streams;

pub use call::{main, understands};
