//! The specification: what a CNC program means, as a model that runs.
//!
//! Read it top to bottom. [`rs274`] runs each block through `text → syntax → evaluate → check → order → execute →
//! record`; `control` names the next block. Each section carries the id of the rule that it states; the rule's page in
//! the suite has its sentence, its sources and its cases. [`gpp`] has another language, in `text → formats → variables →
//! toolpath → syntax → evaluate → status → print → record → run`; [`nct`] the third, in `text → syntax → programs →
//! variables → evaluate → words → arguments → calls → modes → motion → record → run`.
//!
//! **Invariants.** It reads nothing but the scenario: no clock, no file, no environment, no random source. It panics on
//! no scenario. It is written from the documents, without reading the production interpreter.

mod choices;
mod coverage;
#[cfg(feature = "dialects")]
pub mod dialects;
#[cfg(not(feature = "dialects"))]
#[path = "no_dialects/mod.rs"]
mod dialects;
pub mod gpp;
pub mod ids;
mod math;
pub mod motion;
pub mod nct;
pub mod rs274;

pub use choices::Choices;
pub(crate) use choices::Consulted;
pub use coverage::{RuleCoverage, RuleOutcome, Tally};

pub use rs274::RunCache;
pub use rs274::modes::Rounding;

use std::collections::BTreeSet;
use std::sync::Arc;

use gaugeblock_vocabulary::{Language, Options, Outcome, Scenario};

/// Whether this build can read the documents with these options.
///
/// # Errors
/// An option that needs the feature `dialects`, as a sentence.
pub fn accepts_options(options: &Options) -> Result<(), String> {
    dialects::accepts_options(options)
}

/// What the documents say about a scenario, and the rules that were reached.
///
/// Time and memory are linear in the executed blocks, which the scenario's budget bounds.
pub fn run(scenario: &Scenario) -> (Outcome, RuleCoverage) {
    run_with(&mut RunCache::default(), scenario)
}

/// The same, faster where many runs follow one another: each keeps what the next one need not make anew. Nothing of
/// it shows in what a run says.
pub fn run_with(cache: &mut RunCache, scenario: &Scenario) -> (Outcome, RuleCoverage) {
    run_as(cache, scenario, Rounding::AsComputed)
}

/// The same, with positions rounded in another way. Where that changes the answer, the documents have none.
pub fn run_rounded(scenario: &Scenario, rounding: Rounding) -> (Outcome, RuleCoverage) {
    run_as(&mut RunCache::default(), scenario, rounding)
}

/// What [`run`] says of the outcome, with the ids of the choices and deviations that the run consults. Another option
/// of any other one does not change the outcome. The ids are recorded for RS-274 alone.
pub fn run_consulting(scenario: &Scenario) -> (Outcome, Option<BTreeSet<&'static str>>) {
    let consulted = Arc::new(Consulted::default());
    let mut cache = RunCache::consulting(consulted.clone());
    let (outcome, _) = run_with(&mut cache, scenario);
    let is_known = scenario.program.language == Language::Rs274;
    (outcome, is_known.then(|| consulted.ids()))
}

fn run_as(
    cache: &mut RunCache,
    scenario: &Scenario,
    rounding: Rounding,
) -> (Outcome, RuleCoverage) {
    match scenario.program.language {
        Language::Rs274 => rs274::run(cache, scenario, rounding),
        Language::Gpp => gpp::run(scenario),
        Language::Nct => nct::run(scenario),
    }
}
