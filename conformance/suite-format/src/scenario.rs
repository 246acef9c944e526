//! What a case is run with, and what is asserted of it, under an edition.

use gaugeblock_vocabulary::scenario::Environment;
use gaugeblock_vocabulary::{Options, Scenario};

use crate::{Assertion, Case, Edition, Suite};

/// The options of a comparison: those of the edition, replaced by those that the controller declares.
pub fn options_of(suite: &Suite, edition: &Edition, declared: &Options) -> Options {
    let mut options = suite.options(edition);
    for (id, option) in declared.0.iter() {
        options.0.insert(id.clone(), option.clone());
    }
    options
}

/// The scenario of a case under an edition. The edition's environment answers where the case has none of its own.
pub fn scenario_of(case: &Case, options: &Options, edition: &Edition) -> Scenario {
    let mut scenario = case.setup.scenario(&case.program, options);
    scenario.program.language = edition.language;
    if scenario.environment == Environment::default() {
        scenario.environment.name.clone_from(&edition.environment);
    }
    scenario
}

/// Whether an assertion is made under these options.
pub fn applies(assertion: &Assertion, options: &Options, edition: &str) -> bool {
    assertion.guards.iter().all(|(id, option)| match id.as_str() {
        "edition" => option == edition,
        _ => options.is(id, option),
    })
}
