//! Compares what the laws decide about a case of motion with the assertions of its page.

use std::collections::BTreeMap;

use gaugeblock_reference::Choices;
use gaugeblock_reference::motion::laws::{Judgement, Law, Verdict, judge_under};
use gaugeblock_suite::{MotionAssertion, MotionCase, Setup};
use gaugeblock_vocabulary::motion::{ProgrammedPath, Samples};
use gaugeblock_vocabulary::{End, Options, Position, Scenario};

/// Servo cycles between segments that the planner gets; without a number, as fast as it takes them.
pub const FEED_INTERVALS: [Option<u32>; 6] = [None, Some(1), Some(5), Some(20), Some(31), Some(80)];

/// An assertion that fails, as written, and what was found.
pub(super) type FailedAssertion = (String, String);

/// The scenario of a case under some options, and its programmed path in the model.
///
/// # Errors
/// The program does not reach its end.
pub fn scenario_and_path(
    case: &MotionCase,
    options: &Options,
    environment: Option<&String>,
) -> Result<(Scenario, ProgrammedPath), String> {
    let mut scenario = Setup::default().scenario(&case.program, options);
    scenario.environment.name = environment.cloned();
    // The machine has every axis that the limits of the case name.
    let axes = &mut scenario.machine.axes;
    axes.extend(case.limits()?.axes.into_keys());
    axes.sort_unstable();
    axes.dedup();
    let (outcome, _) = gaugeblock_reference::run(&scenario);
    if outcome.end != End::ProgramEnd {
        return Err(format!("the model does not reach the program end: {}", outcome.end.name()));
    }
    let path = gaugeblock_reference::motion::path::programmed(&outcome, Position::default());
    Ok((scenario, path))
}

/// Checks the assertions of a page. `readings` are the options under which the laws judge; `rule` is the page's.
///
/// # Errors
/// The first assertion that fails.
pub fn check_assertions(
    case: &MotionCase,
    rule: &str,
    readings: &BTreeMap<String, String>,
    (samples, path): (&Samples, &ProgrammedPath),
) -> Result<(), FailedAssertion> {
    let wrong = |error: String| (case.assertions.join(", "), error);
    let limits = case.limits().map_err(wrong)?;
    let readings = readings.iter().map(|(id, option)| (id.as_str(), option.as_str()));
    let choices = Choices::of_motion(readings).map_err(wrong)?;
    let judgement = judge_under(choices, samples, path, &limits, &case.script());
    let mut broken = first_violations(&judgement);
    let mut holds = false;
    for (text, assertion) in case.assertions.iter().zip(case.parsed()) {
        let found = match assertion {
            MotionAssertion::Holds => {
                holds = true;
                check_law_of_page(&judgement, rule)
            }
            MotionAssertion::Breaks { law, at } => {
                check_violation(&judgement, &law, at, broken.remove(law.as_str()))
            }
            MotionAssertion::NotApplicable { law } => {
                let fits = |verdict: &Verdict| *verdict == Verdict::NotApplicable;
                check_verdict(&judgement, &law, fits)
            }
            MotionAssertion::NotJudged { law } => {
                check_verdict(&judgement, &law, |verdict| matches!(verdict, Verdict::NotJudged(_)))
            }
        };
        if let Err(found) = found {
            return Err((text.clone(), found));
        }
    }
    // A violation that no assertion names is a false verdict, or the page is not complete.
    match broken.into_values().next() {
        Some((_, words)) if holds => Err(("holds".to_owned(), words)),
        Some((_, words)) => Err(("nothing else breaks".to_owned(), words)),
        None => Ok(()),
    }
}

fn first_violations(judgement: &Judgement) -> BTreeMap<&'static str, (usize, String)> {
    let mut first = BTreeMap::new();
    for violation in judgement.violations() {
        let found = (violation.cycle, violation.to_string());
        let known = first.entry(violation.law.id()).or_insert_with(|| found.clone());
        if violation.cycle < known.0 {
            *known = found;
        }
    }
    first
}

fn law_by_id(id: &str) -> Option<Law> {
    Law::ALL.iter().copied().find(|law| law.id() == id)
}

fn verdict_of<'a>(judgement: &'a Judgement, id: &str) -> Result<&'a Verdict, String> {
    law_by_id(id).and_then(|law| judgement.of(law)).ok_or_else(|| format!("there is no law {id}"))
}

/// A verdict in words, with the law.
fn describe(id: &str, verdict: &Verdict) -> String {
    match verdict {
        Verdict::Satisfied { .. } => format!("{id} holds"),
        Verdict::NotApplicable => format!("{id} does not apply"),
        Verdict::NotJudged(why) => format!("{id} is not judged: {why}"),
        Verdict::Violated(violations) => {
            violations.first().map_or_else(|| format!("{id} is broken"), ToString::to_string)
        }
    }
}

fn check_verdict(
    judgement: &Judgement,
    id: &str,
    fits: impl Fn(&Verdict) -> bool,
) -> Result<(), String> {
    let verdict = verdict_of(judgement, id)?;
    if fits(verdict) { Ok(()) } else { Err(describe(id, verdict)) }
}

/// Checks that the law of the page holds, if the page is that of a law.
fn check_law_of_page(judgement: &Judgement, rule: &str) -> Result<(), String> {
    if law_by_id(rule).is_none() {
        return Ok(());
    }
    check_verdict(judgement, rule, |verdict| matches!(verdict, Verdict::Satisfied { .. }))
}

fn check_violation(
    judgement: &Judgement,
    id: &str,
    at: Option<usize>,
    found: Option<(usize, String)>,
) -> Result<(), String> {
    match found {
        None => Err(describe(id, verdict_of(judgement, id)?)),
        Some((cycle, words)) if at.is_some_and(|at| at != cycle) => Err(words),
        Some(_) => Ok(()),
    }
}
