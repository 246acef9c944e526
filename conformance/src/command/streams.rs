//! Standard output and standard error: what is written there, and whether it arrived.

use std::io::{self, ErrorKind, Write as _};
use std::sync::OnceLock;

use super::Refused;
use crate::report::inert;

/// The first error of standard output. Writing continues; the command reports the error when it ends.
static TROUBLE: OnceLock<String> = OnceLock::new();

/// Writes to standard output; control characters are escaped.
pub(super) fn write_out(text: &str) {
    write_out_in_colours(&inert(text));
}

/// Writes a text with our own terminal colours.
pub(super) fn write_out_in_colours(text: &str) {
    keep(anstream::stdout().write_all(text.as_bytes()));
}

/// Writes the help or the version.
pub(super) fn write_help(help: &clap::Error) {
    // `print` reports no error.
    write_out_in_colours(&help.render().ansi().to_string());
}

pub(super) fn write_error(text: &str) {
    write_error_in_colours(&inert(text));
}

pub(super) fn write_error_in_colours(text: &str) {
    // There is no other place to report it.
    let _closed_pipe = anstream::stderr().write_all(format!("{text}\n").as_bytes());
}

/// An error if standard output is incomplete, as on a full disk. A closed pipe is not an error: its reader has what
/// it wanted.
pub(super) fn written() -> Result<(), Refused> {
    keep(io::stdout().flush());
    match TROUBLE.get() {
        None => Ok(()),
        Some(why) => Err(Refused::unfinished(
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
