//! A controller that declares that it never refuses a block.

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_controllers::Production;
use gaugeblock_runner::fingerprint::{ObservedOption, observe_choice};
use gaugeblock_suite::{Choice, Edition, Suite};
use gaugeblock_vocabulary::{End, Outcome, Scenario};

/// Production; a block that it refuses is left out, together with the rest of the program.
#[derive(Debug)]
struct NeverRefuses {
    production: Production,
    capabilities: Capabilities,
}

impl Adapter for NeverRefuses {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        self.production.supports(scenario)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        let outcome = self.production.run(scenario)?;
        let end = if let End::Fault(_) = outcome.end { End::ProgramEnd } else { outcome.end };
        Ok(Outcome { end, ..outcome })
    }
}

fn refuses(choice: &Choice, option: &str) -> bool {
    let mut options = choice.options.iter().filter(|known| known.name == option);
    options.any(|known| known.assertions.iter().any(|assertion| assertion.starts_with("refused")))
}

#[test]
fn never_refusing_controller_has_no_option_that_refuses() {
    let suite = Suite::read(&gaugeblock_embedded_suite::files().expect("the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")));
    let edition: &Edition = suite.edition("linuxcnc-2.9").expect("the edition");
    let options = suite.options(edition);
    let production = Production::default();
    let capabilities = Capabilities { refuses: false, ..production.capabilities().clone() };
    let controller = NeverRefuses { production, capabilities };
    let mut with_refusal = 0;
    for choice in suite.choices.iter().filter(|choice| options.get(&choice.id).is_some()) {
        let Some(option) = choice.options.iter().find(|option| refuses(choice, &option.name))
        else {
            continue;
        };
        with_refusal += 1;
        let observed = observe_choice(choice, &options, None, &controller, false);
        let has_it = match &observed {
            ObservedOption::Option(shown) => *shown == option.name,
            ObservedOption::Several(shown) => shown.contains(&option.name),
            ObservedOption::Nothing(_) | ObservedOption::Refused(_) | ObservedOption::NotRun(_) => {
                false
            }
        };
        assert!(!has_it, "{}: {observed}", choice.id);
    }
    assert!(with_refusal > 10, "{with_refusal} choices have an option that refuses");
}
