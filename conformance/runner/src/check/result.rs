//! Results of checks.

use std::collections::BTreeSet;

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::Outcome;

/// The result of a check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CheckResult {
    /// As required.
    Passed(String),
    /// Not as required: fix the adapter before its verdicts mean anything.
    Failed(String),
    /// It could not be checked, and why.
    Skipped(String),
}

/// A check and its result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Check {
    /// What is checked.
    pub name: &'static str,
    /// Its result.
    pub result: CheckResult,
}

/// A program that changes what a reset has to restore.
pub(super) const CHANGES: &str =
    "g20 g91 g18 f77 s500 m3 m8\n#31=5\n#<_kept>=6\ng92 x3\ng0 x1 y1 z1\nm2\n";

pub(super) fn compare_outcomes(
    first: &Outcome,
    again: &Result<Outcome, HarnessError>,
    otherwise: &str,
) -> CheckResult {
    match again {
        Ok(again) if again == first => CheckResult::Passed("the same outcome".to_owned()),
        Ok(again) => CheckResult::Failed(format!("{otherwise}: {}", difference(first, again))),
        Err(error) => CheckResult::Failed(error.to_string()),
    }
}

/// The first line in which the texts of two outcomes differ.
fn difference(a: &Outcome, b: &Outcome) -> String {
    let (a, b) = (a.to_text(), b.to_text());
    let (first, second): (BTreeSet<_>, BTreeSet<_>) = (a.lines().collect(), b.lines().collect());
    let gone = a.lines().find(|line| !second.contains(line)).unwrap_or("nothing").trim();
    let new = b.lines().find(|line| !first.contains(line)).unwrap_or("nothing").trim();
    format!("{gone:?} before, {new:?} now")
}
