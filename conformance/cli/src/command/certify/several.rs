//! Several controllers in one call: each is judged alone, one after the other, and their reports are compared.

use std::collections::BTreeSet;
use std::path::PathBuf;

use gaugeblock_report::comparison::{self, ComparedReport};
use gaugeblock_report::{Report, json};
use gaugeblock_runner::certify::ModelOutcomes;
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::Suite;

use super::arguments::Arguments;
use super::course::{Candidate, Course, print};
use crate::arguments::Format;
use crate::command::comparison::today;
use crate::command::{report_compare, user_files};
use crate::error::CliError;
use crate::streams::write_out;

/// Certifies controllers of these names.
pub(super) fn certify(
    arguments: &Arguments,
    names: &[String],
    suite: &Suite,
) -> Result<u8, CliError> {
    fits_several(arguments)?;
    let course = Course {
        arguments,
        suite,
        known: arguments.against.read()?,
        earlier: None,
        model: Some(ModelOutcomes::default()),
    };
    let candidates = names.iter().map(|name| course.open(name));
    let candidates = candidates.collect::<Result<Vec<_>, _>>()?;
    if let Some(folder) = &arguments.report {
        user_files::create_folder(folder)?;
    }
    let (mut compared, mut statuses) = (Vec::new(), Vec::new());
    for (candidate, column) in candidates.iter().zip(columns(&candidates)) {
        let folder: Option<PathBuf> = arguments.report.as_ref().map(|all| all.join(&column));
        if let Some(folder) = &folder {
            user_files::create_folder(folder)?;
        }
        let (status, mut report) = course.judge(candidate, folder.as_deref(), |report| {
            if arguments.format == Format::Text {
                print(report, Format::Text, arguments.detail.detail());
                write_out("\n");
            }
            Ok((report.exit_status(), compared_report(report, &column)?))
        })?;
        statuses.push(status);
        report.link = folder.map(|_| format!("{column}/report.html"));
        compared.push(report);
    }
    let comparison = report_compare::compared(&compared)?;
    if let Some(folder) = &arguments.report {
        report_compare::write(folder, &comparison)?;
    }
    match arguments.format {
        Format::Text => write_out(&comparison::terminal(&comparison)),
        Format::Json => write_out(&report_compare::json(&comparison)),
    }
    Ok(worst(&statuses))
}

/// Refuses what belongs to one controller alone.
fn fits_several(arguments: &Arguments) -> Result<(), CliError> {
    let own = [
        ("--write-expectations", arguments.write_expectations.is_some()),
        ("--options", arguments.options.is_some()),
        ("--restrict-to", arguments.restrict_to.is_some()),
        ("--resume", arguments.resume),
        ("--certificate", arguments.certificate.certificate.is_some()),
        ("--subject", !arguments.subject.is_empty()),
        ("--list", arguments.list),
        ("--max-fail", arguments.max_fail.is_some()),
        ("--shard", arguments.shard != Shard::WHOLE),
    ];
    let given = own.into_iter().find_map(|(option, is_given)| is_given.then_some(option));
    match arguments.against.first_given().or(given) {
        None => Ok(()),
        Some(option) => Err(CliError::usage(
            format!("{option} belongs to one controller, and the call has several"),
            "certify each controller in a call of its own with --report, then `gaugeblock report compare` the folders",
        )),
    }
}

/// A name for each controller, which is its column and its folder: that of the controller, numbered if it was taken.
fn columns(candidates: &[Candidate<'_>]) -> Vec<String> {
    let mut taken = BTreeSet::new();
    let name = |candidate: &Candidate<'_>| {
        let name = &candidate.controller.capabilities().name;
        let plain = |c: char| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '-' };
        let name: String = name.chars().map(plain).collect();
        let name = if name.trim_matches('.').is_empty() { "controller".to_owned() } else { name };
        let numbered = (2..).map(|number| format!("{name}-{number}"));
        let free = std::iter::once(name.clone()).chain(numbered).find(|it| !taken.contains(it));
        let free = free.unwrap_or_default();
        taken.insert(free.clone());
        free
    };
    candidates.iter().map(name).collect()
}

/// A report as one column of the comparison.
fn compared_report(report: &Report<'_>, column: &str) -> Result<ComparedReport, CliError> {
    let text = json::json(report).to_string();
    ComparedReport::read(&text, column, Some(column), today()).map_err(|why| {
        CliError::failure(
            format!("the report of {column} {why}"),
            "this is a bug in gaugeblock; please report it",
        )
    })
}

/// The status of the whole call: a divergence of one controller, or else the greatest.
fn worst(statuses: &[u8]) -> u8 {
    if statuses.contains(&1) { 1 } else { statuses.iter().copied().max().unwrap_or_default() }
}
