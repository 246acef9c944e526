//! `gaugeblock report`.

use std::num::NonZero;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use gaugeblock_certificate::{CertifiedShard, sha256};
use gaugeblock_report::cost::{self, Cost};
use gaugeblock_report::merge::{Stored, in_order, merged};
use gaugeblock_report::{Report, profiles};
use gaugeblock_runner::certify::{Plan, Run, cases, not_applicable};
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::Suite;

use super::certificate::CertificateArguments;
use super::comparison::ComparisonArguments;
use super::{certify, report_compare, stored_report, user_files};
use crate::arguments::{DetailArguments, Format};
use crate::error::CliError;

/// Merge the reports of shards, or compare those of several controllers
#[derive(Debug, Subcommand)]
pub(crate) enum Reports {
    /// Merge the reports of all shards of one run
    #[command(after_help = "Examples:
  gaugeblock report merge shard-1 shard-2 shard-3 --report whole
  gaugeblock report merge shard-*/report.json --format json
  gaugeblock report merge shard-* --certificate mill.json --key minisign.key

Missing or repeated shards are errors, and so are reports of different controllers, versions, files
of the controller, editions, options, suites or calls, and a report of --assertions-only with a full
one.

Exit status: that of `gaugeblock certify` for the whole run; 2 wrong call or input.")]
    Merge(Merge),
    /// Compare the reports of several controllers, or of one over time
    Compare(report_compare::Arguments),
}

#[derive(Debug, Args)]
pub(crate) struct Merge {
    /// Folders of --report, or their report.json
    #[arg(value_name = "REPORT", required = true)]
    reports: Vec<PathBuf>,
    #[command(flatten)]
    against: ComparisonArguments,
    /// Write report.html, report.json, junit.xml, report.txt, summary.md and cost.json into this folder
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    #[command(flatten)]
    certificate: CertificateArguments,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    detail: DetailArguments,
}

pub(crate) fn report(command: &Reports, suite: &Suite) -> Result<u8, CliError> {
    match command {
        Reports::Merge(arguments) => merge(arguments, suite),
        Reports::Compare(arguments) => report_compare::compare(arguments),
    }
}

fn merge(arguments: &Merge, suite: &Suite) -> Result<u8, CliError> {
    let certificate = arguments.certificate.prepare(&arguments.against)?;
    let parts = arguments.reports.iter().map(|path| Part::read(path));
    let parts = parts.collect::<Result<Vec<_>, _>>()?;
    let (parts, mut shards): (Vec<_>, Vec<_>) =
        parts.into_iter().map(|Part { named, shard }| (named, shard)).unzip();
    shards.sort_by_key(|shard| shard.shard);
    let wrong = |why: String| CliError::usage(why, "name the report of each shard of one run once");
    let whole = merged(&parts).map_err(wrong)?;
    let header = &whole.header;
    if header.suite != suite.digest {
        return Err(CliError::usage(
            "the reports belong to another suite",
            "merge them with the gaugeblock that wrote them, or name their suite with --suite",
        ));
    }
    let edition = crate::documents::any_edition(suite, &header.edition)?;
    let known = arguments.against.read()?;
    let newer = known.check_header(header, suite)?;
    let (only, scope) = (&header.only, header.scope);
    let plan = Plan { suite, edition, only, jobs: NonZero::<usize>::MIN, scope };
    let all = cases(plan, header.laws, Shard::WHOLE);
    let mut cases = in_order(&whole.cases, &all, suite).map_err(wrong)?;
    cost_of(&arguments.reports)?.apply_to(&mut cases);
    let fingerprint = whole.fingerprint.clone();
    let mut run = Run { edition, scope, cases, not_applicable: not_applicable(plan), fingerprint };
    let (mismatches, fixed) = known.compare(&mut run, header.only.is_empty());
    let profiles = profiles::profiles(suite, &run, &whole.claimed());
    let report = Report {
        notes: [whole.notes.clone(), newer, fixed].concat(),
        profiles,
        mismatches,
        measurements: whole.measurements.clone(),
        ..Report::of(suite, &run, header.clone())
    };
    if let Some(folder) = &arguments.report {
        user_files::create_folder(folder)?;
        certify::write_report(folder, &report)?;
    }
    certify::print(&report, arguments.format, arguments.detail.detail());
    if let Some(certificate) = certificate {
        let written = certificate.write_merged(&report, shards)?;
        certify::print_certificate(arguments.format, &written);
    }
    Ok(report.exit_status())
}

/// The report of a shard, with the name of its file.
struct Part {
    named: (String, Stored),
    shard: CertifiedShard,
}

impl Part {
    fn read(path: &Path) -> Result<Self, CliError> {
        let (file, text) = stored_report::text(path)?;
        let part = stored_report::read(&file, &text, Stored::read)?;
        let shard = CertifiedShard { shard: part.header.shard, report_sha256: sha256(&text) };
        Ok(Self { named: (file.display().to_string(), part), shard })
    }
}

/// The cost of the parts, as far as it is known.
fn cost_of(reports: &[PathBuf]) -> Result<Cost, CliError> {
    let mut all = Cost::default();
    for path in reports {
        let folder = if path.is_dir() { Some(path.as_path()) } else { path.parent() };
        let file = folder.unwrap_or(Path::new(".")).join(cost::FILE);
        let Ok(text) = std::fs::read_to_string(&file) else { continue };
        let cost = Cost::read(&text).map_err(|error| {
            CliError::usage(format!("{}: {error}", file.display()), "remove the file")
        })?;
        all = all.and(cost);
    }
    Ok(all)
}
