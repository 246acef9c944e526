//! Which scenarios the production interpreter can run.

use gaugeblock_trace::scenario::{Bench, Start};
use gaugeblock_trace::{Language, Options, Scenario};

/// The bench that answers as its keys say.
const OWN_BENCH: &str = "whole controller";

/// The option of a quirk that another controller shows.
const QUIRK: &str = "observed";

/// Inputs that hold or slow the feed.
const FEED_INPUTS: [&str; 2] = ["adaptive_feed", "feed_hold"];

/// Whether it can run a scenario.
///
/// # Errors
/// The reason why not.
pub(super) fn supports(scenario: &Scenario) -> Result<(), String> {
    options(&scenario.options)?;
    if scenario.program.language != Language::Rs274 {
        return Err(format!("it does not speak {}", scenario.program.language));
    }
    if scenario.program.start == Start::Mdi {
        return Err("no manual data input yet".to_owned());
    }
    if !scenario.operator.is_empty() {
        return Err("no operator yet".to_owned());
    }
    bench(&scenario.bench)
}

/// Quirks are what another controller does otherwise than its documents, and this one does as documents say.
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

fn bench(bench: &Bench) -> Result<(), String> {
    if let Some(name) = bench.name.as_ref().filter(|name| *name != OWN_BENCH) {
        return Err(format!("the bench {name:?} is another controller's"));
    }
    if bench.inputs.iter().any(|change| FEED_INPUTS.contains(&change.input.as_str())) {
        return Err("no feed that an input holds or slows yet".to_owned());
    }
    if bench.manual_tool_change {
        return Err("no person who changes tools yet".to_owned());
    }
    Ok(())
}
