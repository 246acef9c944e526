//! Results of checks.

use std::collections::BTreeSet;

use gaugeblock_adapter::exec::Exec;
use gaugeblock_adapter::{Adapter as _, HarnessError};
use gaugeblock_vocabulary::{Language, Outcome, Scenario};

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

/// Programs that change what a reset has to restore, from much to little.
const CHANGES: [&str; 3] = [
    "g20 g91 g18 f77 s500 m3 m8\n#31=5\n#<_kept>=6\ng92 x3\ng0 x1 y1 z1\nm2\n",
    "g20 g91 g18 f77\ng92 x3\ng1 x1 y1 z1\nm2\n",
    "g91 f77\ng1 x1 y1 z1\nm2\n",
];

/// A program that changes modes and parameters, in the language of the controller; a plain one if there is no other.
pub(super) fn changing(adapter: &Exec, plain: &Scenario) -> Scenario {
    if plain.program.language != Language::Rs274 {
        return plain.clone();
    }
    let scenarios = CHANGES.iter().map(|text| {
        let mut changes = plain.clone();
        changes.program.main = (*text).to_owned();
        changes
    });
    let mut supported = scenarios.filter(|scenario| adapter.supports(scenario).is_ok());
    supported.next().unwrap_or_else(|| plain.clone())
}

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
