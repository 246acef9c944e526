//! `gaugeblock schema`.

use clap::{Args, ValueEnum};

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
}

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gaugeblock schema outcome > outcome.schema.json\n  gaugeblock schema report > report.schema.json"
)]
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
    };
    write_out(&format!("{:#}\n", schema.as_value()));
    Ok(0)
}
