//! What comes of cases and of a run.
//!
//! **Invariant:** nothing but `Pass` and `AttributedElsewhere` says that a controller does what the documents say.

use std::collections::BTreeSet;
use std::fmt;
use std::time::Duration;

use gaugeblock_adapter::HarnessError;
use gaugeblock_compare::{StateDifference, Tally};
use gaugeblock_motion::Sketch;
use gaugeblock_suite::{Edition, Rule};
use gaugeblock_vocabulary::Outcome;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::fingerprint::FingerprintEntry;

/// What came of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Everything that could be compared is as the documents say.
    Pass,
    /// The controller does something else.
    Diverges(RuleDivergence),
    /// The case's own assertions hold, and the one difference is a quirk that this rule is not about: it is charged to
    /// the rules that name the quirk. Everything else is as the documents say.
    AttributedElsewhere(RuleDivergence),
    /// It does something else, exactly as is known of it. Who knows: the expectations, or an earlier report.
    Known(RuleDivergence, String),
    /// It does something else, and somebody answers for it until a day: who, until when and why.
    Waived(RuleDivergence, String),
    /// Not run: the controller declared not to have this, or not to show it.
    Unsupported(String),
    /// The documents or the model leave it open, and why. Never a pass.
    Inconclusive(String),
    /// There is no outcome to judge, or more than one. Never a pass.
    NotJudged(NotJudgedReason),
}

impl Verdict {
    /// In a word or two, as every report names it.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Diverges(_) => "diverges",
            Self::AttributedElsewhere(_) => "charged elsewhere",
            Self::Known(..) => "known",
            Self::Waived(..) => "waived",
            Self::Unsupported(_) => "unsupported",
            Self::Inconclusive(_) => "inconclusive",
            Self::NotJudged(unjudged) => unjudged.cause.word(),
        }
    }

    /// What the controller does otherwise, whoever knows of it.
    pub fn departure(&self) -> Option<&RuleDivergence> {
        match self {
            Self::Diverges(departure)
            | Self::AttributedElsewhere(departure)
            | Self::Known(departure, _)
            | Self::Waived(departure, _) => Some(departure),
            Self::Pass | Self::Unsupported(_) | Self::Inconclusive(_) | Self::NotJudged(_) => None,
        }
    }

    /// What the controller does otherwise in what the rule is about, whoever knows of it.
    pub fn own_departure(&self) -> Option<&RuleDivergence> {
        if matches!(self, Self::AttributedElsewhere(_)) { None } else { self.departure() }
    }

    /// Who knows of a departure, or answers for it.
    pub fn excuse(&self) -> Option<&str> {
        if let Self::Known(_, who) | Self::Waived(_, who) = self { Some(who) } else { None }
    }

    /// Why nothing can be said, where that is so.
    pub fn open(&self) -> Option<&str> {
        if matches!(self, Self::Unsupported(_)) { None } else { self.why() }
    }

    /// Why nothing was compared, where that is so.
    pub fn why(&self) -> Option<&str> {
        match self {
            Self::Unsupported(why)
            | Self::Inconclusive(why)
            | Self::NotJudged(NotJudgedReason { why, .. }) => Some(why),
            Self::Pass
            | Self::Diverges(_)
            | Self::AttributedElsewhere(_)
            | Self::Known(..)
            | Self::Waived(..) => None,
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.word())?;
        let said = self.departure().map(RuleDivergence::line);
        match self.why().map(str::to_owned).or(said) {
            Some(why) => write!(f, ": {why}"),
            None => Ok(()),
        }
    }
}

/// Why a case that was to be run has no verdict.
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

/// What keeps a case from being judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// Of two runs of the same case one did something else.
    Nondeterministic,
    /// The controller died of it, also when nothing else had run before.
    Crash,
    /// The controller did not end in time.
    Timeout,
    /// The controller could not be started or asked, or what it said is no answer.
    HarnessError,
    /// Nobody has run it.
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

/// What a controller does otherwise, in words that stay the same from run to run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RuleDivergence {
    /// The first assertion that does not hold, as it is written, with what was found.
    pub assertion: Option<(String, String)>,
    /// The first divergence from the model's outcome.
    pub divergence: Option<String>,
    /// The quirks and other options of choices that explain it, as few as possible; none where nothing does.
    pub explanation: Vec<String>,
    /// What happened, side by side; none for servo samples.
    pub traces: Option<Traces>,
    /// In what the state differs, where it does so first.
    pub state: Option<StateDifference>,
    /// The smallest program that departs in the same way, where it was looked for.
    pub shrunk: Option<String>,
}

/// What the documents say that happens, and what did, as texts. Long ones are cut.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Traces {
    /// By the documents.
    pub expected: String,
    /// On the controller.
    pub found: String,
}

impl Traces {
    /// Most bytes of one of them.
    const MOST: usize = 8 << 10;

    pub(super) fn of(expected: &Outcome, found: &Outcome) -> Self {
        let cut = |outcome: &Outcome| {
            let mut text = outcome.to_text();
            if let Some((end, _)) = text.char_indices().find(|(at, _)| *at >= Self::MOST) {
                text.truncate(end);
                text.push_str("…\n");
            }
            text
        };
        Self { expected: cut(expected), found: cut(found) }
    }
}

impl RuleDivergence {
    /// In one line, as expectations name it.
    pub fn line(&self) -> String {
        match (&self.assertion, &self.divergence) {
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
    /// What came of it.
    pub verdict: Verdict,
    /// Fields, effects and assertions that the controller does not show.
    pub masked: BTreeSet<String>,
    /// What was compared.
    pub compared: Tally,
    /// Whether it was run again on a new controller, since the used one departed from the documents. What the new one
    /// did is judged.
    pub repeated: bool,
    /// How it failed where other programs had run before. It is judged by what it did alone.
    pub before: Option<String>,
    /// A small picture of its samples, where there are any.
    pub sketch: Option<Sketch>,
    /// How long it took, with everything that was run for it. It is no part of what came of the case.
    pub cost: Duration,
}

/// The suite, run.
#[derive(Clone, Debug)]
pub struct Run<'a> {
    /// The edition that the controller was held to.
    pub edition: &'a Edition,
    /// Cases in the order of rules and pages.
    pub cases: Vec<CaseResult<'a>>,
    /// Rules that do not exist in the edition, and why.
    pub void: Vec<(&'a Rule, &'a str)>,
    /// What the controller shows of each choice and quirk, where it was asked for.
    pub fingerprint: Option<Vec<FingerprintEntry>>,
}

impl<'a> CaseResult<'a> {
    pub(super) fn begun(rule: &'a Rule, name: &'a str, program: &'a str) -> Self {
        Self {
            rule,
            name,
            program,
            verdict: Verdict::Pass,
            masked: BTreeSet::new(),
            compared: Tally::default(),
            repeated: false,
            before: None,
            sketch: None,
            cost: Duration::ZERO,
        }
    }
}
