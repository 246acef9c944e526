//! `gaugeblock schema`.

use clap::{Args, ValueEnum};

use gaugeblock_motion::MotionDocument;
use schemars::schema_for;

use super::check::AdapterCheckDocument;
use super::motion_fuzz_document::MotionFuzzDocument;
use super::suite::SuiteCheckDocument;
use crate::error::CliError;
use crate::streams::write_out;

#[derive(Clone, Copy, Debug, ValueEnum)]
enum What {
    /// Input of a run
    Scenario,
    /// Observations of a run
    Outcome,
    /// The report.json of `certify --report`
    Report,
    /// The comparison.json of `report compare`
    Comparison,
    /// The file of `certify --certificate`
    Certificate,
    /// Output of `plan` and `motion check` with --format json
    Motion,
    /// Output of `motion fuzz` with --format json
    MotionFuzz,
    /// Output of `adapter check` with --format json
    AdapterCheck,
    /// Output of `suite check` with --format json
    SuiteCheck,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gaugeblock schema outcome > outcome.schema.json
  gaugeblock schema report > report.schema.json

Exit status: 0 printed; 2 wrong call or input.")]
pub(crate) struct Arguments {
    /// The document
    #[arg(value_enum)]
    what: What,
}

pub(crate) fn schema(arguments: &Arguments) -> Result<u8, CliError> {
    let schema = match arguments.what {
        What::Scenario => gaugeblock_vocabulary::schema::scenario(),
        What::Outcome => gaugeblock_vocabulary::schema::outcome(),
        What::Report => gaugeblock_report::json::schema(),
        What::Certificate => gaugeblock_certificate::schema(),
        What::Comparison => gaugeblock_report::comparison::schema(),
        What::Motion => schema_for!(MotionDocument),
        What::MotionFuzz => schema_for!(MotionFuzzDocument),
        What::AdapterCheck => schema_for!(AdapterCheckDocument),
        What::SuiteCheck => schema_for!(SuiteCheckDocument),
    };
    write_out(&format!("{:#}\n", schema.as_value()));
    Ok(0)
}
