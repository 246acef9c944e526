//! A run with a smaller budget is a prefix of a longer one.

use gaugeblock_vocabulary::{End, Outcome, Scenario};

/// Runs a scenario with its budget and with less, and compares the blocks that both executed.
///
/// # Errors
/// A shorter run is not a prefix of the longer one, or it does not end as exhausted.
pub fn budget_prefix(
    scenario: &Scenario,
    run: &mut dyn FnMut(&Scenario) -> Option<Outcome>,
) -> Result<(), String> {
    let Some(whole) = run(scenario) else { return Ok(()) };
    for steps in [1, 5, 17] {
        let mut less = scenario.clone();
        less.budget.steps = steps;
        let Some(part) = run(&less) else { continue };
        // The block at which the budget ran out may have begun.
        let sure = part.steps.len().saturating_sub(1).min(whole.steps.len());
        if part.steps[..sure] != whole.steps[..sure] {
            return Err(format!(
                "with a budget of {steps} blocks another run begins:\n{}",
                part.to_text()
            ));
        }
        let ended = matches!(part.end, End::BudgetExhausted { .. });
        if !ended && part.steps.len() < whole.steps.len() {
            return Err(format!("a budget of {steps} blocks ended it as {}", part.end.name()));
        }
    }
    Ok(())
}
