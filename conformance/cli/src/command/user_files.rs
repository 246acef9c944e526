//! Reading programs and writing results: every trouble names its place.

use std::io::{ErrorKind, Read, Write};
use std::os::unix::fs::MetadataExt as _;
use std::path::{Path, PathBuf};

use gaugeblock_filesystem::{check_folder, write_long_output, write_output, write_outputs};
use gaugeblock_vocabulary::TextError;

use crate::error::CliError;
use crate::streams::write_error;

/// The name of standard input as a program.
const STANDARD_INPUT: &str = "-";

/// The text of a program; `-` is standard input. A text that is not UTF-8 is read as Latin-1, with a note.
pub(crate) fn read_program(path: &Path) -> Result<String, CliError> {
    let role = "program";
    let bytes = if is_standard_input(path) {
        read_stream(path, role, std::io::stdin())?
    } else {
        read_bytes(path, role)?
    };
    if bytes.contains(&0) || std::str::from_utf8(&bytes).is_ok() {
        return text_of(path, role, bytes);
    }
    write_error(&format!("note: {}: not UTF-8: read as Latin-1", program_name(path)));
    Ok(bytes.into_iter().map(char::from).collect())
}

/// Whether a path stands for standard input.
pub(crate) fn is_standard_input(path: &Path) -> bool {
    path == Path::new(STANDARD_INPUT)
}

/// The name of a program in messages.
pub(crate) fn program_name(path: &Path) -> String {
    if is_standard_input(path) { "<stdin>".to_owned() } else { path.display().to_string() }
}

/// The text of a file; `role` says what it is in this call, as in `script (--script)`.
pub(crate) fn read_text(path: &Path, role: &str) -> Result<String, CliError> {
    text_of(path, role, read_bytes(path, role)?)
}

/// Most bytes that are read of a pipe or a device.
const STREAM_LENGTH_MAX: u64 = 64 << 20;

/// The bytes of a file; `role` says what it is in this call. Of a pipe or a device, whose length is unknown, only so
/// many bytes are read as memory holds for sure.
pub(crate) fn read_bytes(path: &Path, role: &str) -> Result<Vec<u8>, CliError> {
    let name = path.display();
    if path.is_dir() {
        return Err(CliError::usage(
            format!("{name} is a directory"),
            format!("name the {role} itself, not its folder"),
        ));
    }
    let file = std::fs::File::open(path).map_err(|error| unreadable(path, role, &error))?;
    let is_regular = file.metadata().is_ok_and(|metadata| metadata.is_file());
    if !is_regular {
        return read_stream(path, role, file);
    }
    std::fs::read(path).map_err(|error| unreadable(path, role, &error))
}

/// The bytes of a pipe or a device up to its end.
fn read_stream(path: &Path, role: &str, stream: impl Read) -> Result<Vec<u8>, CliError> {
    let mut bytes = Vec::new();
    let read = stream.take(STREAM_LENGTH_MAX + 1).read_to_end(&mut bytes);
    if read.map_err(|error| unreadable(path, role, &error))? as u64 > STREAM_LENGTH_MAX {
        return Err(CliError::usage(
            format!("{}: no end after {STREAM_LENGTH_MAX} bytes", program_name(path)),
            format!("name a {role}: a file, or a pipe that ends"),
        ));
    }
    Ok(bytes)
}

/// Bytes as text without a NUL, on which controllers need not agree.
fn text_of(path: &Path, role: &str, bytes: Vec<u8>) -> Result<String, CliError> {
    let name = program_name(path);
    let binary = || format!("the {role} is plain text; was this a binary file?");
    let text = String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].iter().filter(|byte| **byte == b'\n').count() + 1;
        CliError::usage(format!("{name}: line {line}: not text (byte {at} is not UTF-8)"), binary())
    })?;
    match text.find('\0') {
        Some(at) => {
            let line = text[..at].lines().count().max(1);
            Err(CliError::usage(
                format!("{name}: line {line}: not text (byte {at} is zero)"),
                binary(),
            ))
        }
        None => Ok(text),
    }
}

/// Refuses a path that leads to no file.
pub(crate) fn check_exists(path: &Path, role: &str) -> Result<(), CliError> {
    path.metadata().map(|_| ()).map_err(|error| unreadable(path, role, &error))
}

fn unreadable(path: &Path, role: &str, error: &std::io::Error) -> CliError {
    let message = format!("{}: {error}", path.display());
    CliError::usage(message, format!("check the path of the {role}"))
}

/// Reads a file that has a form; `hint` names the help that describes the form.
pub(crate) fn read_form<T>(
    path: &Path,
    role: &str,
    hint: &str,
    read: impl FnOnce(&str) -> Result<T, TextError>,
) -> Result<T, CliError> {
    read(&read_text(path, role)?).map_err(|error| {
        let error = in_plain_words(error.to_string().trim_end());
        CliError::usage(format!("{}: {error}", path.display()), hint)
    })
}

/// Types of this program's source, as messages about a file name them, and what a file has.
const TYPES: [(&str, &str); 12] = [
    ("expected u8", "expected a whole number from 0 to 255"),
    ("expected u16", "expected a whole number from 0 to 65535"),
    ("expected u32", "expected a whole number, 0 or more"),
    ("expected u64", "expected a whole number, 0 or more"),
    ("expected i32", "expected a whole number"),
    ("expected f64", "expected a number"),
    ("expected a sequence", "expected a list"),
    ("expected a map", "expected a table"),
    ("expected a boolean", "expected true or false"),
    ("expected a string", "expected a text"),
    ("wanted string or table", "expected a word or a table"),
    ("unknown variant", "unknown word"),
];

/// A message about a file in the words of the file.
fn in_plain_words(message: &str) -> String {
    let mut message = message.to_owned();
    for (ours, plain) in TYPES {
        message = message.replace(ours, plain);
    }
    for kind in ["expected struct ", "expected enum ", "expected internally tagged enum "] {
        while let Some((before, after)) = message.split_once(kind) {
            let rest = after.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || c == '_');
            let what = if kind.contains("enum") { "a word or a table" } else { "a table" };
            message = format!("{before}expected {what}{rest}");
        }
    }
    message
}

/// Refuses to write over a file that is read. Outputs are given by the option that names them.
pub(crate) fn check_outputs_spare_inputs(
    inputs: &[PathBuf],
    outputs: &[(&str, Option<&Path>)],
) -> Result<(), CliError> {
    // Whatever the names: links lead to one file, too. One that is not there yet is no other's.
    let file = |path: &Path| path.metadata().ok().map(|found| (found.dev(), found.ino()));
    for (option, output) in outputs {
        let Some(output) = output else { continue };
        let written = file(output);
        if written.is_some() && inputs.iter().any(|input| file(input) == written) {
            return Err(CliError::usage(
                format!("{}: {option} would write over a file that is read", output.display()),
                format!("name another file with {option}"),
            ));
        }
    }
    Ok(())
}

/// Writes an output, as [`write_output`] does: a regular file whole or not at all, anything else in place.
pub(crate) fn write_whole(path: &Path, content: impl AsRef<[u8]>) -> Result<(), CliError> {
    write_output(path, content).map_err(|error| unwritable(path, &error))
}

/// Writes a long output part by part, as [`write_long_output`] does: a regular file whole or not at all.
pub(crate) fn write_long(
    path: &Path,
    content: impl FnMut(&mut dyn Write) -> std::io::Result<()>,
) -> Result<(), CliError> {
    write_long_output(path, content).map_err(|error| unwritable(path, &error))
}

/// Writes regular files that belong together, as [`write_outputs`] does: all of them or none.
pub(crate) fn write_together(outputs: &[(&Path, &[u8])]) -> Result<(), CliError> {
    let first = outputs.first().map_or(Path::new(""), |(path, _)| path);
    write_outputs(outputs).map_err(|error| unwritable(first, &error))
}

fn unwritable(path: &Path, error: &std::io::Error) -> CliError {
    let message = format!("{}: {error}", path.display());
    let full = [ErrorKind::StorageFull, ErrorKind::QuotaExceeded, ErrorKind::FileTooLarge];
    if full.contains(&error.kind()) {
        CliError::failure(message, "free the disk, or write elsewhere")
    } else {
        CliError::usage(message, "check that the folder exists and can be written")
    }
}

/// Makes a folder for results and checks that it can be written, before anything runs.
pub(crate) fn create_folder(path: &Path) -> Result<(), CliError> {
    check_folder(path).map_err(|error| {
        let message = format!("{}: {error}", path.display());
        CliError::usage(message, "--report takes a folder that can be written")
    })
}
