//! What several tests of the command need.

use std::process::{Command, Output};

/// Runs the command to its end, without colours.
pub(crate) fn gaugeblock(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_gaugeblock"))
        .args(arguments)
        .env("NO_COLOR", "1")
        .output()
        .expect("the command runs")
}
