//! Cases of motion: samples held to laws.

use gaugeblock_adapter::{Adapter, HarnessError, MotionRequest, NoSamples};
use gaugeblock_compare::Basis;
use gaugeblock_motion::Sketch;
use gaugeblock_suite::{MotionCase, Rule};
use gaugeblock_vocabulary::Scenario;
use gaugeblock_vocabulary::motion::{ProgrammedPath, Samples};

use super::CaseRunner;
use super::verdict::{CaseResult, Cause, NotJudgedReason, RuleDivergence, Verdict};

impl CaseRunner<'_> {
    /// A case of motion: its own samples, or what the controller makes of its program at each feed of segments.
    pub(super) fn run_motion<'r>(self, rule: &'r Rule, case: &'r MotionCase) -> CaseResult<'r> {
        let mut result = CaseResult::begun(rule, &case.name, &case.program);
        let environment = self.plan.edition.environment.as_ref();
        match gaugeblock_motion::asked(case, self.options, environment) {
            Ok((scenario, path)) => {
                let moved = Moved { held: self, rule, case, scenario: &scenario, path: &path };
                result.verdict = moved.verdict(&mut result);
            }
            Err(why) => result.verdict = Verdict::Inconclusive(why),
        }
        result
    }
}

/// A case of motion with what it asks for.
#[derive(Clone, Copy)]
struct Moved<'a> {
    held: CaseRunner<'a>,
    rule: &'a Rule,
    case: &'a MotionCase,
    scenario: &'a Scenario,
    path: &'a ProgrammedPath,
}

impl Moved<'_> {
    fn verdict(self, result: &mut CaseResult<'_>) -> Verdict {
        let Self { held, rule, case, scenario, path } = self;
        let readings = held.plan.suite.motion_options(held.plan.edition);
        let feeds: &[Option<u32>] =
            if case.is_recorded() { &[None] } else { &gaugeblock_motion::FEEDS };
        let mut twice = !case.is_recorded() && held.twice.chooses(&rule.id, &case.name);
        for every in feeds {
            let samples = match samples_of(held.controller, scenario, case, *every) {
                Ok(samples) => samples,
                Err(not_moved) => return why_not(not_moved),
            };
            if std::mem::take(&mut twice)
                && let Err(unjudged) = self.same_again(&samples, *every)
            {
                return Verdict::NotJudged(unjudged);
            }
            let judged = gaugeblock_motion::held(case, &rule.id, &readings, (&samples, path));
            if judged.is_err() || result.sketch.is_none() {
                result.sketch = Some(Sketch::of(&samples, path));
            }
            match judged {
                Ok(()) => result.compared.add(Basis::Laws, case.says.len()),
                Err((saying, found)) => {
                    let fed =
                        every.map_or(String::new(), |n| format!("with a segment in {n} cycles: "));
                    let assertion = Some((saying, format!("{fed}{found}")));
                    return Verdict::Diverges(RuleDivergence {
                        assertion,
                        ..RuleDivergence::default()
                    });
                }
            }
        }
        Verdict::Pass
    }

    fn same_again(self, first: &Samples, every: Option<u32>) -> Result<(), NotJudgedReason> {
        let second = samples_of(self.held.controller, self.scenario, self.case, every);
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

fn why_not(not_moved: NoSamples) -> Verdict {
    match not_moved {
        NoSamples::Unsupported(why) => Verdict::Unsupported(why),
        NoSamples::Failed(why) => Verdict::NotJudged(NotJudgedReason::from(&why)),
    }
}

fn not_run(why: String) -> NoSamples {
    NoSamples::Failed(HarnessError::NotRun(why))
}

fn samples_of(
    controller: &dyn Adapter,
    scenario: &Scenario,
    case: &MotionCase,
    every: Option<u32>,
) -> Result<Samples, NoSamples> {
    if case.is_recorded() {
        return gaugeblock_motion::made(case).map_err(not_run);
    }
    let limits = case.limits().map_err(not_run)?;
    let script = case.script();
    controller.record_motion(&MotionRequest {
        scenario,
        limits: &limits,
        script: &script,
        feed_interval: every,
    })
}
