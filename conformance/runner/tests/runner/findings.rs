//! One mistake is one finding.

use std::num::NonZero;

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_controllers::Reference;
use gaugeblock_runner::certify::{Plan, RuleDivergence, Scope, certify};
use gaugeblock_runner::findings::findings;
use gaugeblock_runner::other_controller;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::{Outcome, Scenario};

/// The model under one other option, which it does not declare.
#[derive(Debug)]
struct Undeclared {
    model: Reference,
    choice: &'static str,
    option: &'static str,
}

impl Adapter for Undeclared {
    fn capabilities(&self) -> &Capabilities {
        self.model.capabilities()
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        self.model.supports(scenario)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        let mut scenario = scenario.clone();
        scenario.options.0.insert(self.choice.to_owned(), self.option.to_owned());
        self.model.run(&scenario)
    }
}

#[test]
fn feed_that_is_read_after_the_unit_is_one_finding() {
    let files = gaugeblock_embedded_suite::files().expect("the suite");
    let suite = Suite::read(&files).unwrap_or_else(|errors| panic!("{}", errors.join("\n")));
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let only = ["order", "units-planes", "feed"].map(str::to_owned);
    let jobs = NonZero::new(2).expect("at least one");
    let plan = Plan { suite: &suite, edition, only: &only, jobs, scope: Scope::Full };
    let (choice, option) = ("order.feed-unit", "new");
    let controller = Undeclared { model: Reference::default(), choice, option };
    let run = certify(plan, &controller, &|| {});
    let name = &controller.capabilities().name;
    let explains = |divergence: &RuleDivergence| {
        let parts = &divergence.explanation;
        !parts.is_empty() && parts.iter().all(|part| other_controller(name, part).is_none())
    };
    let found = findings(&suite, &run, &explains, &|divergence| divergence.summary());
    let rules: Vec<_> = found.iter().map(|finding| finding.rule.map(|rule| &*rule.id)).collect();
    assert_eq!(rules, [Some("order.feed-before-units")]);
    // A quirk of LinuxCNC does the same in one case. It does not explain another controller.
    assert_eq!(found[0].cases.len(), 3);
}
