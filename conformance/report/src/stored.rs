//! What came of a case, as it stands in a report and in a journal: written, and read again.

use std::collections::BTreeSet;
use std::time::Duration;

use gaugeblock_compare::{StateDifference, Tally};
use gaugeblock_motion::Sketch;
use gaugeblock_runner::certify::{
    CaseResult, Cause, NotJudgedReason, RuleDivergence, Traces, Verdict,
};
use gaugeblock_suite::Suite;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A case and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StoredCase {
    /// Id of the rule.
    pub rule: String,
    /// Name of its case.
    pub case: String,
    /// The verdict.
    #[serde(flatten)]
    pub verdict: StoredVerdict,
    /// What was compared.
    pub compared: Tally,
    /// What the controller does not show.
    pub masked: BTreeSet<String>,
    /// Whether it was judged on a new controller, since the used one departed.
    pub repeated: bool,
    /// How it failed where other programs had run before. It was judged alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub before: Option<String>,
    /// What accepts that it could not be judged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accepted: Option<String>,
    /// A small picture of its samples.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sketch: Option<Sketch>,
}

/// A case as it stands in a journal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JournalCase {
    /// The case.
    #[serde(flatten)]
    pub case: StoredCase,
    /// How long it took, milliseconds.
    pub cost: f64,
}

/// A verdict, with why it is no pass.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "verdict", content = "why", rename_all = "lowercase")]
pub enum StoredVerdict {
    /// As the documents say.
    Pass,
    /// An assertion of the case does not hold.
    Diverges(StoredDivergence),
    /// The assertions of the case hold, and something else in the outcome differs.
    #[serde(rename = "side difference")]
    SideDifference(StoredDivergence),
    /// Otherwise, exactly as is known.
    Known(AcceptedDivergence),
    /// It diverges, and a list accepts it.
    Waived(AcceptedDivergence),
    /// Not run: the controller does not have this.
    Unsupported(Reason),
    /// The documents or the model leave it open.
    Inconclusive(Reason),
    /// Of two runs one did something else.
    Nondeterministic(Reason),
    /// The controller died of it.
    Crash(Reason),
    /// The controller did not end in time.
    Timeout(Reason),
    /// The controller could not be asked, or its answer not be read.
    #[serde(rename = "harness error")]
    HarnessError(Reason),
    /// Nobody has run it.
    #[serde(rename = "not run")]
    NotRun(Reason),
}

/// Why there is no verdict.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Reason {
    /// In a sentence.
    pub reason: String,
}

/// What a controller does otherwise, and why that does not fail.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct AcceptedDivergence {
    /// Who knows of it, or answers for it.
    pub reason: String,
    /// What it does.
    #[serde(flatten)]
    pub divergence: StoredDivergence,
}

/// What a controller does otherwise.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct StoredDivergence {
    /// In one line, as expectations name it.
    pub found: String,
    /// The first assertion that does not hold, with what was found.
    pub assertion: Option<(String, String)>,
    /// The first difference from the model.
    #[serde(rename = "divergence")]
    pub difference: Option<String>,
    /// The quirks and options that explain it.
    pub explanation: Vec<String>,
    /// The main program.
    pub program: String,
    /// What happened, side by side.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub traces: Option<Traces>,
    /// In what the state differs, where it does so first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<StateDifference>,
    /// The smallest program that departs in the same way, where it was looked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shrunk: Option<String>,
}

impl StoredVerdict {
    fn of(result: &CaseResult<'_>) -> Self {
        let divergence = |divergence: &RuleDivergence| StoredDivergence {
            found: divergence.summary(),
            assertion: divergence.assertion.clone(),
            difference: divergence.difference.clone(),
            explanation: divergence.explanation.clone(),
            program: result.program.to_owned(),
            traces: divergence.traces.clone(),
            state: divergence.state.clone(),
            shrunk: divergence.shrunk.clone(),
        };
        let excused = |known: &RuleDivergence, reason: &String| AcceptedDivergence {
            reason: reason.clone(),
            divergence: divergence(known),
        };
        let reason = |why: &String| Reason { reason: why.clone() };
        match &result.verdict {
            Verdict::Pass => Self::Pass,
            Verdict::Diverges(found) => Self::Diverges(divergence(found)),
            Verdict::SideDifference(found) => Self::SideDifference(divergence(found)),
            Verdict::Known(found, why) => Self::Known(excused(found, why)),
            Verdict::Waived(found, why) => Self::Waived(excused(found, why)),
            Verdict::Unsupported(why) => Self::Unsupported(reason(why)),
            Verdict::Inconclusive(why) => Self::Inconclusive(reason(why)),
            Verdict::NotJudged(NotJudgedReason { cause, why }) => match cause {
                Cause::Nondeterministic => Self::Nondeterministic(reason(why)),
                Cause::Crash => Self::Crash(reason(why)),
                Cause::Timeout => Self::Timeout(reason(why)),
                Cause::HarnessError => Self::HarnessError(reason(why)),
                Cause::NotRun => Self::NotRun(reason(why)),
            },
        }
    }

    /// Whether it says that the controller does what the documents say.
    pub fn is_pass(&self) -> bool {
        matches!(self, Self::Pass | Self::SideDifference(_))
    }

    /// Why the case was not judged, in a word: that of its verdict.
    pub fn not_judged(&self) -> Option<&'static str> {
        match self.verdict() {
            Verdict::NotJudged(reason) => Some(reason.cause.word()),
            verdict @ Verdict::Inconclusive(_) => Some(verdict.word()),
            Verdict::Pass
            | Verdict::Diverges(_)
            | Verdict::SideDifference(_)
            | Verdict::Known(..)
            | Verdict::Waived(..)
            | Verdict::Unsupported(_) => None,
        }
    }

    /// How the controller differs, accepted or not.
    pub fn divergence(&self) -> Option<&StoredDivergence> {
        match self {
            Self::Diverges(divergence) | Self::SideDifference(divergence) => Some(divergence),
            Self::Known(excused) | Self::Waived(excused) => Some(&excused.divergence),
            Self::Pass
            | Self::Unsupported(_)
            | Self::Inconclusive(_)
            | Self::Nondeterministic(_)
            | Self::Crash(_)
            | Self::Timeout(_)
            | Self::HarnessError(_)
            | Self::NotRun(_) => None,
        }
    }

    /// The verdict as it was reported, with the list that accepts it.
    pub(crate) fn reported(&self) -> Verdict {
        match (self, self.verdict()) {
            (Self::Known(known), Verdict::Diverges(found) | Verdict::SideDifference(found)) => {
                Verdict::Known(found, known.reason.clone())
            }
            (Self::Waived(waived), Verdict::Diverges(found) | Verdict::SideDifference(found)) => {
                Verdict::Waived(found, waived.reason.clone())
            }
            (_, verdict) => verdict,
        }
    }

    /// The verdict of the run alone: what it was held against then is not held against it now.
    fn verdict(&self) -> Verdict {
        let divergence = |stored: &StoredDivergence| RuleDivergence {
            assertion: stored.assertion.clone(),
            difference: stored.difference.clone(),
            explanation: stored.explanation.clone(),
            traces: stored.traces.clone(),
            state: stored.state.clone(),
            shrunk: stored.shrunk.clone(),
        };
        let not_judged = |cause, why: &Reason| {
            Verdict::NotJudged(NotJudgedReason { cause, why: why.reason.clone() })
        };
        match self {
            Self::Pass => Verdict::Pass,
            Self::Diverges(found)
            | Self::SideDifference(found)
            | Self::Known(AcceptedDivergence { divergence: found, .. })
            | Self::Waived(AcceptedDivergence { divergence: found, .. }) => {
                Verdict::of_divergence(divergence(found))
            }
            Self::Unsupported(why) => Verdict::Unsupported(why.reason.clone()),
            Self::Inconclusive(why) => Verdict::Inconclusive(why.reason.clone()),
            Self::Nondeterministic(why) => not_judged(Cause::Nondeterministic, why),
            Self::Crash(why) => not_judged(Cause::Crash, why),
            Self::Timeout(why) => not_judged(Cause::Timeout, why),
            Self::HarnessError(why) => not_judged(Cause::HarnessError, why),
            Self::NotRun(why) => not_judged(Cause::NotRun, why),
        }
    }
}

impl StoredCase {
    /// A case that was run.
    pub fn of(result: &CaseResult<'_>) -> Self {
        Self {
            rule: result.rule.id.clone(),
            case: result.name.to_owned(),
            verdict: StoredVerdict::of(result),
            compared: result.compared.clone(),
            masked: result.masked.clone(),
            repeated: result.rerun,
            before: result.leaked_failure.clone(),
            accepted: result.accepted.clone(),
            sketch: result.sketch.clone(),
        }
    }

    /// The case of a suite, with what came of it.
    ///
    /// # Errors
    /// The suite has no such case.
    pub fn result<'a>(&self, suite: &'a Suite) -> Result<CaseResult<'a>, String> {
        let rules = suite.rules.binary_search_by(|rule| rule.id.as_str().cmp(&self.rule));
        let rule = rules.ok().and_then(|place| suite.rules.get(place));
        let found = rule.and_then(|rule| {
            let runs = rule.cases.iter().map(|case| (&case.name, &case.program));
            let motion = rule.motion.iter().map(|case| (&case.name, &case.program));
            let (name, program) = runs.chain(motion).find(|(name, _)| **name == self.case)?;
            Some((rule, name, program))
        });
        let (rule, name, program) =
            found.ok_or_else(|| format!("the suite has no case {} / {}", self.rule, self.case))?;
        Ok(CaseResult {
            rule,
            name,
            program,
            verdict: self.verdict.verdict(),
            accepted: None,
            masked: self.masked.clone(),
            compared: self.compared.clone(),
            rerun: self.repeated,
            leaked_failure: self.before.clone(),
            sketch: self.sketch.clone(),
            cost: Duration::ZERO,
        })
    }
}

impl JournalCase {
    /// A case that was run.
    pub fn of(result: &CaseResult<'_>) -> Self {
        Self { case: StoredCase::of(result), cost: result.cost.as_secs_f64() * 1e3 }
    }

    /// The case of a suite, with what came of it and what it cost.
    ///
    /// # Errors
    /// The suite has no such case.
    pub fn result<'a>(&self, suite: &'a Suite) -> Result<CaseResult<'a>, String> {
        let cost = Duration::try_from_secs_f64(self.cost / 1e3).unwrap_or_default();
        Ok(CaseResult { cost, ..self.case.result(suite)? })
    }
}
