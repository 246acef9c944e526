//! Reading programs and writing results: every trouble names its place.

use std::io::ErrorKind;
use std::os::unix::fs::MetadataExt as _;
use std::path::{Path, PathBuf};

use gaugeblock_filesystem::{check_folder, write_output};
use gaugeblock_vocabulary::TextError;

use crate::error::CliError;

/// The text of a program.
pub(crate) fn read_program(path: &Path) -> Result<String, CliError> {
    read_text(path, "program")
}

/// The text of a file; `role` says what it is in this call, as in `script (--script)`.
pub(crate) fn read_text(path: &Path, role: &str) -> Result<String, CliError> {
    let name = path.display();
    if path.is_dir() {
        return Err(CliError::usage(
            format!("{name} is a directory"),
            format!("name the {role} itself, not its folder"),
        ));
    }
    let bytes = std::fs::read(path).map_err(|error| unreadable(path, role, &error))?;
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
        CliError::usage(format!("{}: {}", path.display(), error.to_string().trim_end()), hint)
    })
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
    write_output(path, content).map_err(|error| {
        let message = format!("{}: {error}", path.display());
        let full = [ErrorKind::StorageFull, ErrorKind::QuotaExceeded, ErrorKind::FileTooLarge];
        if full.contains(&error.kind()) {
            CliError::failure(message, "free the disk, or write elsewhere")
        } else {
            CliError::usage(message, "check that the folder exists and can be written")
        }
    })
}

/// Makes a folder for results and checks that it can be written, before anything runs.
pub(crate) fn create_folder(path: &Path) -> Result<(), CliError> {
    check_folder(path).map_err(|error| {
        let message = format!("{}: {error}", path.display());
        CliError::usage(message, "--report takes a folder that can be written")
    })
}
