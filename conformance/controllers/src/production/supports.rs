//! Which scenarios the production controller can run.

use gaugeblock_vocabulary::scenario::{Environment, InputChange};
use gaugeblock_vocabulary::{Language, Options, Scenario};

/// The environment that answers as its keys say.
const OWN_ENVIRONMENT: &str = "whole controller";

/// The option of a quirk that is on.
const QUIRK: &str = "observed";

/// The input that slows motion, and runs it backwards where it is negative.
const ADAPTIVE_FEED: &str = "adaptive_feed";

/// Whether it can run a scenario.
///
/// # Errors
/// The reason why not.
pub(super) fn supports(scenario: &Scenario) -> Result<(), String> {
    options(&scenario.options)?;
    match scenario.program.language {
        Language::Rs274 => environment(&scenario.environment),
        // The environment is not looked at.
        Language::Gpp | Language::Nct => Ok(()),
    }
}

/// Refuses quirks: this controller does what the documents say.
///
/// # Errors
/// A quirk that is on.
pub(super) fn options(options: &Options) -> Result<(), String> {
    match options.0.iter().find(|(_, option)| *option == QUIRK) {
        Some((quirk, _)) => {
            Err(format!("it does what documents say, and no quirk of other controllers: {quirk}"))
        }
        None => Ok(()),
    }
}

fn environment(environment: &Environment) -> Result<(), String> {
    if let Some(name) = environment.name.as_ref().filter(|name| *name != OWN_ENVIRONMENT) {
        return Err(format!("the environment {name:?} is another controller's"));
    }
    let reversed = |change: &InputChange| change.input == ADAPTIVE_FEED && change.value < 0.0;
    if environment.inputs.iter().any(reversed) {
        return Err("it does not run a program in reverse".to_owned());
    }
    Ok(())
}
