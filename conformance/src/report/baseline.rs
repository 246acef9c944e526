//! A run against an earlier report: what is new, what has changed, and what is mended.

use std::collections::BTreeMap;

use super::merge::Stored;
use super::stored::{StoredCase, StoredDeparture, StoredVerdict};
use crate::certify::{CaseResult, Departure, Run, Verdict};
use crate::expectations::Trouble;

impl Stored {
    /// Divergences that the earlier report does not have, or has otherwise; and a sentence for each that is mended.
    pub fn hold(&self, run: &Run<'_>) -> (Vec<Trouble>, Vec<String>) {
        let before: BTreeMap<(&str, &str), &StoredDeparture> = self
            .cases
            .iter()
            .filter_map(|case| Some(((case.rule.as_str(), case.case.as_str()), departed(case)?)))
            .collect();
        let (mut troubles, mut mended) = (Vec::new(), Vec::new());
        for result in &run.cases {
            let (rule, case) = (result.rule.id.clone(), result.name.to_owned());
            let before = before.get(&(result.rule.id.as_str(), result.name));
            match (departs(result), before) {
                (None, None) => {}
                (Some(departure), None) => {
                    troubles.push(Trouble::New { rule, case, found: departure.line() });
                }
                (Some(departure), Some(before)) if departure.line() == before.found => {}
                (Some(departure), Some(before)) => {
                    let (listed, found) = (before.found.clone(), departure.line());
                    troubles.push(Trouble::Changed { rule, case, listed, found });
                }
                (None, Some(before)) if result.verdict == Verdict::Pass => {
                    mended.push(format!("mended: {rule} / {case}: was {}", before.found));
                }
                // It is not judged any more, which is told by itself.
                (None, Some(_)) => {}
            }
        }
        (troubles, mended)
    }
}

fn departs<'a>(result: &'a CaseResult<'_>) -> Option<&'a Departure> {
    match &result.verdict {
        Verdict::Diverges(departure) | Verdict::ChargedElsewhere(departure) => Some(departure),
        Verdict::Pass
        | Verdict::Unsupported(_)
        | Verdict::Inconclusive(_)
        | Verdict::NotJudged(_) => None,
    }
}

fn departed(case: &StoredCase) -> Option<&StoredDeparture> {
    match &case.verdict {
        StoredVerdict::Diverges(departure) | StoredVerdict::ChargedElsewhere(departure) => {
            Some(departure)
        }
        StoredVerdict::Pass
        | StoredVerdict::Unsupported(_)
        | StoredVerdict::Inconclusive(_)
        | StoredVerdict::NotJudged(_) => None,
    }
}
