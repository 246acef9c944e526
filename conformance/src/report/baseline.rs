//! A run against an earlier report: what is new, what has changed, and what is mended.

use std::collections::BTreeMap;

use super::merge::Stored;
use super::stored::StoredDeparture;
use crate::certify::{Run, Verdict};
use crate::expectations::Trouble;

impl Stored {
    /// Divergences that the earlier report does not have, or has otherwise; and a sentence for each that is mended.
    pub fn hold(&self, run: &Run<'_>) -> (Vec<Trouble>, Vec<String>) {
        let before: BTreeMap<(&str, &str), &StoredDeparture> = self
            .cases
            .iter()
            .filter_map(|case| {
                Some(((case.rule.as_str(), case.case.as_str()), case.verdict.departure()?))
            })
            .collect();
        let (mut troubles, mut mended) = (Vec::new(), Vec::new());
        for result in &run.cases {
            let (rule, case) = (result.rule.id.clone(), result.name.to_owned());
            let before = before.get(&(result.rule.id.as_str(), result.name));
            match (result.verdict.departure(), before) {
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
