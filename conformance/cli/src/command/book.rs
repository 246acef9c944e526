//! `gaugeblock book`: the suite as a static site.

use std::path::{Path, PathBuf};

use clap::Args;
use gaugeblock_book::{Book, GUIDE, render};
use gaugeblock_report::comparison::{ComparedReport, Comparison};
use gaugeblock_suite::Suite;

use super::{report_compare, suite, user_files};
use crate::error::CliError;
use crate::streams::write_out;

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock book site
      write the site; open site/index.html, without a server
  gaugeblock book site --compared nightly/rs274 --compared mill=nightly/mill
      each rule lists which of these controllers keep it
  gaugeblock book site --repository https://example.org/gaugeblock/blob/main/
      links of the guide to files of the repository lead there

The address of a page depends on the id of its rule, choice, code, document or edition alone.

Exit status: 0 written; 2 wrong call or input.")]
pub(crate) struct Arguments {
    /// Folder of the site; files of an earlier book are replaced, others stay
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// A folder of --report, or its report.json; NAME=REPORT names its column; can be repeated
    #[arg(long, value_name = "REPORT")]
    compared: Vec<String>,
    /// Beginning of the addresses at which files of the repository can be read
    #[arg(long, value_name = "URL")]
    repository: Option<String>,
}

/// Writes the site.
pub(crate) fn book(
    arguments: &Arguments,
    read: &Suite,
    suite_folder: Option<&Path>,
) -> Result<u8, CliError> {
    let ledgers = suite::sound_ledgers(read, suite_folder)?;
    let comparison = comparison(&arguments.compared)?;
    let book = Book {
        suite: read,
        ledgers: &ledgers,
        comparison: comparison.as_ref(),
        guide: &GUIDE,
        repository: arguments.repository.as_deref(),
    };
    // A folder that cannot be written ends the call before the work begins.
    user_files::create_folder(&arguments.folder)?;
    let pages = render(&book).map_err(|error| {
        CliError::failure(error, "this is a bug in gaugeblock; please report it")
    })?;
    for page in &pages {
        let path = arguments.folder.join(&page.path);
        if let Some(folder) = path.parent() {
            user_files::create_folder(folder)?;
        }
        user_files::write_whole(&path, &page.text)?;
    }
    let index = arguments.folder.join("index.html");
    write_out(&format!("{} ({} files)\n", index.display(), pages.len()));
    Ok(0)
}

/// The reports side by side; none without reports.
fn comparison(named: &[String]) -> Result<Option<Comparison>, CliError> {
    if named.is_empty() {
        return Ok(None);
    }
    let reports = named.iter().map(|named| report_compare::read_named(named));
    let reports = reports.collect::<Result<Vec<ComparedReport>, _>>()?;
    report_compare::compared(&reports).map(Some)
}
