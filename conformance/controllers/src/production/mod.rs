//! The production controller: it runs in this process, and a simulated machine records what it does.
//!
//! Everything that it does is recorded exactly (`recorder`). Inputs come from the scenario's environment
//! (`environment`), the operator's events from its script (`operator`). The task does the rest; this module only
//! translates. It accepts every choice of the documents and no quirk: quirks describe other controllers. A
//! post-processor program only needs a sink (`post`), and so do custom macros (`macros`).

mod environment;
mod held;
mod macros;
mod operator;
mod post;
mod recorder;
mod run;
mod supports;
#[cfg(test)]
mod tests;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

use gaugeblock_adapter::{Adapter, HarnessError, MotionRequest, NoSamples};
use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::motion::Samples;
use gaugeblock_vocabulary::{Language, Options, Outcome, Scenario};

use crate::simulate::{RunConditions, plan_with};

/// The production controller.
#[derive(Debug)]
pub struct Production {
    capabilities: Capabilities,
}

impl Default for Production {
    fn default() -> Self {
        Self { capabilities: Capabilities::everything("production", env!("CARGO_PKG_VERSION")) }
    }
}

impl Adapter for Production {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn accepts_options(&self, options: &Options) -> Result<(), String> {
        supports::options(options)
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        supports::supports(scenario)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        // It promises not to panic, and is not trusted to keep that.
        catch_unwind(AssertUnwindSafe(|| match scenario.program.language {
            Language::Gpp => post::run(scenario),
            Language::Nct => macros::run(scenario),
            Language::Rs274 => run::run(scenario),
        }))
        .unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
            let stderr = text.unwrap_or_default().to_owned();
            Err(HarnessError::Crashed { status: "a panic".to_owned(), stderr })
        })
    }

    fn files(&self) -> Vec<PathBuf> {
        crate::running_program()
    }

    fn is_in_process(&self) -> bool {
        true
    }

    fn record_motion(&self, motion: &MotionRequest<'_>) -> Result<Samples, NoSamples> {
        let outcome = self.run(motion.scenario);
        let outcome = outcome.map_err(NoSamples::Failed)?;
        let script = motion.script.clone();
        let circumstances =
            RunConditions { every: motion.feed_interval, script, ..RunConditions::default() };
        let planned = plan_with(&outcome, motion.limits, &circumstances);
        planned
            .map(|planned| planned.samples)
            .map_err(|stopped| NoSamples::Failed(HarnessError::NotRun(stopped.why)))
    }
}
