//! What comes of cases and of a run.

use std::collections::BTreeSet;

use gaugeblock_trace::Outcome;
use serde::{Deserialize, Serialize};

use crate::compare::Tally;
use crate::suite::{Edition, Rule};

/// What came of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Everything that could be compared is as the documents say.
    Pass,
    /// The controller does something else.
    Diverges(Departure),
    /// The case's own assertions hold, and the one difference is a quirk that this rule is not about: it is charged to
    /// the rules that name the quirk. Everything else is as the documents say.
    ChargedElsewhere(Departure),
    /// Not run: the controller declared not to have this, or not to show it.
    Unsupported(String),
    /// Nothing can be said, and why. Never a pass.
    Inconclusive(String),
    /// The controller crashed, hung or was not understood. Never a pass.
    NotJudged(String),
}

/// What a controller does otherwise, in words that stay the same from run to run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Departure {
    /// The first assertion that does not hold, as it is written, with what was found.
    pub assertion: Option<(String, String)>,
    /// The first divergence from the model's outcome.
    pub divergence: Option<String>,
    /// The quirks and other options of choices that explain it, as few as possible; none where nothing does.
    pub explanation: Vec<String>,
    /// What happened, side by side; none for servo samples.
    pub traces: Option<Traces>,
}

/// What the documents say that happens, and what did, as texts. Long ones are cut.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
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

impl Departure {
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
    /// Whether it was run again on a new controller, since the used one departed from the documents. What the new one did
    /// is judged.
    pub repeated: bool,
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
        }
    }
}
