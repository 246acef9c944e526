//! Minimising the program of a divergence.

use gaugeblock_adapter::Adapter;
use gaugeblock_controllers::Reference;
use gaugeblock_vocabulary::Scenario;

use crate::fuzz::groups::{Finding, shrunk};
use crate::fuzz::statistics::Statistics;
use crate::fuzz::{FuzzResult, Plan};

/// The smallest program, of at most `attempts` tried ones, with the same difference from the specification. None if
/// only an assertion fails, or if no smaller program is found.
pub(super) fn smallest(
    controller: &dyn Adapter,
    scenario: &Scenario,
    attempts: u32,
) -> Option<String> {
    let reference = Reference::default();
    let plan = Plan::new(controller, &reference, scenario.options.clone());
    let FuzzResult::Differs(difference) = plan.judge(scenario, &mut Statistics::default()) else {
        return None;
    };
    let finding =
        shrunk(&plan, &Finding::of(0, scenario.clone(), *difference), attempts, &|| false);
    let program = finding.scenario.program.main;
    (program.len() < scenario.program.main.len()).then_some(program)
}
