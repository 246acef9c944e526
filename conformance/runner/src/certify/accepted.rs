//! Divergences that expectations, a baseline or waivers accept.

use super::verdict::{Cause, Run, Verdict};
use crate::expectations::ExpectationMismatch;
use crate::waivers::Waived;

/// What accepts that a case could not be judged, by its rule, its name and the word of its verdict.
pub type AcceptsUnjudged<'c> = dyn Fn(&str, &str, &str) -> Option<String> + 'c;

/// Names what lists the divergence of a rule and case.
pub type ListName<'a> = &'a dyn Fn(&str, &str) -> String;

impl Run<'_> {
    /// Marks the cases that could not be judged where something accepts it. A case that was not run is never accepted.
    pub fn mark_unjudged(&mut self, accepts: &AcceptsUnjudged<'_>) {
        for result in &mut self.cases {
            let is_open = result.verdict.undetermined_reason().is_some();
            let word = result.verdict.word();
            if is_open && word != Cause::NotRun.word() {
                result.accepted = accepts(&result.rule.id, result.name, word);
            }
        }
    }

    /// Marks divergences as waived or known; those in `mismatches` are neither. `source` says what lists the one of a
    /// rule and case. A side difference is known where it is listed itself, or where a listed divergence has its cause.
    pub fn mark_accepted(
        &mut self,
        mismatches: &[ExpectationMismatch],
        waived: &[Waived],
        source: Option<ListName<'_>>,
    ) {
        for result in &mut self.cases {
            let (Verdict::Diverges(divergence) | Verdict::SideDifference(divergence)) =
                &result.verdict
            else {
                continue;
            };
            let place = (result.rule.id.as_str(), result.name);
            let waiver = waived.iter().find(|waived| waived.place() == place);
            if let Some(waiver) = waiver {
                result.verdict = Verdict::Waived(divergence.clone(), waiver.why.clone());
            } else if let Some(source) = source
                && !mismatches.iter().any(|mismatch| mismatch.place() == place)
            {
                result.verdict = Verdict::Known(divergence.clone(), source(place.0, place.1));
            }
        }
    }
}
