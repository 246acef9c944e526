//! A report as a comparison reads it: its verdicts, and why a case does not pass.

use std::collections::BTreeMap;

use gaugeblock_runner::measure::Measurement;
use gaugeblock_runner::waivers::Day;
use serde::Deserialize;

use super::document::{Cell, CellVerdict, RuleCounts};
use crate::abridge::abridged;
use crate::grouping::without_guard;
use crate::json::{JudgedProfile, VoidRule};
use crate::{Header, RuleVerdict, merge};

/// Longest reason, in characters.
const WHY: usize = 200;

/// A report of an earlier run.
#[derive(Clone, Debug)]
pub struct ComparedReport {
    /// The file.
    pub file: String,
    /// The name of its column.
    pub name: String,
    /// The day of the run.
    pub date: Day,
    /// Address of the report for people, relative to the comparison.
    pub link: Option<String>,
    /// What it is of.
    pub header: Header,
    /// What the run ended with.
    pub(super) exit_status: u8,
    /// The profiles.
    pub(super) profiles: Vec<JudgedProfile>,
    /// Sentence, profile and cell of each rule that was run.
    pub(super) rules: BTreeMap<String, ReadRule>,
    /// Rules that the edition does not have.
    pub(super) void: Vec<String>,
    /// The controller's limits, where they were measured.
    pub(super) measurements: Vec<Measurement>,
}

/// A rule of a report.
#[derive(Clone, Debug)]
pub(super) struct ReadRule {
    pub(super) sentence: String,
    pub(super) profile: String,
    pub(super) cell: Cell,
}

#[derive(Deserialize)]
struct Form {
    #[serde(flatten)]
    header: Header,
    exit_status: u8,
    profiles: Vec<JudgedProfile>,
    rules: Vec<FormRule>,
    void: Vec<VoidRule>,
    #[serde(default)]
    measurements: Vec<Measurement>,
    cases: Vec<FormCase>,
}

#[derive(Deserialize)]
struct FormRule {
    rule: String,
    sentence: String,
    profile: String,
    verdict: RuleVerdict,
    cases: usize,
}

#[derive(Deserialize)]
struct FormCase {
    rule: String,
    case: String,
    verdict: String,
    #[serde(default)]
    why: Option<FormWhy>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct FormWhy {
    reason: Option<String>,
    found: Option<String>,
    assertion: Option<(String, String)>,
}

impl ComparedReport {
    /// Reads a report in JSON, of a file and a day. Its column has this name, or that of the controller.
    ///
    /// # Errors
    /// It is not a report of this version; the message follows the name of the file.
    pub fn read(text: &str, file: &str, name: Option<&str>, date: Day) -> Result<Self, String> {
        let form: Form = merge::read(text)?;
        let mut cases: BTreeMap<&str, Vec<&FormCase>> = BTreeMap::new();
        for case in &form.cases {
            cases.entry(&case.rule).or_default().push(case);
        }
        let rules = form.rules.into_iter().map(|rule| {
            let cell = cell(&rule, cases.get(rule.rule.as_str()).map_or(&[], Vec::as_slice));
            (rule.rule, ReadRule { sentence: rule.sentence, profile: rule.profile, cell })
        });
        Ok(Self {
            file: file.to_owned(),
            name: name.unwrap_or(&form.header.controller).to_owned(),
            date,
            link: None,
            exit_status: form.exit_status,
            profiles: form.profiles,
            rules: rules.collect(),
            measurements: form.measurements,
            void: form.void.into_iter().map(|void| void.rule).collect(),
            header: form.header,
        })
    }

    /// What a rule is in this report.
    pub(super) fn verdict(&self, rule: &str) -> CellVerdict {
        match self.rules.get(rule) {
            Some(read) => read.cell.verdict,
            None if self.void.iter().any(|void| void == rule) => CellVerdict::Void,
            None => CellVerdict::NotRun,
        }
    }

    /// How many of its rules have each verdict.
    pub(super) fn counts(&self) -> RuleCounts {
        let mut counts = RuleCounts { void: self.void.len(), ..RuleCounts::default() };
        for rule in self.rules.values() {
            counts.add(rule.cell.verdict);
        }
        counts
    }
}

impl From<RuleVerdict> for CellVerdict {
    fn from(verdict: RuleVerdict) -> Self {
        match verdict {
            RuleVerdict::Pass => Self::Pass,
            RuleVerdict::Diverges => Self::Diverges,
            RuleVerdict::Unsupported => Self::Unsupported,
            RuleVerdict::NotJudged => Self::NotJudged,
        }
    }
}

fn cell(rule: &FormRule, cases: &[&FormCase]) -> Cell {
    let passes = |case: &FormCase| matches!(case.verdict.as_str(), "pass" | "side difference");
    let diverges =
        |case: &FormCase| matches!(case.verdict.as_str(), "diverges" | "known" | "waived");
    let verdict = CellVerdict::from(rule.verdict);
    // A case that was not run says less than one that diverges.
    let open = cases
        .iter()
        .filter(|case| !passes(case))
        .min_by_key(|case| (!diverges(case), case.verdict == "unsupported"));
    Cell {
        verdict,
        pass: cases.iter().filter(|case| passes(case)).count(),
        diverges: cases.iter().filter(|case| diverges(case)).count(),
        cases: rule.cases,
        why: open.filter(|_| verdict != CellVerdict::Pass).map(|case| why(case)),
    }
}

/// The case, and what was found or why it was not judged, in a line.
fn why(case: &FormCase) -> String {
    let why = case.why.as_ref();
    let words = match why.map(|why| (&why.assertion, &why.found, &why.reason)) {
        Some((Some((expected, found)), _, _)) => {
            let (expected, found) = abridged(without_guard(expected), found);
            format!("expected {expected}, found {found}")
        }
        Some((None, Some(found), _)) => found.clone(),
        Some((None, None, Some(reason))) => reason.clone(),
        Some((None, None, None)) | None => case.verdict.clone(),
    };
    let line = format!("{}: {words}", case.case).replace('\n', " ");
    if line.chars().count() <= WHY {
        return line;
    }
    line.chars().take(WHY).collect::<String>() + "…"
}
