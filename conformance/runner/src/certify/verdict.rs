//! Verdicts on cases, and the results of a run.
//!
//! **Invariant:** the assertions of a case decide about its rule. Only `Pass` and `SideDifference` say that they hold,
//! and only `Pass` says that everything else is as the documents say, too.

use std::collections::BTreeSet;
use std::fmt;
use std::time::Duration;

use gaugeblock_adapter::HarnessError;
use gaugeblock_compare::{StateDifference, Tally};
use gaugeblock_motion::Sketch;
use gaugeblock_suite::{Case, Edition, Rule};
use gaugeblock_vocabulary::Outcome;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::plan::Scope;
use crate::fingerprint::FingerprintEntry;

/// The verdict on a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Everything that could be compared is as the documents say.
    Pass,
    /// An assertion of the case does not hold: the controller breaks its rule.
    Diverges(RuleDivergence),
    /// The assertions of the case hold, so that its rule is kept; something else in the outcome differs. The difference
    /// is a finding of its own, attributed to its cause over all cases.
    SideDifference(RuleDivergence),
    /// It does something else, as listed in the expectations or in an earlier report; the text names which.
    Known(RuleDivergence, String),
    /// It does something else, and a waiver covers it: owner, last day and reason.
    Waived(RuleDivergence, String),
    /// Not run: the controller declares that it does not support this, or cannot observe it.
    Unsupported(String),
    /// The documents or the model leave it open, and why. Never a pass.
    Inconclusive(String),
    /// There is no outcome to judge, or more than one. Never a pass.
    NotJudged(NotJudgedReason),
}

impl Verdict {
    /// The verdict on a divergence: only a failed assertion breaks the rule of the case.
    pub fn of_divergence(divergence: RuleDivergence) -> Self {
        match divergence.assertion {
            Some(_) => Self::Diverges(divergence),
            None => Self::SideDifference(divergence),
        }
    }

    /// Verdict of a case without an assertion that applies under the options, where only assertions are judged.
    pub(super) fn without_assertion() -> Self {
        Self::Inconclusive(WITHOUT_ASSERTION.to_owned())
    }

    /// Whether there was nothing to judge: no assertion is made under the options. The controller cannot change that.
    pub fn is_without_assertion(&self) -> bool {
        self.reason() == Some(WITHOUT_ASSERTION)
    }

    /// Whether the controller crashed or did not end in time.
    pub fn is_without_outcome(&self) -> bool {
        matches!(
            self,
            Self::NotJudged(NotJudgedReason { cause: Cause::Crash | Cause::Timeout, .. })
        )
    }

    /// The verdict in a word or two, as in every report.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Diverges(_) => "diverges",
            Self::SideDifference(_) => "side difference",
            Self::Known(..) => "known",
            Self::Waived(..) => "waived",
            Self::Unsupported(_) => "unsupported",
            Self::Inconclusive(_) => "inconclusive",
            Self::NotJudged(not_judged) => not_judged.cause.word(),
        }
    }

    /// The divergence, accepted or not.
    pub fn divergence(&self) -> Option<&RuleDivergence> {
        match self {
            Self::Diverges(divergence)
            | Self::SideDifference(divergence)
            | Self::Known(divergence, _)
            | Self::Waived(divergence, _) => Some(divergence),
            Self::Pass | Self::Unsupported(_) | Self::Inconclusive(_) | Self::NotJudged(_) => None,
        }
    }

    /// The divergence from the rule of the case, accepted or not: one of its assertions does not hold.
    pub fn own_divergence(&self) -> Option<&RuleDivergence> {
        self.divergence().filter(|divergence| divergence.assertion.is_some())
    }

    /// What accepts the divergence: expectations, baseline or waiver.
    pub fn accepted_by(&self) -> Option<&str> {
        if let Self::Known(_, who) | Self::Waived(_, who) = self { Some(who) } else { None }
    }

    /// Why the case was left open or not judged.
    pub fn undetermined_reason(&self) -> Option<&str> {
        if matches!(self, Self::Unsupported(_)) { None } else { self.reason() }
    }

    /// Why nothing was compared.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Unsupported(why)
            | Self::Inconclusive(why)
            | Self::NotJudged(NotJudgedReason { why, .. }) => Some(why),
            Self::Pass
            | Self::Diverges(_)
            | Self::SideDifference(_)
            | Self::Known(..)
            | Self::Waived(..) => None,
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.word())?;
        let said = self.divergence().map(RuleDivergence::summary);
        match self.reason().map(str::to_owned).or(said) {
            Some(why) => write!(f, ": {why}"),
            None => Ok(()),
        }
    }
}

/// Reason for a case without an assertion that applies, where only assertions are judged.
const WITHOUT_ASSERTION: &str = "none of its assertions is made under these options";
/// Marks a divergence that the expectations list.
pub const EXPECTATIONS: &str = "listed in the expectations";
/// Marks a divergence that the baseline has.
pub const BASELINE: &str = "as in the baseline";

/// Why a selected case has no verdict.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotJudgedReason {
    /// In a word.
    pub cause: Cause,
    /// In a sentence.
    pub why: String,
}

impl NotJudgedReason {
    pub(super) fn new(cause: Cause, why: impl Into<String>) -> Self {
        Self { cause, why: why.into() }
    }
}

impl From<&HarnessError> for NotJudgedReason {
    fn from(error: &HarnessError) -> Self {
        let cause = match error {
            HarnessError::Crashed { .. } => Cause::Crash,
            HarnessError::TimedOut { .. } => Cause::Timeout,
            HarnessError::Absent(_) => Cause::NotRun,
            HarnessError::NotRun(_)
            | HarnessError::Flooded { .. }
            | HarnessError::Unreadable { .. }
            | HarnessError::UnknownMessage(_)
            | HarnessError::ObservationDisturbs { .. } => Cause::HarnessError,
        };
        Self::new(cause, error.to_string())
    }
}

/// What prevents a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// Two runs of the same case differ.
    Nondeterministic,
    /// The controller crashed, also in a fresh session.
    Crash,
    /// The controller did not end in time.
    Timeout,
    /// The controller could not be started or queried, or its answer is not valid.
    HarnessError,
    /// It has not been run.
    NotRun,
}

impl Cause {
    /// In a word or two.
    pub fn word(self) -> &'static str {
        match self {
            Self::Nondeterministic => "nondeterministic",
            Self::Crash => "crash",
            Self::Timeout => "timeout",
            Self::HarnessError => "harness error",
            Self::NotRun => "not run",
        }
    }
}

/// How a controller differs, in words that stay the same from run to run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RuleDivergence {
    /// The first assertion that does not hold, as it is written, with what was found.
    pub assertion: Option<(String, String)>,
    /// The first difference from the model's outcome.
    pub difference: Option<String>,
    /// The quirks and other options of choices that explain it, as few as possible. One that breaks the assertion by
    /// itself is the first.
    pub explanation: Vec<String>,
    /// Both outcomes as texts; none for servo samples.
    pub traces: Option<Traces>,
    /// The first difference in the state.
    pub state: Option<StateDifference>,
    /// The minimised program, if minimising was requested and successful.
    pub shrunk: Option<String>,
}

/// The expected and the found outcome as texts. Long ones are cut.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Traces {
    /// By the documents.
    pub expected: String,
    /// On the controller.
    pub found: String,
}

impl Traces {
    /// Longest text, in bytes.
    const TRACE_BYTES_MAX: usize = 8 << 10;

    pub(super) fn of(expected: &Outcome, found: &Outcome) -> Self {
        let cut = |outcome: &Outcome| {
            let mut text = outcome.to_text();
            if let Some((end, _)) = text.char_indices().find(|(at, _)| *at >= Self::TRACE_BYTES_MAX)
            {
                text.truncate(end);
                text.push_str("…\n");
            }
            text
        };
        Self { expected: cut(expected), found: cut(found) }
    }
}

impl RuleDivergence {
    /// The smallest program that diverges so.
    pub fn program<'r>(&'r self, result: &'r CaseResult<'_>) -> &'r str {
        self.shrunk.as_deref().unwrap_or(result.program)
    }

    /// In one line, as expectations name it.
    pub fn summary(&self) -> String {
        match (&self.assertion, &self.difference) {
            (Some((assertion, found)), _) => format!("{assertion} | found {found}"),
            (None, Some(divergence)) => divergence.clone(),
            (None, None) => String::new(),
        }
    }
}

/// A case, run.
#[derive(Clone, Debug)]
pub struct CaseResult<'a> {
    /// The rule.
    pub rule: &'a Rule,
    /// The name of its case.
    pub name: &'a str,
    /// The main program of the case.
    pub program: &'a str,
    /// The verdict.
    pub verdict: Verdict,
    /// What accepts that the case could not be judged: expectations, a baseline or a waiver.
    pub accepted: Option<String>,
    /// Fields, effects and assertions that are not observable on the controller.
    pub masked: BTreeSet<String>,
    /// What was compared.
    pub compared: Tally,
    /// Whether it was run again on a fresh controller, because the used one diverged. The fresh outcome is judged.
    pub rerun: bool,
    /// The failure in a session in which other programs had run. The outcome in a fresh session is judged.
    pub leaked_failure: Option<String>,
    /// A small picture of its samples, where there are any.
    pub sketch: Option<Sketch>,
    /// How long it took, with every run for it. Not part of the result.
    pub cost: Duration,
}

/// The suite, run.
#[derive(Clone, Debug)]
pub struct Run<'a> {
    /// The edition that the controller was compared with.
    pub edition: &'a Edition,
    /// What the verdicts look at.
    pub scope: Scope,
    /// Cases in the order of rules and pages.
    pub cases: Vec<CaseResult<'a>>,
    /// Rules that do not exist in the edition, and why.
    pub not_applicable: Vec<(&'a Rule, &'a str)>,
    /// The observed option of each choice and quirk, if requested.
    pub fingerprint: Option<Vec<FingerprintEntry>>,
}

impl<'a> CaseResult<'a> {
    /// The case; none if it is one of motion.
    pub(crate) fn case(&self) -> Option<&'a Case> {
        self.rule.cases.iter().find(|case| case.name == self.name)
    }

    pub(super) fn new(rule: &'a Rule, name: &'a str, program: &'a str) -> Self {
        Self {
            rule,
            name,
            program,
            verdict: Verdict::Pass,
            accepted: None,
            masked: BTreeSet::new(),
            compared: Tally::default(),
            rerun: false,
            leaked_failure: None,
            sketch: None,
            cost: Duration::ZERO,
        }
    }
}
