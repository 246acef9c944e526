//! A run against an earlier report: what is new, what has changed, and what is mended.

use std::collections::{BTreeMap, BTreeSet};

use super::merge::Stored;
use super::stored::{StoredDeparture, StoredVerdict};
use crate::certify::{Run, Verdict};
use crate::expectations::Trouble;

impl Stored {
    /// Divergences that the earlier report does not have, or has otherwise; and a sentence for each that is mended, or that is not judged any more, and
    /// one for the passes that are not.
    pub fn hold(&self, run: &Run<'_>) -> (Vec<Trouble>, Vec<String>) {
        let before: BTreeMap<(&str, &str), &StoredDeparture> = self
            .cases
            .iter()
            .filter_map(|case| {
                Some(((case.rule.as_str(), case.case.as_str()), case.verdict.departure()?))
            })
            .collect();
        let passed: BTreeSet<(&str, &str)> = self
            .cases
            .iter()
            .filter(|case| matches!(case.verdict, StoredVerdict::Pass))
            .map(|case| (case.rule.as_str(), case.case.as_str()))
            .collect();
        let (mut troubles, mut told, mut lost) = (Vec::new(), Vec::new(), Vec::new());
        for result in &run.cases {
            let (rule, case) = (result.rule.id.clone(), result.name.to_owned());
            let before = before.get(&(result.rule.id.as_str(), result.name));
            match (result.verdict.departure(), before) {
                (None, None) => {
                    let is_lost = result.verdict != Verdict::Pass
                        && passed.contains(&(result.rule.id.as_str(), result.name));
                    lost.extend(is_lost.then(|| format!("{rule} / {case}")));
                }
                (Some(departure), None) => {
                    troubles.push(Trouble::New { rule, case, found: departure.line() });
                }
                (Some(departure), Some(before)) if departure.line() == before.found => {}
                (Some(departure), Some(before)) => {
                    let (listed, found) = (before.found.clone(), departure.line());
                    troubles.push(Trouble::Changed { rule, case, listed, found });
                }
                (None, Some(before)) if result.verdict == Verdict::Pass => {
                    told.push(format!("mended: {rule} / {case}: was {}", before.found));
                }
                (None, Some(before)) => {
                    let found = &before.found;
                    told.push(format!("not judged any more: {rule} / {case}: was {found}"));
                }
            }
        }
        if let Some(first) = lost.first() {
            let count = lost.len();
            told.push(format!("not judged any more: {count} that passed, the first {first}"));
        }
        (troubles, told)
    }
}
