//! The smallest program that departs as a case does.

use gaugeblock_adapter::Adapter;
use gaugeblock_fuzz::generate::Recipe;
use gaugeblock_fuzz::generate::splice::Seeds;
use gaugeblock_vocabulary::Scenario;

use crate::adapters::reference::Reference;
use crate::fuzz::groups::{Find, shrunk};
use crate::fuzz::statistics::Statistics;
use crate::fuzz::{Came, Plan};

/// The smallest program, out of so many that are tried, on which a controller differs from the specification in the
/// same way as on this one; none where they do not differ without the case's assertions, or nothing smaller is found.
pub(super) fn smallest(
    controller: &dyn Adapter,
    scenario: &Scenario,
    attempts: u32,
) -> Option<String> {
    let reference = Reference::default();
    let plan = Plan {
        iut: controller,
        against: &reference,
        recipe: Recipe::default(),
        seed: 0,
        spliced: 0,
        seeds: Seeds::default(),
        options: scenario.options.clone(),
        random: Vec::new(),
        environment: scenario.environment.name.clone(),
    };
    let Came::Differs(difference) = plan.judge(scenario, &mut Statistics::default()) else {
        return None;
    };
    let find = shrunk(&plan, &Find::of(0, scenario.clone(), *difference), attempts);
    let program = find.scenario.program.main;
    (program.len() < scenario.program.main.len()).then_some(program)
}
