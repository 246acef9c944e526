//! Properties that hold for every scenario.
//!
//! None of them needs a second controller: the model keeps its [invariants](model_invariants), the two scenarios of a
//! [metamorphic pair](metamorphic()) have equal effects, a run with a small budget is a [prefix](budget_prefix) of a
//! longer one, and [chunked input](chunked_input()) changes nothing in production.

mod chunked_input;
mod metamorphic;
mod prefix;

use gaugeblock_vocabulary::{Bound, End, Event, Outcome, Scenario};

pub use chunked_input::chunked_input;
pub use metamorphic::metamorphic;
pub use prefix::budget_prefix;

/// Runs the model and checks its invariants.
///
/// * It ends with an outcome, within the budget; a panic reaches the caller.
/// * Two runs give the same outcome and the same evidence.
/// * The text form of the outcome loses nothing.
///
/// # Errors
/// The invariant that is broken, and the outcome.
pub fn model_invariants(scenario: &Scenario) -> Result<Outcome, String> {
    let (outcome, coverage) = gaugeblock_reference::run(scenario);
    let broken = |promise: &str| Err(format!("{promise}:\n{}", outcome.to_text()));
    if let Some(bound) = beyond_budget(scenario, &outcome) {
        return broken(&format!("the budget is kept, in {bound}"));
    }
    if gaugeblock_reference::run(scenario) != (outcome.clone(), coverage) {
        return broken("two runs give the same");
    }
    match Outcome::from_text(&outcome.to_text()) {
        Ok(read) if read == outcome => Ok(outcome),
        Ok(_) => broken("the text form loses nothing"),
        Err(error) => broken(&format!("the text form can be read ({error})")),
    }
}

/// The bound of the budget that an outcome exceeds. The trace may contain the block at which the budget runs out.
fn beyond_budget(scenario: &Scenario, outcome: &Outcome) -> Option<Bound> {
    let steps = outcome.steps.len();
    let events = outcome.steps.iter().flat_map(|step| &step.events);
    let effects = events.filter(|event| matches!(event, Event::Do(_))).count();
    let within = |count: usize, bound: u32| u32::try_from(count).is_ok_and(|count| count <= bound);
    let exhausted = |bound| outcome.end == End::BudgetExhausted { bound };
    if !within(steps, scenario.budget.steps.saturating_add(1)) {
        Some(Bound::Steps)
    } else if !within(effects, scenario.budget.effects) && !exhausted(Bound::Effects) {
        Some(Bound::Effects)
    } else {
        None
    }
}
