//! Finds quirks and options of choices under which the model has the same outcome as a controller.

use gaugeblock_suite::{Choice, ChoiceKind};
use gaugeblock_vocabulary::{Options, Scenario};

use super::plan::Plan;

impl Plan<'_> {
    /// The quirks and options of `choices` that each explain a divergence from the model, or that it does not come
    /// again. Empty if the controller is compared with another controller.
    ///
    /// Costs a run of the model for each option.
    pub fn causes(&self, scenario: &Scenario, choices: &[&Choice]) -> Vec<String> {
        if self.against.capabilities().name != "reference" {
            return Vec::new();
        }
        let Ok(found) = self.iut.run(scenario) else { return Vec::new() };
        let explains = |options: Options| {
            let under = Scenario { options, ..scenario.clone() };
            let (expected, _) = gaugeblock_reference::run(&under);
            expected.end.undetermined().is_none()
                && self.divergence(&under, expected, found.clone()).is_none()
        };
        if explains(scenario.options.clone()) {
            return vec![
                "chance, or what an earlier program left: run again, it agrees".to_owned(),
            ];
        }
        let mut causes = Vec::new();
        for choice in choices {
            for option in choice.options.iter().map(|option| &option.name) {
                let mut options = scenario.options.clone();
                options.0.insert(choice.id.clone(), option.clone());
                if !scenario.options.is(&choice.id, option) && explains(options) {
                    causes.push(match choice.kind {
                        ChoiceKind::Quirk => choice.id.clone(),
                        ChoiceKind::Choice => format!("{} = {option}", choice.id),
                    });
                }
            }
        }
        causes
    }
}
