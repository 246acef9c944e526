//! The production interpreter with one planted fault: to see whether the suite notices.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_interpreter::faults::{PlantedFault, plant};
use gaugeblock_vocabulary::{Options, Outcome, Scenario};

use super::production::Production;

/// Whether one is planted: a fault is in the whole process, and there is one at a time.
static PLANTED: AtomicBool = AtomicBool::new(false);

/// Production with a fault, for as long as this lives.
#[derive(Debug)]
pub struct Faulty {
    production: Production,
    capabilities: Capabilities,
}

impl Faulty {
    /// Plants a fault; none while another one is planted.
    pub fn new(fault: PlantedFault) -> Option<Self> {
        if PLANTED.swap(true, Ordering::SeqCst) {
            return None;
        }
        plant(Some(fault));
        let production = Production::default();
        let name = format!("faulty:{}", fault.name());
        let capabilities = Capabilities { name, ..production.capabilities().clone() };
        Some(Self { production, capabilities })
    }
}

/// The fault of a name.
pub fn named(name: &str) -> Option<PlantedFault> {
    PlantedFault::ALL.iter().find(|fault| fault.name() == name).copied()
}

impl Drop for Faulty {
    fn drop(&mut self) {
        plant(None);
        PLANTED.store(false, Ordering::SeqCst);
    }
}

impl Adapter for Faulty {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn accepts_options(&self, options: &Options) -> Result<(), String> {
        self.production.accepts_options(options)
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        self.production.supports(scenario)
    }

    fn files(&self) -> Vec<PathBuf> {
        self.production.files()
    }

    fn is_in_process(&self) -> bool {
        true
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        self.production.run(scenario)
    }
}
