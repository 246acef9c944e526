//! The verdict on a case, as a certificate has it.

use std::collections::BTreeSet;
use std::time::Duration;

use gaugeblock_compare::{ComparedKind, Tally};
use gaugeblock_runner::certify::{CaseResult, Cause, NotJudgedReason, RuleDivergence, Verdict};
use gaugeblock_suite::Rule;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A case and its verdict.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct CertifiedCase {
    /// Its name.
    pub case: String,
    /// The verdict.
    pub verdict: CaseVerdict,
    /// How the controller differs, accepted or not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub found: Option<CertifiedDivergence>,
    /// Why it was not judged; or what accepts that the controller differs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
    /// What accepts that it was not judged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accepted: Option<String>,
    /// How many of its assertions could not be judged.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub unjudged_assertions: usize,
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// The word of a verdict, as in every report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CaseVerdict {
    /// As the documents say.
    Pass,
    /// An assertion of the case does not hold.
    Diverges,
    /// Its assertions hold, and something else in the outcome differs.
    #[serde(rename = "side difference")]
    SideDifference,
    /// It differs as expectations or a baseline say.
    Known,
    /// It differs, and a waiver accepts that.
    Waived,
    /// The controller does not support it.
    Unsupported,
    /// The documents or the model leave it open.
    Inconclusive,
    /// Two runs differ.
    Nondeterministic,
    /// The controller crashed.
    Crash,
    /// The controller did not end in time.
    Timeout,
    /// The controller could not be queried, or its answer is not valid.
    #[serde(rename = "harness error")]
    HarnessError,
    /// It was not run.
    #[serde(rename = "not run")]
    NotRun,
}

/// How a controller differs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct CertifiedDivergence {
    /// In one line, as expectations name it.
    pub what: String,
    /// Whether an assertion of the case does not hold, so that the rule is broken.
    pub breaks_rule: bool,
}

impl CertifiedDivergence {
    fn of(divergence: &RuleDivergence) -> Self {
        Self { what: divergence.summary(), breaks_rule: divergence.assertion.is_some() }
    }

    fn divergence(&self) -> RuleDivergence {
        let what = self.what.clone();
        if self.breaks_rule {
            RuleDivergence { assertion: Some((what, String::new())), ..RuleDivergence::default() }
        } else {
            RuleDivergence { difference: Some(what), ..RuleDivergence::default() }
        }
    }
}

impl CertifiedCase {
    /// A case that was run.
    pub(crate) fn of(result: &CaseResult<'_>) -> Self {
        let verdict = &result.verdict;
        let why = verdict.reason().or(verdict.accepted_by());
        Self {
            case: result.name.to_owned(),
            verdict: CaseVerdict::of(verdict),
            found: verdict.divergence().map(CertifiedDivergence::of),
            why: why.map(str::to_owned),
            accepted: result.accepted.clone(),
            unjudged_assertions: result.compared.unjudged(),
        }
    }

    /// The result that it was made of, as far as counts and verdicts depend on it.
    pub(crate) fn result<'a>(
        &self,
        rule: &'a Rule,
        name: &'a str,
    ) -> Result<CaseResult<'a>, String> {
        let mut compared = Tally::default();
        compared.add(ComparedKind::UnjudgedAssertions, self.unjudged_assertions);
        Ok(CaseResult {
            rule,
            name,
            program: "",
            verdict: self.verdict()?,
            accepted: self.accepted.clone(),
            masked: BTreeSet::new(),
            compared,
            rerun: false,
            leaked_failure: None,
            sketch: None,
            cost: Duration::ZERO,
        })
    }

    fn verdict(&self) -> Result<Verdict, String> {
        let found = self.found.as_ref();
        let verdict = match (self.verdict, found, self.why.clone()) {
            (CaseVerdict::Pass, None, None) => Verdict::Pass,
            (CaseVerdict::Diverges, Some(found), None) if found.breaks_rule => {
                Verdict::Diverges(found.divergence())
            }
            (CaseVerdict::SideDifference, Some(found), None) if !found.breaks_rule => {
                Verdict::SideDifference(found.divergence())
            }
            (CaseVerdict::Known, Some(found), Some(why)) => Verdict::Known(found.divergence(), why),
            (CaseVerdict::Waived, Some(found), Some(why)) => {
                Verdict::Waived(found.divergence(), why)
            }
            (CaseVerdict::Unsupported, None, Some(why)) => Verdict::Unsupported(why),
            (CaseVerdict::Inconclusive, None, Some(why)) => Verdict::Inconclusive(why),
            (word, None, Some(why)) => {
                let cause = word.cause().ok_or("its verdict does not fit the reason")?;
                Verdict::NotJudged(NotJudgedReason { cause, why })
            }
            _ => return Err("its verdict does not fit what was found".to_owned()),
        };
        Ok(verdict)
    }

    /// What another run of the case must repeat: what differs, or else the word of the verdict. Lists that accept a
    /// divergence do not change it.
    pub(crate) fn repeatable(&self) -> String {
        match &self.found {
            Some(found) => format!("differs: {}", found.what),
            None => self.verdict.word().to_owned(),
        }
    }
}

impl CaseVerdict {
    fn of(verdict: &Verdict) -> Self {
        match verdict {
            Verdict::Pass => Self::Pass,
            Verdict::Diverges(_) => Self::Diverges,
            Verdict::SideDifference(_) => Self::SideDifference,
            Verdict::Known(..) => Self::Known,
            Verdict::Waived(..) => Self::Waived,
            Verdict::Unsupported(_) => Self::Unsupported,
            Verdict::Inconclusive(_) => Self::Inconclusive,
            Verdict::NotJudged(reason) => match reason.cause {
                Cause::Nondeterministic => Self::Nondeterministic,
                Cause::Crash => Self::Crash,
                Cause::Timeout => Self::Timeout,
                Cause::HarnessError => Self::HarnessError,
                Cause::NotRun => Self::NotRun,
            },
        }
    }

    fn cause(self) -> Option<Cause> {
        match self {
            Self::Nondeterministic => Some(Cause::Nondeterministic),
            Self::Crash => Some(Cause::Crash),
            Self::Timeout => Some(Cause::Timeout),
            Self::HarnessError => Some(Cause::HarnessError),
            Self::NotRun => Some(Cause::NotRun),
            Self::Pass
            | Self::Diverges
            | Self::SideDifference
            | Self::Known
            | Self::Waived
            | Self::Unsupported
            | Self::Inconclusive => None,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Diverges => "diverges",
            Self::SideDifference => "side difference",
            Self::Known => "known",
            Self::Waived => "waived",
            Self::Unsupported => "unsupported",
            Self::Inconclusive => "inconclusive",
            Self::Nondeterministic
            | Self::Crash
            | Self::Timeout
            | Self::HarnessError
            | Self::NotRun => self.cause().map_or("not judged", Cause::word),
        }
    }
}
