//! Cases of motion: the laws of motion judge servo samples.

use gaugeblock_adapter::{Adapter, HarnessError, MotionRequest, NoSamples};
use gaugeblock_compare::ComparedKind;
use gaugeblock_motion::Sketch;
use gaugeblock_suite::{MotionCase, Rule};
use gaugeblock_vocabulary::Scenario;
use gaugeblock_vocabulary::motion::{ProgrammedPath, Samples};

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
                Err(no_samples) => return verdict_without_samples(no_samples),
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
                    let fed = feed_interval
                        .map_or(String::new(), |n| format!("with a segment in {n} cycles: "));
                    let assertion = Some((text, format!("{fed}{found}")));
                    return Verdict::Diverges(RuleDivergence {
                        assertion,
                        ..RuleDivergence::default()
                    });
                }
            }
        }
        Verdict::Pass
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
