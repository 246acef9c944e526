//! The reference model as a controller.

use std::path::PathBuf;

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::{Options, Outcome, Scenario};

/// The reference model.
#[derive(Debug)]
pub struct Reference {
    capabilities: Capabilities,
}

impl Default for Reference {
    fn default() -> Self {
        Self { capabilities: Capabilities::everything("reference", env!("CARGO_PKG_VERSION")) }
    }
}

impl Adapter for Reference {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn accepts_options(&self, options: &Options) -> Result<(), String> {
        gaugeblock_reference::accepts_options(options)
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        self.accepts_options(&scenario.options)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        Ok(gaugeblock_reference::run(scenario).0)
    }

    fn files(&self) -> Vec<PathBuf> {
        crate::running_program()
    }

    fn is_in_process(&self) -> bool {
        true
    }

    fn has_laws_of_motion(&self) -> bool {
        true
    }
}
