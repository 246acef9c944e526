//! Reports that were written before.

use std::path::{Path, PathBuf};

use gaugeblock_report::merge::Stored;

use super::user_files;
use crate::error::CliError;

/// The hint where a report cannot be read.
const NAME_A_REPORT: &str = "name the report.json of an earlier run: \
     `gaugeblock certify --controller CONTROLLER --report DIR` writes DIR/report.json";

/// A report of an earlier run: the file, or the folder that holds it as `report.json`.
pub(crate) fn stored(path: &Path) -> Result<(String, Stored), CliError> {
    let (path, text) = text(path)?;
    let stored = read(&path, &text, Stored::read)?;
    Ok((path.display().to_string(), stored))
}

/// The file of a report: the path, or `report.json` in the folder at the path.
pub(crate) fn file(path: &Path) -> PathBuf {
    if path.is_dir() { path.join("report.json") } else { path.to_path_buf() }
}

/// The file of a report and its text.
pub(crate) fn text(path: &Path) -> Result<(PathBuf, String), CliError> {
    let path = file(path);
    let is_other = std::fs::metadata(&path).is_ok_and(|metadata| !metadata.is_file());
    let bytes = if is_other {
        // A device may have no end.
        user_files::read_bytes(&path, "report")?
    } else {
        let unreadable =
            |error| CliError::usage(format!("{}: {error}", path.display()), NAME_A_REPORT);
        std::fs::read(&path).map_err(unreadable)?
    };
    // What is not UTF-8 is not JSON either, and is refused as such.
    Ok((path, String::from_utf8_lossy(&bytes).into_owned()))
}

/// Reads what is of use in a report of an earlier run.
pub(crate) fn read<T>(
    path: &Path,
    text: &str,
    read: impl FnOnce(&str) -> Result<T, String>,
) -> Result<T, CliError> {
    read(text).map_err(|why| CliError::usage(format!("{} {why}", path.display()), NAME_A_REPORT))
}
