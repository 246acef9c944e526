//! Cases of motion: the laws of motion judge servo samples.

use gaugeblock_adapter::{Adapter, HarnessError, MotionRequest, NoSamples};
use gaugeblock_compare::{ComparedKind, end_text};
use gaugeblock_motion::Sketch;
use gaugeblock_suite::{MotionCase, Rule};
use gaugeblock_vocabulary::motion::{ProgrammedPath, Samples};
use gaugeblock_vocabulary::{End, Outcome, Scenario};

use super::CaseRunner;
use super::verdict::{CaseResult, Cause, NotJudgedReason, RuleDivergence, Verdict};

impl CaseRunner<'_> {
    /// Judges a case of motion: its recorded samples, or those that the controller plans at each feed interval.
    pub(super) fn run_motion<'r>(self, rule: &'r Rule, case: &'r MotionCase) -> CaseResult<'r> {
        let mut result = CaseResult::new(rule, &case.name, &case.program);
        let environment = self.plan.edition.environment.as_ref();
        match gaugeblock_motion::scenario_and_path(case, self.options, environment) {
            Ok((scenario, path)) => {
                let run = MotionRun { runner: self, rule, case, scenario: &scenario, path: &path };
                result.verdict = run.judge(&mut result);
            }
            Err(why) => result.verdict = Verdict::Inconclusive(why),
        }
        result
    }
}

/// A case of motion, its scenario and its programmed path.
#[derive(Clone, Copy)]
struct MotionRun<'a> {
    runner: CaseRunner<'a>,
    rule: &'a Rule,
    case: &'a MotionCase,
    scenario: &'a Scenario,
    path: &'a ProgrammedPath,
}

impl MotionRun<'_> {
    fn judge(self, result: &mut CaseResult<'_>) -> Verdict {
        let Self { runner, rule, case, scenario, path } = self;
        let readings = runner.plan.suite.motion_options(runner.plan.edition);
        let feeds: &[Option<u32>] =
            if case.is_recorded() { &[None] } else { &gaugeblock_motion::FEED_INTERVALS };
        let mut repeat = !case.is_recorded() && runner.repeat.includes(&rule.id, &case.name);
        for feed_interval in feeds {
            let samples = match samples_of(runner.controller, scenario, case, *feed_interval) {
                Ok(samples) => samples,
                Err(NoSamples::Unsupported(why)) => return Verdict::Unsupported(why),
                Err(no_samples @ NoSamples::Failed(_)) => {
                    let refusal = self.refusal().map(|found| self.diverges(found));
                    return refusal.unwrap_or_else(|| verdict_without_samples(no_samples));
                }
            };
            if std::mem::take(&mut repeat)
                && let Err(not_judged) = self.check_repeatable(&samples, *feed_interval)
            {
                return Verdict::NotJudged(not_judged);
            }
            let judged =
                gaugeblock_motion::check_assertions(case, &rule.id, &readings, (&samples, path));
            if judged.is_err() || result.sketch.is_none() {
                result.sketch = Some(Sketch::of(&samples, path));
            }
            match judged {
                Ok(()) => result.compared.add(ComparedKind::Laws, case.assertions.len()),
                Err((text, found)) => {
                    if let Some(refusal) = self.refusal() {
                        return self.diverges(refusal);
                    }
                    let fed = feed_interval
                        .map_or(String::new(), |n| format!("with a segment in {n} cycles: "));
                    return diverges(self.asserted(&text), format!("{fed}{found}"));
                }
            }
        }
        Verdict::Pass
    }

    /// The refusal of the program, if the controller refuses it and the model does not.
    ///
    /// Samples of a refused program end early or are missing. Their laws would hide the cause.
    fn refusal(self) -> Option<String> {
        if self.case.is_recorded() {
            return None;
        }
        let refuses = |outcome: &Outcome| matches!(outcome.end, End::Fault(_));
        if refuses(&gaugeblock_reference::run(self.scenario).0) {
            return None;
        }
        let controller = self.runner.controller;
        let outcome = controller.run_fresh(self.scenario);
        let outcome = outcome.unwrap_or_else(|| controller.run(self.scenario)).ok()?;
        let End::Fault(fault) = &outcome.end else { return None };
        let message = &fault.message;
        let said = if message.is_empty() { String::new() } else { format!(": {message}") };
        Some(format!("the program is {}{said}", end_text(&outcome.end)))
    }

    /// No law is judged, since the program is refused.
    fn diverges(self, refusal: String) -> Verdict {
        diverges(self.asserted(&self.case.assertions.join(", ")), refusal)
    }

    /// An assertion with its law.
    fn asserted(self, text: &str) -> String {
        if text == "holds" { format!("{} holds", self.rule.id) } else { text.to_owned() }
    }

    fn check_repeatable(
        self,
        first: &Samples,
        feed_interval: Option<u32>,
    ) -> Result<(), NotJudgedReason> {
        let second = samples_of(self.runner.controller, self.scenario, self.case, feed_interval);
        let why = match second {
            Ok(second) if second == *first => return Ok(()),
            Ok(second) if second.len() == first.len() => "other samples".to_owned(),
            Ok(second) => format!("first {} samples, then {}", first.len(), second.len()),
            Err(NoSamples::Unsupported(why)) => format!("then {why}"),
            Err(NoSamples::Failed(why)) => format!("then {why}"),
        };
        Err(NotJudgedReason::new(Cause::Nondeterministic, format!("run twice: {why}")))
    }
}

fn diverges(asserted: String, found: String) -> Verdict {
    let assertion = Some((asserted, found));
    Verdict::Diverges(RuleDivergence { assertion, ..RuleDivergence::default() })
}

fn verdict_without_samples(no_samples: NoSamples) -> Verdict {
    match no_samples {
        NoSamples::Unsupported(why) => Verdict::Unsupported(why),
        NoSamples::Failed(why) => Verdict::NotJudged(NotJudgedReason::from(&why)),
    }
}

fn not_run_error(why: String) -> NoSamples {
    NoSamples::Failed(HarnessError::NotRun(why))
}

fn samples_of(
    controller: &dyn Adapter,
    scenario: &Scenario,
    case: &MotionCase,
    feed_interval: Option<u32>,
) -> Result<Samples, NoSamples> {
    if case.is_recorded() {
        return gaugeblock_motion::synthesize(case).map_err(not_run_error);
    }
    let limits = case.limits().map_err(not_run_error)?;
    let script = case.script();
    controller.record_motion(&MotionRequest {
        scenario,
        limits: &limits,
        script: &script,
        feed_interval,
    })
}
