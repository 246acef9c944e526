//! Standard output and standard error: what is written there, and whether it arrived.

use std::io::{self, ErrorKind, Write as _};
use std::sync::OnceLock;

use gaugeblock_report::escape_text;
use serde::Serialize;

use crate::error::CliError;

/// The first error of standard output. Writing continues; the command reports the error when it ends.
static TROUBLE: OnceLock<String> = OnceLock::new();

/// Writes to standard output; control characters are escaped.
pub(crate) fn write_out(text: &str) {
    write_out_in_colours(&escape_text(text));
}

/// Writes a document as JSON.
pub(crate) fn write_json(document: &impl Serialize) -> Result<(), CliError> {
    let text = serde_json::to_string_pretty(document).map_err(|error| {
        CliError::failure(error.to_string(), "this is a bug in gaugeblock; please report it")
    })?;
    write_out(&format!("{text}\n"));
    Ok(())
}

/// Writes a text with our own terminal colours.
pub(crate) fn write_out_in_colours(text: &str) {
    keep(anstream::stdout().write_all(text.as_bytes()));
}

/// Writes the help or the version.
pub(crate) fn write_help(help: &clap::Error) {
    // `print` reports no error.
    write_out_in_colours(&help.render().ansi().to_string());
}

pub(crate) fn write_error(text: &str) {
    write_error_in_colours(&escape_text(text));
}

pub(crate) fn write_error_in_colours(text: &str) {
    // There is no other place to report it.
    let _closed_pipe = anstream::stderr().write_all(format!("{text}\n").as_bytes());
}

/// An error if standard output is incomplete, as on a full disk. A closed pipe is not an error: its reader has what
/// it wanted.
pub(crate) fn check_written() -> Result<(), CliError> {
    keep(io::stdout().flush());
    match TROUBLE.get() {
        None => Ok(()),
        Some(why) => Err(CliError::failure(
            format!("standard output: {why}"),
            "the output is incomplete: free space on the disk, or write elsewhere",
        )),
    }
}

fn keep(written: io::Result<()>) {
    if let Err(error) = written
        && error.kind() != ErrorKind::BrokenPipe
    {
        let _first = TROUBLE.get_or_init(|| error.to_string());
    }
}
