//! What came of a case, as it stands in a report and in a journal: written, and read again.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use crate::certify::{CaseResult, Departure, Traces, Verdict};
use crate::compare::Tally;
use crate::suite::Suite;

/// A case and what came of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
}

/// A verdict, with why it is no pass.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "verdict", content = "why", rename_all = "lowercase")]
pub enum StoredVerdict {
    /// As the documents say.
    Pass,
    /// Otherwise.
    Diverges(StoredDeparture),
    /// Otherwise, by a quirk that other rules are about.
    #[serde(rename = "charged elsewhere")]
    ChargedElsewhere(StoredDeparture),
    /// Not run: the controller does not have this.
    Unsupported(Reason),
    /// Nothing can be said.
    Inconclusive(Reason),
    /// The controller crashed, hung or was not understood.
    #[serde(rename = "not judged")]
    NotJudged(Reason),
}

/// Why there is no verdict.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Reason {
    /// In a sentence.
    pub reason: String,
}

/// What a controller does otherwise.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct StoredDeparture {
    /// In one line, as expectations name it.
    pub found: String,
    /// The first assertion that does not hold, with what was found.
    pub assertion: Option<(String, String)>,
    /// The first difference from the model.
    pub divergence: Option<String>,
    /// The quirks and options that explain it.
    pub explanation: Vec<String>,
    /// The main program.
    pub program: String,
    /// What happened, side by side.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub traces: Option<Traces>,
}

impl StoredCase {
    /// A case that was run.
    pub fn of(result: &CaseResult<'_>) -> Self {
        let departure = |departure: &Departure| StoredDeparture {
            found: departure.line(),
            assertion: departure.assertion.clone(),
            divergence: departure.divergence.clone(),
            explanation: departure.explanation.clone(),
            program: result.program.to_owned(),
            traces: departure.traces.clone(),
        };
        let reason = |why: &String| Reason { reason: why.clone() };
        Self {
            rule: result.rule.id.clone(),
            case: result.name.to_owned(),
            verdict: match &result.verdict {
                Verdict::Pass => StoredVerdict::Pass,
                Verdict::Diverges(found) => StoredVerdict::Diverges(departure(found)),
                Verdict::ChargedElsewhere(found) => {
                    StoredVerdict::ChargedElsewhere(departure(found))
                }
                Verdict::Unsupported(why) => StoredVerdict::Unsupported(reason(why)),
                Verdict::Inconclusive(why) => StoredVerdict::Inconclusive(reason(why)),
                Verdict::NotJudged(why) => StoredVerdict::NotJudged(reason(why)),
            },
            compared: result.compared.clone(),
            masked: result.masked.clone(),
            repeated: result.repeated,
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
        let departure = |stored: &StoredDeparture| Departure {
            assertion: stored.assertion.clone(),
            divergence: stored.divergence.clone(),
            explanation: stored.explanation.clone(),
            traces: stored.traces.clone(),
        };
        Ok(CaseResult {
            rule,
            name,
            program,
            verdict: match &self.verdict {
                StoredVerdict::Pass => Verdict::Pass,
                StoredVerdict::Diverges(found) => Verdict::Diverges(departure(found)),
                StoredVerdict::ChargedElsewhere(found) => {
                    Verdict::ChargedElsewhere(departure(found))
                }
                StoredVerdict::Unsupported(why) => Verdict::Unsupported(why.reason.clone()),
                StoredVerdict::Inconclusive(why) => Verdict::Inconclusive(why.reason.clone()),
                StoredVerdict::NotJudged(why) => Verdict::NotJudged(why.reason.clone()),
            },
            masked: self.masked.clone(),
            compared: self.compared.clone(),
            repeated: self.repeated,
        })
    }
}
