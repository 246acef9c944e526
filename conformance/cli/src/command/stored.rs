//! Reports that were written before.

use std::path::Path;

use gaugeblock_report::merge::Stored;

use crate::refused::Refused;

/// Reads a report, or that of a folder; with its name for messages.
pub(crate) fn stored(path: &Path) -> Result<(String, Stored), Refused> {
    let path = if path.is_dir() { path.join("report.json") } else { path.to_path_buf() };
    let name = path.display().to_string();
    let hint = "`gaugeblock certify --shard I/N --report DIR` writes such a report";
    let text = std::fs::read_to_string(&path)
        .map_err(|error| Refused::wrong(format!("{name}: {error}"), hint))?;
    let stored =
        Stored::read(&text).map_err(|error| Refused::wrong(format!("{name}: {error}"), hint))?;
    Ok((name, stored))
}
