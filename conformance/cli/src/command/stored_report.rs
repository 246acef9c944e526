//! Reports that were written before.

use std::path::Path;

use gaugeblock_report::merge::Stored;

use crate::error::CliError;

/// The hint where a report cannot be read.
const NAME_A_REPORT: &str = "name the report.json of an earlier run: \
     `gaugeblock certify --controller CONTROLLER --report DIR` writes DIR/report.json";

/// A report of an earlier run: the file, or the folder that holds it as `report.json`.
pub(crate) fn stored(path: &Path) -> Result<(String, Stored), CliError> {
    let path = if path.is_dir() { path.join("report.json") } else { path.to_path_buf() };
    let name = path.display().to_string();
    let bytes = std::fs::read(&path)
        .map_err(|error| CliError::usage(format!("{name}: {error}"), NAME_A_REPORT))?;
    // What is not UTF-8 is not JSON either, and is refused as such.
    let stored = read(&path, &String::from_utf8_lossy(&bytes), Stored::read)?;
    Ok((name, stored))
}

/// Reads what is of use in a report of an earlier run.
pub(crate) fn read<T>(
    path: &Path,
    text: &str,
    read: impl FnOnce(&str) -> Result<T, String>,
) -> Result<T, CliError> {
    read(text).map_err(|why| CliError::usage(format!("{} {why}", path.display()), NAME_A_REPORT))
}
