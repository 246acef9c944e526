//! Whole programs, run by the model: what the rooms do together. The rules one by one are the suite's matter.

mod endings;
mod labels;
mod offsets;
mod records;
mod robustness;
mod subroutines;

use gaugeblock_reference::run;
use gaugeblock_vocabulary::{End, FaultKind, Outcome, Scenario};

/// Runs a program under the defaults.
fn outcome(program: &str) -> Outcome {
    run(&Scenario::of(program)).0
}

/// Runs a program under these options.
fn outcome_under(options: &[(&str, &str)], program: &str) -> Outcome {
    let mut scenario = Scenario::of(program);
    scenario.options.0 =
        options.iter().map(|(id, option)| ((*id).to_owned(), (*option).to_owned())).collect();
    run(&scenario).0
}

/// How a run ended, in short: `program_end`, `unknown_sub at main.ngc:3`.
fn ending(outcome: &Outcome) -> String {
    match &outcome.end {
        End::Fault(fault) => {
            let kind = fault.kind.map_or("a fault", FaultKind::word);
            let block = fault.block.as_ref().map_or_else(String::new, ToString::to_string);
            format!("{kind} at {block}")
        }
        End::BudgetExhausted { bound } => format!("budget of {bound}"),
        End::Unsupported { block, .. } => format!("unsupported at {block}"),
        End::Unspecified { block, .. } => format!("unspecified at {block}"),
        End::ProgramEnd
        | End::PercentEnd
        | End::StreamEnd
        | End::Endless
        | End::Paused
        | End::Aborted => outcome.end.name().to_owned(),
    }
}

/// A numbered parameter at the end.
fn parameter(outcome: &Outcome, number: u32) -> f64 {
    let parameters = outcome.parameters.as_ref().expect("the model shows parameters");
    parameters.0.get(&number).copied().unwrap_or(0.0)
}

/// Runs a program that must end as it should, with these parameters at the end.
#[track_caller]
fn gives(program: &str, expected: &[(u32, f64)]) {
    let outcome = outcome(program);
    assert_eq!(ending(&outcome), "program_end", "{program}\n{}", outcome.to_text());
    for (number, value) in expected {
        let found = parameter(&outcome, *number);
        assert!((found - value).abs() < 1e-9, "{program}\n#{number} = {found}");
    }
}

/// Runs a program that must be refused.
#[track_caller]
fn refuses(program: &str, fault: &str) {
    let outcome = outcome(program);
    assert_eq!(ending(&outcome), fault, "{program}\n{}", outcome.to_text());
}
