//! What programs may cost.

use std::io::{Error, Result};
use std::process::Command;

/// The budgets of all programs; none where valgrind is not installed, so that nothing can be counted, which is told.
///
/// # Errors
/// `budgets.toml` is no table.
#[expect(clippy::print_stdout, reason = "a bench says why it measures nothing")]
pub fn budgets() -> Result<Option<toml::Table>> {
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("valgrind is not installed: no instructions are counted.");
        return Ok(None);
    }
    include_str!("../budgets.toml")
        .parse()
        .map(Some)
        .map_err(|error| Error::other(format!("{error}")))
}
