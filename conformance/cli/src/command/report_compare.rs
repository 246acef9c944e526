//! `gaugeblock report compare`.

use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use clap::Args;
use gaugeblock_report::comparison::{self, ComparedReport, Comparison};
use gaugeblock_runner::waivers::Day;

use super::{stored_report, user_files};
use crate::arguments::Format;
use crate::error::CliError;
use crate::streams::write_out;

/// Names of the files of a comparison.
const PAGE: &str = "comparison.html";
const DOCUMENT: &str = "comparison.json";

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock report compare rs274-report mill-report --report both
      write both/comparison.html: rules by controllers, profiles, what only one does
  gaugeblock report compare old=a/report.json new=b/report.json
      print the comparison; name the columns, where both controllers have one name
  gaugeblock report compare nightly/2026-11-*/mill --report trend
      plot a trend: reports of one controller and edition form a column; the latest is compared

The date of a report is the last date in its path, or else the day on which the file was changed.

Exit status: 0 compared; 2 wrong call or input, and nothing is written.")]
pub(crate) struct Arguments {
    /// Folders of --report, or their report.json; NAME=REPORT gives the column this name
    #[arg(value_name = "REPORT", required = true, num_args = 2..)]
    reports: Vec<String>,
    /// Write comparison.html and comparison.json into this folder
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn compare(arguments: &Arguments) -> Result<u8, CliError> {
    let reports = arguments.reports.iter().map(|named| read_named(named));
    let reports = reports.collect::<Result<Vec<_>, _>>()?;
    let comparison = compared(&reports)?;
    if let Some(folder) = &arguments.report {
        user_files::create_folder(folder)?;
        write(folder, &comparison)?;
    }
    match arguments.format {
        Format::Text => write_out(&comparison::terminal(&comparison)),
        Format::Json => write_out(&json(&comparison)),
    }
    Ok(0)
}

/// The comparison of reports.
pub(crate) fn compared(reports: &[ComparedReport]) -> Result<Comparison, CliError> {
    let hint = "compare reports that are all of --assertions-only, or none";
    comparison::comparison(reports).map_err(|why| CliError::usage(why, hint))
}

/// Writes the page and the document of a comparison into a folder.
pub(crate) fn write(folder: &Path, comparison: &Comparison) -> Result<(), CliError> {
    let page = comparison::html(comparison).map_err(|error| {
        CliError::failure(error, "this is a bug in gaugeblock; please report it")
    })?;
    user_files::write_whole(&folder.join(DOCUMENT), json(comparison))?;
    user_files::write_whole(&folder.join(PAGE), page)
}

pub(crate) fn json(comparison: &Comparison) -> String {
    format!("{:#}\n", serde_json::to_value(comparison).unwrap_or_default())
}

/// A report of the command line, with the name of its column if it has one.
pub(crate) fn read_named(named: &str) -> Result<ComparedReport, CliError> {
    match named.split_once('=') {
        Some((name, path)) if !name.is_empty() && !Path::new(named).exists() => {
            read(Path::new(path), Some(name))
        }
        _ => read(Path::new(named), None),
    }
}

/// A report of a folder or file.
pub(crate) fn read(path: &Path, name: Option<&str>) -> Result<ComparedReport, CliError> {
    let (file, text) = stored_report::text(path)?;
    let date = date_of_path(&file).unwrap_or_else(|| date_of_change(&file));
    let shown = file.display().to_string();
    stored_report::read(&file, &text, |text| ComparedReport::read(text, &shown, name, date))
}

/// The last date in a path, such as that of `nightly/2026-11-29/report.json`.
fn date_of_path(path: &Path) -> Option<Day> {
    let text = path.to_string_lossy();
    let places = (0..text.len().saturating_sub(9)).rev();
    places.filter_map(|place| text.get(place..place + 10)?.parse().ok()).next()
}

/// The day on which a file was changed.
fn date_of_change(path: &Path) -> Day {
    let changed = path.metadata().and_then(|file| file.modified()).unwrap_or(UNIX_EPOCH);
    let since = SystemTime::duration_since(&changed, UNIX_EPOCH);
    Day::after_epoch(since.map_or(0, |since| since.as_secs() / 86_400))
}
