//! Reading programs and writing results: every trouble names its place.

use std::path::Path;

use super::Refused;

/// The text of a program.
pub(super) fn program(path: &Path) -> Result<String, Refused> {
    let name = path.display();
    if path.is_dir() {
        return Err(Refused::wrong(
            format!("{name} is a directory"),
            "name a program, such as part.ngc",
        ));
    }
    let bytes = std::fs::read(path).map_err(|error| {
        Refused::wrong(format!("{name}: {error}"), "check the path of the program")
    })?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].iter().filter(|byte| **byte == b'\n').count() + 1;
        Refused::wrong(
            format!("{name}: line {line}: this is no text (byte {at} is not UTF-8)"),
            "a program is plain text; was this a binary file?",
        )
    })?;
    match text.find('\0') {
        Some(at) => {
            let line = text[..at].lines().count().max(1);
            Err(Refused::wrong(
                format!("{name}: line {line}: this is no text (byte {at} is zero)"),
                "a program is plain text; was this a binary file?",
            ))
        }
        None => Ok(text),
    }
}

/// Writes a file whole or not at all.
pub(super) fn write_whole(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Refused> {
    let name = path.display();
    let refused = |error: std::io::Error| {
        Refused::wrong(
            format!("{name}: {error}"),
            "check that the folder exists and can be written",
        )
    };
    let mut partial = path.as_os_str().to_owned();
    partial.push(".partial");
    std::fs::write(&partial, content).map_err(refused)?;
    std::fs::rename(&partial, path).map_err(refused)
}

/// Makes a folder for results and checks that it can be written, before anything runs.
pub(super) fn folder(path: &Path) -> Result<(), Refused> {
    let name = path.display();
    let refused = |error: std::io::Error| {
        Refused::wrong(format!("{name}: {error}"), "--report takes a folder that can be written")
    };
    std::fs::create_dir_all(path).map_err(refused)?;
    let probe = path.join(".gaugeblock-partial");
    std::fs::write(&probe, "").map_err(refused)?;
    std::fs::remove_file(&probe).map_err(refused)
}
