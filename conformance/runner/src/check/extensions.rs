//! Checks of the extensions that an adapter declares.

use gaugeblock_adapter::exec::Exec;
use gaugeblock_adapter::protocol::digest::{canonical, digest};
use gaugeblock_adapter::protocol::{EXTENSIONS, Extension};
use gaugeblock_adapter::{Adapter, HarnessError, MotionRequest, NoSamples};
use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::motion::{MotionLimits, MotionScript};
use gaugeblock_vocabulary::scenario::{Action, OperatorEvent, RunPoint};
use gaugeblock_vocabulary::{BlockLocation, Language, Outcome, Program, Scenario};

use super::result::{Check, CheckResult, changing, compare_outcomes};

/// A machine for a short motion.
const MACHINE: &str = "period = 0.001\n[axes.x]\nvelocity = 50.0\nacceleration = 500.0\n[axes.y]\nvelocity = 50.0\nacceleration = 500.0\n[axes.z]\nvelocity = 50.0\nacceleration = 500.0\n";

/// Checks each declared extension, given a plain scenario and its outcome.
pub(super) fn checks(adapter: &Exec, plain: &Scenario, first: &Outcome) -> Vec<Check> {
    let offered = |(extension, ..): &&(Extension, &str, &str)| {
        adapter.declaration().offers.contains(extension)
    };
    let check = |(extension, ..): &(Extension, &'static str, &str)| {
        let (what, result) = match extension {
            Extension::Cancel => ("offer cancel", cancel(adapter, plain, first)),
            Extension::Digest => ("offer digest", digest_matches(adapter, plain, first)),
            Extension::Files => {
                ("offer files", same_with_extension(adapter, Extension::Files, plain))
            }
            Extension::Fresh => ("offer fresh", fresh(adapter, plain, first)),
            Extension::LiveOperator => ("offer live-operator", live_operator(adapter, plain)),
            Extension::Motion => ("offer motion", motion(adapter, plain)),
            Extension::Shows => ("offer shows", observables(adapter, plain)),
            Extension::State => ("offer state", state(adapter, plain)),
            Extension::Stream => {
                ("offer stream", same_with_extension(adapter, Extension::Stream, plain))
            }
        };
        Check { name: what, result }
    };
    EXTENSIONS.iter().filter(offered).map(check).collect()
}

fn failed(error: &HarnessError) -> CheckResult {
    CheckResult::Failed(error.to_string())
}

/// Checks that the outcome is the same with the extension and without.
fn same_with_extension(adapter: &Exec, extension: Extension, scenario: &Scenario) -> CheckResult {
    match adapter.run_with_extensions(&[], scenario) {
        Ok(plainly) => {
            let otherwise = "in this form it is another outcome";
            compare_outcomes(
                &plainly,
                &adapter.run_with_extensions(&[extension], scenario),
                otherwise,
            )
        }
        Err(error) => failed(&error),
    }
}

fn cancel(adapter: &Exec, plain: &Scenario, first: &Outcome) -> CheckResult {
    let mut long = plain.clone();
    if plain.program.language == Language::Rs274 {
        long.program.main = "g4 p30\nm2\n".into();
    }
    match adapter.run_after_cancel(&long, plain) {
        Ok(Some(after)) => {
            compare_outcomes(first, &Ok(after), "after `cancel` there is another outcome")
        }
        Ok(None) => CheckResult::Failed(
            "`cancel` must be answered with `done` within 2 s, while a run goes on".to_owned(),
        ),
        Err(error) => failed(&error),
    }
}

fn digest_matches(adapter: &Exec, plain: &Scenario, first: &Outcome) -> CheckResult {
    match adapter.digest_of(plain) {
        Ok(None) => CheckResult::Skipped("it answers with the outcome".to_owned()),
        Ok(Some(answer)) if answer == digest(first) => {
            CheckResult::Passed("is that of the outcome".to_owned())
        }
        Ok(Some(answer)) => CheckResult::Failed(format!(
            "{answer:?} is not the SHA-256 of the outcome as canonical JSON: {}",
            canonical(first)
        )),
        Err(error) => failed(&error),
    }
}

fn fresh(adapter: &Exec, plain: &Scenario, first: &Outcome) -> CheckResult {
    let leaks = "after another run, without a `reset`, there is another outcome";
    compare_outcomes(first, &adapter.run_after(&changing(adapter, plain), plain), leaks)
}

fn live_operator(adapter: &Exec, plain: &Scenario) -> CheckResult {
    if !adapter.declaration().features.contains("operator") {
        return CheckResult::Failed("it declares no feature `operator`".to_owned());
    }
    let mut operated = plain.clone();
    let block = BlockLocation::new(Program::MAIN, 2);
    let when = RunPoint { block, execution: 1, offset: 0.0 };
    operated.operator.push(OperatorEvent { when, action: Action::Abort });
    same_with_extension(adapter, Extension::LiveOperator, &operated)
}

fn motion(adapter: &Exec, plain: &Scenario) -> CheckResult {
    let limits = match MotionLimits::from_text(MACHINE) {
        Ok(limits) => limits,
        Err(error) => return CheckResult::Skipped(error.to_string()),
    };
    let script = MotionScript::default();
    let motion =
        MotionRequest { scenario: plain, limits: &limits, script: &script, feed_interval: None };
    match adapter.record_motion(&motion) {
        Ok(samples) if samples.is_empty() => CheckResult::Failed("a move has no sample".to_owned()),
        Ok(samples) => CheckResult::Passed(format!(
            "{} samples, {:?} s apart",
            samples.len(),
            samples.period()
        )),
        Err(NoSamples::Unsupported(why)) => CheckResult::Skipped(why),
        Err(NoSamples::Failed(why)) => CheckResult::Failed(why.to_string()),
    }
}

fn observables(adapter: &Exec, plain: &Scenario) -> CheckResult {
    let own = adapter.capabilities();
    match adapter.query_observables_of(plain) {
        Ok(observables) if is_within(&observables, own) => {
            CheckResult::Passed("is no more than what is declared".to_owned())
        }
        Ok(_) => CheckResult::Failed(
            "it reports more, or more exactly, of a program than it declares: that is not judged"
                .to_owned(),
        ),
        Err(error) => failed(&error),
    }
}

/// Whether nothing is reported beyond the declaration. Declared hidden parameters need not be named again.
fn is_within(observables: &Capabilities, own: &Capabilities) -> bool {
    let hidden_parameters = observables.hidden_parameters.clone();
    Capabilities { hidden_parameters, ..own.and(observables) } == *observables
}

fn state(adapter: &Exec, plain: &Scenario) -> CheckResult {
    match adapter.reset_after(&changing(adapter, plain)) {
        Ok(()) => CheckResult::Passed("is the same after `reset` as at first".to_owned()),
        Err(error) => failed(&error),
    }
}
