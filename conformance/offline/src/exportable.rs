//! What the route can carry: what a person can set up before the start, and see after the end.

use gaugeblock_vocabulary::scenario::Environment;
use gaugeblock_vocabulary::{End, Outcome, Scenario};

/// The environment that answers as said, and as any machine does where nothing is said.
pub(super) const USUAL: &str = "whole controller";

/// Whether a person can run the scenario.
///
/// # Errors
/// The reason why not.
pub(super) fn check_exportable(
    scenario: &Scenario,
    expected: &Outcome,
) -> Result<(), &'static str> {
    if !scenario.operator.is_empty() {
        return Err("a person has to act at an exact moment of the run");
    }
    check_environment(&scenario.environment)?;
    match &expected.end {
        End::BudgetExhausted { .. } => Err("the program does not end by itself"),
        End::Unsupported { .. } => Err("the specification does not say it yet"),
        End::Unspecified { .. } => Err("the documents leave it open"),
        End::ProgramEnd
        | End::PercentEnd
        | End::StreamEnd
        | End::Endless
        | End::Paused
        | End::Aborted
        | End::Fault(_) => Ok(()),
    }
}

fn check_environment(environment: &Environment) -> Result<(), &'static str> {
    let Environment {
        name,
        wires,
        inputs,
        orient,
        probe,
        tool_change_time,
        manual_tool_change,
        user_programs,
    } = environment;
    if name.as_deref().is_some_and(|name| name != USUAL) {
        return Err("the surroundings have to answer as one certain program does");
    }
    if inputs.iter().any(|change| change.time > 0.0) {
        return Err("inputs have to change at an exact moment of the run");
    }
    if !wires.is_empty() {
        return Err("outputs have to be wired to inputs");
    }
    if !orient.is_empty() || probe.is_some() {
        return Err("an encoder or a probe has to answer in a certain way");
    }
    if *tool_change_time != 0.0 || *manual_tool_change {
        return Err("the tool changer has to answer in a certain way");
    }
    if !user_programs.is_empty() {
        return Err("programs of user-defined codes have to be installed");
    }
    Ok(())
}
