//! Several reports side by side: rules by controllers, what only one of them does, and the trend of each.
//!
//! The reports stay as they are: a comparison judges nothing again. A controller and an edition make a column. Of
//! several reports of one column the latest is compared, and all of them make its trend.

mod document;
mod html;
mod read;
mod rows;
mod terminal;
mod trend;

use std::collections::BTreeSet;

use schemars::{Schema, schema_for};

pub use document::{
    Alone, Cell, CellVerdict, ChapterRow, Column, Comparison, Distance, LimitRow, ProfileRow,
    RuleCounts, RuleRow, Trend, TrendRun,
};
pub use html::html;
pub use read::ComparedReport;
pub use terminal::terminal;

use rows::{alone, chapters, limits, profiles, rows};
use trend::trends;

/// Version of the form of a comparison.
pub const VERSION: u32 = 1;

/// The schema of a comparison.
pub fn schema() -> Schema {
    let mut schema = schema_for!(Comparison);
    schema.insert("$id".to_owned(), format!("urn:gaugeblock:comparison:{VERSION}").into());
    schema
}

/// Compares reports.
///
/// # Errors
/// Reports that cannot be compared, with their files.
pub fn comparison(reports: &[ComparedReport]) -> Result<Comparison, String> {
    if let Some((first, other)) = different_scope(reports) {
        return Err(format!(
            "{} and {} cannot be compared: one judges {}, the other {}",
            first.file,
            other.file,
            first.header.scope.words(),
            other.header.scope.words(),
        ));
    }
    let columns = by_column(reports);
    let latest: Vec<&ComparedReport> =
        columns.iter().filter_map(|runs| runs.last().copied()).collect();
    let mut rules = rows(&latest);
    let all = rules.len();
    rules.retain(|row| row.cells.iter().any(|cell| cell.verdict.is_judged()));
    Ok(Comparison {
        gaugeblock: "comparison",
        schema: VERSION,
        notes: notes(&latest),
        controllers: latest.iter().map(|report| column(report)).collect(),
        chapters: chapters(&rules, latest.len()),
        profiles: profiles(&latest),
        limits: limits(&latest),
        void_for_all: all - rules.len(),
        alone: alone(&rules, latest.len()),
        rules,
        trends: trends(&columns),
    })
}

fn different_scope(reports: &[ComparedReport]) -> Option<(&ComparedReport, &ComparedReport)> {
    let first = reports.first()?;
    let other = reports.iter().find(|other| other.header.scope != first.header.scope)?;
    Some((first, other))
}

/// The reports of each controller and edition, the earliest first; the columns in the order of their first report.
fn by_column(reports: &[ComparedReport]) -> Vec<Vec<&ComparedReport>> {
    let mut columns: Vec<Vec<&ComparedReport>> = Vec::new();
    for report in reports {
        let same = |runs: &&mut Vec<&ComparedReport>| {
            runs.first().is_some_and(|first| {
                first.name == report.name && first.header.edition == report.header.edition
            })
        };
        match columns.iter_mut().find(same) {
            Some(runs) => runs.push(report),
            None => columns.push(vec![report]),
        }
    }
    for runs in &mut columns {
        runs.sort_by_key(|report| report.date);
    }
    columns
}

fn column(report: &ComparedReport) -> Column {
    Column {
        name: report.name.clone(),
        controller: report.header.controller.clone(),
        version: report.header.version.clone(),
        edition: report.header.edition.clone(),
        date: report.date.to_string(),
        report: report.link.clone(),
        suite: report.header.suite.clone(),
        gaugeblock_version: report.header.gaugeblock_version.clone(),
        exit_status: report.exit_status,
        counts: report.counts(),
    }
}

/// What a reader should know before comparing numbers.
fn notes(latest: &[&ComparedReport]) -> Vec<String> {
    let mut notes = Vec::new();
    if let Some(scope) = latest.first().and_then(|report| report.header.scope.note()) {
        notes.push(format!("scope of the verdicts: {scope}"));
    }
    let suites: BTreeSet<&str> = latest.iter().map(|it| it.header.suite.as_str()).collect();
    if suites.len() > 1 {
        notes.push(
            "the reports are of different suites: a rule that one of them does not have is not run there"
                .to_owned(),
        );
    }
    for report in latest.iter().filter(|report| report.header.is_in_part()) {
        notes.push(format!(
            "{} against {} was run in part: the rest is not run there",
            report.name, report.header.edition
        ));
    }
    notes
}
