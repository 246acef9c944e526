//! `gaugeblock fingerprint`.

use std::fmt::Write as _;

use clap::Args;
use gaugeblock_runner::fingerprint::{
    Agreement, ObservedOption, fingerprint as take, nearest, undecided,
};
use gaugeblock_suite::Suite;
use serde_json::json;

use super::controller;
use crate::arguments::Format;
use crate::error::CliError;
use crate::streams::write_out;

const EXAMPLES: &str = "Examples:
  gaugeblock fingerprint --controller rs274
  gaugeblock fingerprint --controller reference --edition m70-draft
  gaugeblock fingerprint --controller rs274 --format json

Exit status: 0 every option was detected; 2 wrong call; 3 some could not be detected.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The controller: reference, production, rs274, linuxcnc, exec:COMMAND, tcp:HOST:PORT or offline:DIR
    #[arg(long, short, value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    controller: String,
    /// Edition whose options are passed to a controller that accepts options [default: the controller's own]
    #[arg(long, value_name = "EDITION")]
    edition: Option<String>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn fingerprint(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let controller = controller::controller(&arguments.controller)?;
    let own = controller::own_edition(controller.as_ref(), suite);
    let edition = crate::documents::edition(suite, arguments.edition.as_deref().unwrap_or(own))?;
    controller::check_observed_edition(controller.as_ref(), suite)?;
    let options = suite.options(edition);
    controller::check_options(controller.as_ref(), &options)?;
    controller::check_language(controller.as_ref(), edition)?;
    let observed = take(suite, &options, edition.environment.as_deref(), controller.as_ref());
    let nearest = nearest(suite, &observed);
    let undecided = undecided(suite, &observed, &nearest);
    let known = observed
        .iter()
        .filter(|(_, observed)| matches!(observed, ObservedOption::Option(_)))
        .count();
    match arguments.format {
        Format::Json => {
            let options: serde_json::Map<_, _> = observed
                .iter()
                .map(|(choice, observed)| (choice.id.clone(), json!(observed)))
                .collect();
            let editions: Vec<_> = nearest
                .iter()
                .map(|Agreement { edition, agree, rank }| {
                    json!({ "edition": edition, "agree": agree, "rank": rank })
                })
                .collect();
            let document = json!({
                "gaugeblock": "fingerprint", "controller": controller.capabilities().name,
                "version": controller.capabilities().version, "options": options, "shown": known, "nearest": editions,
                "undecided": undecided,
            });
            write_out(&format!("{document:#}\n"));
        }
        Format::Text => {
            let mut text = String::new();
            for (choice, observed) in &observed {
                let _infallible = writeln!(text, "{:<40} {observed}", choice.id);
            }
            let _infallible = writeln!(text, "\n{}", nearest_in_words(&nearest, known, &undecided));
            write_out(&text);
        }
    }
    let unknown =
        observed.iter().any(|(_, observed)| matches!(observed, ObservedOption::Nothing(_)));
    Ok(if unknown { 3 } else { 0 })
}

/// The nearest edition, or those that agree equally.
fn nearest_in_words(nearest: &[Agreement], known: usize, undecided: &[&str]) -> String {
    let first: Vec<_> = nearest.iter().filter(|agreement| agreement.rank == 1).collect();
    let editions: Vec<_> = first.iter().map(|agreement| agreement.edition.as_str()).collect();
    let agree = first.first().map_or(0, |agreement| agreement.agree);
    match editions.as_slice() {
        _ if agree == 0 => "nearest edition: none; no option of an edition was detected".to_owned(),
        [edition] => format!("nearest edition: {edition} ({agree} of {known} detected options)"),
        _ => format!(
            "nearest editions: {} agree equally ({agree} of {known} detected options)\nundecided: {}",
            editions.join(" and "),
            undecided.join(", ")
        ),
    }
}
