//! A controller whose machine has millimetres only.

use std::num::NonZero;

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_controllers::Production;
use gaugeblock_runner::certify::{Plan, Scope, Verdict, certify};
use gaugeblock_suite::{Case, Suite};
use gaugeblock_vocabulary::{LengthUnit, Outcome, Scenario};

/// Production on a machine that has millimetres only.
#[derive(Debug, Default)]
struct Metric(Production);

impl Adapter for Metric {
    fn capabilities(&self) -> &Capabilities {
        self.0.capabilities()
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        if scenario.machine.length_unit != LengthUnit::Millimetre {
            return Err("its machine has no unit inch".to_owned());
        }
        self.0.supports(scenario)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        self.0.run(scenario)
    }
}

#[test]
fn cases_of_a_machine_in_inches_are_judged_on_a_metric_machine() {
    let suite = Suite::read(&gaugeblock_embedded_suite::files().expect("the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")));
    let edition = suite.edition("linuxcnc-2.9").expect("the edition");
    let is_in_inches = |case: &Case| case.setup.machine.length_unit == LengthUnit::Inch;
    let rules = suite.rules.iter().filter(|rule| rule.cases.iter().any(is_in_inches));
    let only: Vec<String> = rules.map(|rule| rule.id.clone()).collect();
    let jobs = NonZero::new(2).expect("two");
    let plan = Plan { suite: &suite, edition, only: &only, jobs, scope: Scope::Full };
    let run = certify(plan, &Metric::default(), &|| {});
    let mut not_judged = 0;
    for result in &run.cases {
        let left_out =
            if let Verdict::Unsupported(why) = &result.verdict { Some(why) } else { None };
        not_judged += usize::from(left_out.is_some_and(|why| why.contains("no unit inch")));
        let is_right = result.verdict == Verdict::Pass || left_out.is_some();
        assert!(is_right, "{} / {}: {}", result.rule.id, result.name, result.verdict);
    }
    // What is left asserts a number in the unit of the machine.
    assert!(not_judged < 60, "{not_judged} cases are judged on a machine in inches only");
}
