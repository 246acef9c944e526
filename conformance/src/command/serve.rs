//! `gaugeblock serve`.

use clap::Args;
use gaugeblock_trace::{Language, Scenario};

use super::{Refused, controller};
use crate::adapters::Adapter;
use crate::protocol;

const EXAMPLES: &str = "Examples:
  gaugeblock certify \"exec:gaugeblock serve production\"
      what `certify production` says, through the protocol
  echo '{\"id\":1,\"op\":\"hello\",\"protocol\":1,\"referee\":\"me\"}' | gaugeblock serve reference
      what the specification declares: everything that can be declared

It ends with `bye`, or where its input ends.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The controller
    #[arg(value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    controller: String,
}

pub(super) fn serve(arguments: &Arguments) -> Result<u8, Refused> {
    let controller = controller::controller(&arguments.controller)?;
    let languages = languages(controller.as_ref());
    let (mut requests, mut answers) = (std::io::stdin().lock(), std::io::stdout().lock());
    protocol::serve(controller.as_ref(), &languages, &mut requests, &mut answers)
        .map_err(|error| Refused::unfinished(error.to_string(), "its caller went away"))?;
    Ok(0)
}

/// The languages that a controller speaks.
fn languages(controller: &dyn Adapter) -> Vec<Language> {
    let speaks = |language: &Language| {
        let mut scenario = Scenario::default();
        scenario.program.language = *language;
        controller.supports(&scenario).is_ok()
    };
    [Language::Rs274, Language::Nct, Language::Gpp].into_iter().filter(speaks).collect()
}
