//! Finds the binary and queries its version.

use std::path::{Path, PathBuf};
use std::{env, fs};

use gaugeblock_adapter::ControllerError;

use super::command::Started;
use super::process::Limits;
use super::python::Home;
use super::streams::Stop;
use crate::instrumentation::workspace::Workspace;

/// The versions that this adapter understands.
const WANTED: &str = "2.9";

/// Prints the version. There is no option that does.
const QUESTION: &str = "(PRINT,version %.2f #<_vmajor> %d #<_vminor>)\nM2\n";

/// The binary, from a given path or from the search path.
///
/// # Errors
/// It is nowhere.
pub(super) fn find(given: Option<&Path>) -> Result<PathBuf, ControllerError> {
    if let Some(given) = given {
        // It runs in a directory of its own, where a relative path leads nowhere.
        return fs::canonicalize(given).map_err(|error| ControllerError::Missing {
            searched: format!("{}: {error}", given.display()),
        });
    }
    let paths = env::var_os("PATH").unwrap_or_default();
    let found = env::split_paths(&paths).map(|path| path.join("rs274")).find(|path| path.is_file());
    found.ok_or_else(|| ControllerError::Missing {
        searched: "no rs274 on the search path (Debian package linuxcnc-uspace)".to_owned(),
    })
}

/// The version, such as `2.9.0`, and a home in which its Python starts; none where only its own will do.
///
/// # Errors
/// It does not run, or is of another version.
pub(super) fn query(
    binary: &Path,
    limits: Limits,
) -> Result<(String, Option<Home>), ControllerError> {
    let homes = Home::candidates().into_iter();
    let fits = |home: Home| Some((version(binary, Some(&home), limits).ok()?, Some(home)));
    match homes.filter_map(fits).next() {
        Some(found) => Ok(found),
        None => Ok((version(binary, None, limits)?, None)),
    }
}

/// The version as it answers in a home.
fn version(binary: &Path, home: Option<&Home>, limits: Limits) -> Result<String, ControllerError> {
    let workspace = Workspace::new("rs274").map_err(ControllerError::Broken)?;
    workspace.write("main.ngc", QUESTION).map_err(ControllerError::Broken)?;
    let arguments = ["-g".into(), "main.ngc".into()];
    let program = Started { binary, python: home.map(Home::path) };
    let run = program.run(&arguments, workspace.path());
    let output = run.and_then(|run| run.watch("", limits)).map_err(ControllerError::Broken)?;
    let wrong =
        |found: &str| ControllerError::WrongVersion { found: found.to_owned(), required: "2.9.x" };
    let answer = output.stdout.lines().find_map(|line| line.strip_prefix("version "));
    let Some(answer) = answer.filter(|_| output.stop == Stop::Exited(0)) else {
        return Err(wrong("unknown"));
    };
    let mut words = answer.split_whitespace();
    let (Some(major), Some(minor)) = (words.next(), words.next()) else {
        return Err(wrong(answer));
    };
    let version = format!("{}.{minor}", major.trim_end_matches('0'));
    if major.trim_end_matches('0') == WANTED { Ok(version) } else { Err(wrong(&version)) }
}
