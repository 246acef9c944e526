//! Standard output and standard error: what is written there, and whether it arrived.

use std::io::{self, ErrorKind, Write as _};
use std::sync::OnceLock;

use super::Refused;
use crate::report::inert;

/// The first trouble with standard output. Whoever writes goes on; how the command ends tells it.
static TROUBLE: OnceLock<String> = OnceLock::new();

/// Writes to standard output. Whoever it is of, a terminal obeys nothing of it.
pub(super) fn write_out(text: &str) {
    write_out_in_colours(&inert(text));
}

/// Writes a text whose orders to a terminal are our own.
pub(super) fn write_out_in_colours(text: &str) {
    keep(anstream::stdout().write_all(text.as_bytes()));
}

/// Writes the help, or the version, that somebody asked for.
pub(super) fn write_help(help: &clap::Error) {
    // `print` of its own tells no error.
    write_out_in_colours(&help.render().ansi().to_string());
}

pub(super) fn write_error(text: &str) {
    write_error_in_colours(&inert(text));
}

pub(super) fn write_error_in_colours(text: &str) {
    // There is nobody else to tell.
    let _closed_pipe = anstream::stderr().write_all(format!("{text}\n").as_bytes());
}

/// Refuses to be done where standard output is cut off, as on a full disk. A reader that went away is no error: it
/// has what it wanted.
pub(super) fn written() -> Result<(), Refused> {
    keep(io::stdout().flush());
    match TROUBLE.get() {
        None => Ok(()),
        Some(why) => Err(Refused::unfinished(
            format!("standard output: {why}"),
            "what was written is cut off: free the disk, or write elsewhere",
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
