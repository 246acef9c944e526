//! `gaugeblock suite matrix`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use gaugeblock_controllers::Reference;
use gaugeblock_report::matrix::{Judged, Matrix};
use gaugeblock_report::{Header, Report};
use gaugeblock_runner::certify::{Plan, Scope, certify};
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::Suite;
use gaugeblock_suite::ledger::Ledger;

use super::{stored_report, user_files};
use crate::arguments::Format;
use crate::error::CliError;
use crate::streams::write_out;

/// Prints, per document and section, its rules and their verdicts in the model and in each report.
pub(crate) fn matrix(
    suite: &Suite,
    ledgers: &[Ledger],
    reports: &[PathBuf],
    format: Format,
) -> Result<u8, CliError> {
    let judged: Vec<Judged> =
        reports.iter().map(|path| read(path.as_path())).collect::<Result<_, CliError>>()?;
    let model = model(suite, ledgers);
    let matrix = Matrix::new(ledgers, &model, &judged);
    match format {
        Format::Text => write_out(&matrix.text()),
        Format::Json => write_out(&format!("{:#}\n", matrix.json())),
    }
    Ok(0)
}

fn read(path: &Path) -> Result<Judged, CliError> {
    let text = user_files::read_text(path, "report (--report)")?;
    stored_report::read(path, &text, Judged::read)
}

/// The model's verdicts for the edition of each document.
fn model(suite: &Suite, ledgers: &[Ledger]) -> BTreeMap<String, Judged> {
    let controller = Reference::default();
    let mut model = BTreeMap::new();
    for ledger in ledgers {
        let Some(edition) = suite.edition(&ledger.edition) else { continue };
        model.entry(edition.id.clone()).or_insert_with(|| {
            let (jobs, scope) = (crate::arguments::jobs(None), Scope::Full);
            let plan = Plan { suite, edition, only: &[], jobs, scope };
            let run = certify(plan, &controller, &|| {});
            let header = Header::of(plan, &controller, Shard::WHOLE);
            let (notes, profiles) = (Vec::new(), Vec::new());
            Judged::of(&Report { notes, profiles, ..Report::of(suite, &run, header) })
        });
    }
    model
}
