//! Checks an adapter before anything is certified. Each check runs one or two scenarios and reports one sentence.

mod declared;
mod extensions;
mod result;

use gaugeblock_adapter::exec::Exec;
use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::{End, Language, Outcome, Scenario};

pub use result::{Check, CheckResult};
use result::{changing, compare_outcomes};

/// Programs that controls accept, by language, and the same with one word that no control accepts. The first one that
/// a controller declares to have counts.
const PROGRAMS: &[(Language, &str, &str)] = &[
    (Language::Rs274, "g21\ng0 x1\nm2\n", "g21\ng999 x1\nm2\n"),
    (Language::Rs274, "g0 x1\nm2\n", "g999 x1\nm2\n"),
    (Language::Rs274, "g0 x1\nm30\n", "g999 x1\nm30\n"),
    (Language::Nct, "O1\nG0 X1\nM30\n", "O1\nG0 X[1/0]\nM30\n"),
];

/// The hint for an adapter that does not declare which part of RS-274 it has.
const NO_LANGUAGE: &str = "it declares no `language`: if it has a part of RS-274, `fuzz` compares few of its programs\n\
     hint: list its codes, axes and letters in `language`; `gaugeblock adapter protocol` describes it";

/// Runs of the measurement of speed.
const RUNS: u32 = 50;

/// Runs all checks, with programs of the suite for declared observables. `clock` returns seconds.
pub fn checks(adapter: &Exec, suite: &Suite, clock: &dyn Fn() -> f64) -> Vec<Check> {
    let declared = adapter.declaration();
    let told = format!("{} {}, protocol {}", declared.name, declared.version, declared.protocol);
    let mut found = vec![Check { name: "declaration", result: CheckResult::Passed(told) }];
    let mut add = |what, result| found.push(Check { name: what, result });
    add("unknown operation", unknown_operation(adapter));
    let of = |language: Language, text: &str| {
        let mut scenario = Scenario::of(text);
        scenario.program.language = language;
        if let Some(unit) = declared.units.first() {
            scenario.machine.length_unit = *unit;
        }
        scenario
    };
    let speaks = |(language, ..): &&(Language, &str, &str)| declared.languages.contains(language);
    let has = |(language, program, _): &&(Language, &str, &str)| {
        adapter.supports(&of(*language, program)).is_ok()
    };
    let program = PROGRAMS.iter().filter(speaks).find(has);
    let Some((language, accepted, refused)) = program else {
        let why = "its languages have no program of a move and an end that needs nothing else";
        add("accepts", CheckResult::Skipped(why.to_owned()));
        return found;
    };
    let scenario = |text: &str| of(*language, text);
    let plain = scenario(accepted);
    let first = adapter.run(&plain);
    add("accepts", accepts(&first, accepted));
    add("refuses", refuses(adapter, &scenario(refused), refused));
    let Ok(first) = first else { return found };
    add("configuration", configuration(adapter, accepted, &scenario));
    add(
        "same again",
        compare_outcomes(&first, &adapter.run(&plain), "the same program gives another outcome"),
    );
    add("reset", reset(adapter, &first, &plain));
    add(
        "new session",
        match adapter.run_fresh(&plain) {
            Some(anew) => compare_outcomes(
                &first,
                &anew,
                "a new session gives another outcome than one that was reset",
            ),
            None => CheckResult::Skipped("each run is a new one".to_owned()),
        },
    );
    add("speed", speed(adapter, &plain, clock));
    found.extend(declared::checks(adapter, suite));
    found.extend(extensions::checks(adapter, &plain, &first));
    if declared.language.is_none() && declared.languages.contains(&Language::Rs274) {
        let result = CheckResult::Skipped(NO_LANGUAGE.to_owned());
        found.push(Check { name: "language", result });
    }
    found
}

fn unknown_operation(adapter: &Exec) -> CheckResult {
    match adapter.check_unknown_operation() {
        Ok(()) => CheckResult::Passed("is refused, and the session goes on".to_owned()),
        Err(error) => CheckResult::Failed(format!(
            "an unknown operation must be answered with `refused`, and an unknown member be ignored: {error}"
        )),
    }
}

fn accepts(outcome: &Result<Outcome, HarnessError>, program: &str) -> CheckResult {
    let end = match outcome {
        Ok(outcome) => &outcome.end,
        Err(error) => return CheckResult::Failed(format!("{program:?}: {error}")),
    };
    if *end == End::ProgramEnd {
        return CheckResult::Passed(format!("{program:?}"));
    }
    if let End::Unsupported { what, .. } = end {
        return CheckResult::Failed(format!(
            "{program:?} is not supported ({what}): of a controller that runs nothing, nothing is certified"
        ));
    }
    CheckResult::Failed(format!(
        "{program:?} ends as {}: this is a broken adapter rather than a broken controller",
        end.name()
    ))
}

fn refuses(adapter: &Exec, scenario: &Scenario, program: &str) -> CheckResult {
    let observables = &adapter.declaration().observables;
    let Outcome { end, steps, .. } = match adapter.run(scenario) {
        Ok(outcome) => outcome,
        Err(error) => return CheckResult::Failed(format!("{program:?}: {error}")),
    };
    if let End::Fault(fault) = end {
        if !observables.refusals {
            return CheckResult::Failed(format!(
                "{program:?} is refused; expected no fault: `observables.refusals` is false"
            ));
        }
        if observables.blocks
            && let Some(block) = &fault.block
            && steps.iter().any(|step| step.block == *block)
        {
            return CheckResult::Failed(format!(
                "{program:?} is refused at {block}, but `steps` has this block; a refused block is not a step"
            ));
        }
        let without = if fault.block.is_some() { "" } else { ", without its block" };
        return CheckResult::Passed(format!("{program:?}{without}"));
    }
    if let End::Unsupported { what, .. } = end {
        return CheckResult::Skipped(format!("{program:?} is not supported: {what}"));
    }
    if !observables.refusals {
        let why = "it declares that it never refuses a block (`observables.refusals` is false)";
        return CheckResult::Skipped(why.to_owned());
    }
    CheckResult::Failed(format!(
        "{program:?} ends as {}; expected a fault: an alarm is reported as a fault",
        end.name()
    ))
}

/// Parameters that controllers store, by the documents, and that change no motion of a short program: the points of G28
/// and G30. The others are volatile or have a meaning.
const STORED: [u32; 3] = [5161, 5162, 5181];

/// Checks that a stored parameter is reported at the end.
fn configuration(
    adapter: &Exec,
    program: &str,
    scenario: &dyn Fn(&str) -> Scenario,
) -> CheckResult {
    let declared = adapter.declaration();
    let observables =
        declared.features.contains("parameters") && declared.observables.final_parameters;
    if !observables || !declared.languages.contains(&Language::Rs274) {
        let why = "it declares no feature `parameters`, or does not report parameters at the end";
        return CheckResult::Skipped(why.to_owned());
    }
    let hidden = adapter.capabilities().hidden_parameters.clone();
    let is_reported = |number: &u32| !hidden.iter().any(|range| range.contains(number));
    let Some(number) = STORED.into_iter().find(is_reported) else {
        return CheckResult::Skipped(
            "it reports none of the parameters that are stored".to_owned(),
        );
    };
    let mut stored = scenario(program);
    stored.machine.parameters.0.insert(number, 7.5);
    match adapter.run(&stored) {
        Ok(outcome) => {
            let found = outcome.parameters.as_ref().and_then(|all| all.0.get(&number).copied());
            if found == Some(7.5) {
                CheckResult::Passed("a stored parameter comes back".to_owned())
            } else {
                CheckResult::Failed(format!(
                    "#{number} = 7.5 was stored before the run; at the end it reports {found:?}"
                ))
            }
        }
        Err(error) => CheckResult::Failed(error.to_string()),
    }
}

/// Checks that a reset leaves nothing of a program that changes much. That program may be refused: it has changed
/// something before.
fn reset(adapter: &Exec, first: &Outcome, plain: &Scenario) -> CheckResult {
    if plain.program.language != Language::Rs274 {
        return CheckResult::Skipped(
            "only a controller of rs274 has a program that changes much".to_owned(),
        );
    }
    let changes = changing(adapter, plain);
    match adapter.run(&changes) {
        Ok(_) => compare_outcomes(
            first,
            &adapter.run(plain),
            "something of an earlier program is left after `reset`",
        ),
        Err(error) => CheckResult::Failed(format!("{:?}: {error}", changes.program.main)),
    }
}

fn speed(adapter: &Exec, plain: &Scenario, clock: &dyn Fn() -> f64) -> CheckResult {
    let begun = clock();
    for _ in 0..RUNS {
        if let Err(error) = adapter.run(plain) {
            return CheckResult::Failed(error.to_string());
        }
    }
    let each = (clock() - begun) / f64::from(RUNS);
    CheckResult::Passed(format!("{:.1} ms a run", each * 1000.0))
}
