//! Compares a run with an earlier report.

use std::collections::BTreeMap;

use gaugeblock_runner::certify::{BASELINE, Run, Verdict};
use gaugeblock_runner::expectations::ExpectationMismatch;

use super::Header;
use super::merge::Stored;
use super::stored::StoredVerdict;

impl Stored {
    /// Checks that the report is of the same controller, edition and scope. Returns a note for another version, and for
    /// another accuracy.
    ///
    /// # Errors
    /// It is of another controller, edition or scope, with both.
    pub fn check_header(&self, now: &Header) -> Result<Vec<String>, String> {
        let Header { controller, version, edition, scope, accuracy, .. } = &self.header;
        if (controller, edition) != (&now.controller, &now.edition) {
            return Err(format!(
                "this baseline is of {controller} against {edition}, not of {} against {}",
                now.controller, now.edition
            ));
        }
        if *scope != now.scope {
            return Err(format!(
                "the scope of this baseline is {:?}, that of this run is {:?}",
                scope.words(),
                now.scope.words()
            ));
        }
        let mut notes = Vec::new();
        if *version != now.version {
            notes.push(format!(
                "the baseline is of version {version}, this is version {}",
                now.version
            ));
        }
        if *accuracy != now.accuracy {
            let now = now.accuracy;
            notes.push(format!(
                "the declared accuracy of the baseline is {accuracy}, this one is {now}"
            ));
        }
        Ok(notes)
    }

    /// What accepts that a case could not be judged, by the word of its verdict: it could not before.
    pub fn accepts_unjudged(&self, rule: &str, case: &str, word: &str) -> Option<String> {
        let before =
            self.cases.iter().find(|it| (it.rule.as_str(), it.case.as_str()) == (rule, case));
        let before = before?.verdict.not_judged()?;
        (before == word).then(|| BASELINE.to_owned())
    }

    /// New and changed divergences, and cases that passed before and have no verdict now; and a note for each
    /// divergence that is fixed, or that has no verdict now.
    pub fn compare(&self, run: &Run<'_>) -> (Vec<ExpectationMismatch>, Vec<String>) {
        let before: BTreeMap<(&str, &str), &StoredVerdict> = self
            .cases
            .iter()
            .map(|case| ((case.rule.as_str(), case.case.as_str()), &case.verdict))
            .collect();
        let (mut mismatches, mut told) = (Vec::new(), Vec::new());
        for result in &run.cases {
            let (rule, case) = (result.rule.id.clone(), result.name.to_owned());
            let before = before.get(&(result.rule.id.as_str(), result.name));
            let known = before.and_then(|before| before.divergence());
            match (result.verdict.divergence(), known) {
                (Some(divergence), None) => {
                    mismatches.push(ExpectationMismatch::New {
                        rule,
                        case,
                        found: divergence.summary(),
                    });
                }
                (Some(divergence), Some(before)) if divergence.summary() == before.found => {}
                (Some(divergence), Some(before)) => {
                    let (listed, found) = (before.found.clone(), divergence.summary());
                    mismatches.push(ExpectationMismatch::Changed { rule, case, listed, found });
                }
                (None, before) if result.verdict == Verdict::Pass => told.extend(
                    before.map(|before| format!("fixed: {rule} / {case}: was {}", before.found)),
                ),
                (None, _) if before.is_some_and(|before| before.is_pass()) => {
                    let (listed, found) = ("pass".to_owned(), result.verdict.to_string());
                    mismatches.push(ExpectationMismatch::Changed { rule, case, listed, found });
                }
                (None, before) => told.extend(before.map(|before| {
                    format!("not judged any more: {rule} / {case}: was {}", before.found)
                })),
            }
        }
        (mismatches, told)
    }
}
