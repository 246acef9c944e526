//! The results of a run of the suite: counts, a verdict per rule, an exit status.

mod abridge;
pub mod baseline;
mod cards;
pub mod comparison;
mod consistency;
pub mod cost;
mod escape;
pub mod grouping;
pub mod html;
pub mod json;
pub mod junit;
pub mod markdown;
pub mod matrix;
pub mod merge;
pub mod profiles;
mod rule;
mod side_by_side;
pub mod stored;
pub mod terminal;

use std::cell::OnceCell;
use std::collections::BTreeMap;

pub use escape::{escape_line, escape_text};
pub use merge::{ControllerFile, Header};
pub use profiles::ProfileResult;
pub use rule::{ChapterCounts, Counts, RuleResult, RuleVerdict};
pub(crate) use rule::{Totals, verdicts};

use gaugeblock_runner::certify::{CaseResult, RuleDivergence, Run, Verdict};
use gaugeblock_runner::expectations::ExpectationMismatch;
use gaugeblock_runner::findings::{Finding, findings};
use gaugeblock_runner::measure::Measurement;
use gaugeblock_suite::{Rule, Suite, sections};

/// A run with its mismatches.
#[derive(Clone, Debug)]
pub struct Report<'a> {
    /// The suite.
    pub suite: &'a Suite,
    /// The run.
    pub run: &'a Run<'a>,
    /// What it is of.
    pub header: Header,
    /// What a person should know of how it was run.
    pub notes: Vec<String>,
    /// Each profile that the edition has rules of.
    pub profiles: Vec<ProfileResult<'a>>,
    /// Where it disagrees with the expectations, if there are any.
    pub mismatches: Option<Vec<ExpectationMismatch>>,
    /// Its limits, where they were measured.
    pub measurements: Vec<Measurement>,
    /// What the controller does otherwise, by cause, once it has been asked for.
    pub findings: OnceCell<Vec<Finding<'a, 'a>>>,
}

impl<'a> Report<'a> {
    /// Where the documents of the edition state a rule: sections, with the sentences in them.
    pub(crate) fn sections(&self, rule: &Rule) -> Vec<String> {
        sections(&self.run.edition.cited(&rule.sources))
    }

    /// The report of a run without notes and profiles, compared with no list.
    pub fn of(suite: &'a Suite, run: &'a Run<'a>, header: Header) -> Self {
        Self {
            suite,
            run,
            header,
            notes: Vec::new(),
            profiles: Vec::new(),
            mismatches: None,
            measurements: Vec::new(),
            findings: OnceCell::new(),
        }
    }

    /// The edition, with the scope of the verdicts unless it is the full one.
    pub fn edition_and_scope(&self) -> String {
        let edition = &self.run.edition.id;
        let scope = self.header.scope.note();
        scope.map_or_else(|| edition.clone(), |scope| format!("{edition}, {scope}"))
    }

    /// Counts over all cases.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        for result in &self.run.cases {
            counts.add(result);
        }
        counts
    }

    /// Each rule with its verdict, in order.
    pub fn rules(&self) -> Vec<RuleResult<'a>> {
        verdicts(self.run)
    }

    /// The number of rules by chapter and verdict.
    pub fn chapters(&self) -> Vec<ChapterCounts<'a>> {
        rule::chapters(&self.rules())
    }

    /// What the controller does otherwise, a finding for each cause, the worst first.
    pub fn findings(&self) -> &[Finding<'a, 'a>] {
        self.findings.get_or_init(|| {
            let controller = &self.header.controller;
            let is_explained = |divergence: &RuleDivergence| {
                grouping::explain(controller, divergence)
                    .is_some_and(|explanation| explanation.applies_to_controller)
            };
            findings(self.suite, self.run, &is_explained, &grouping::difference_in_words)
        })
    }

    /// Cases of which an assertion does not hold, known or not, in order.
    pub fn divergences(&self) -> Vec<&CaseResult<'a>> {
        let diverges = |result: &&CaseResult<'a>| result.verdict.own_divergence().is_some();
        self.run.cases.iter().filter(diverges).collect()
    }

    /// Cases that failed where other programs had run before, and not alone, with how they did: what those left there
    /// did it.
    pub fn leaks(&self) -> Vec<(&CaseResult<'a>, &str)> {
        let leaks = |case: &'_ CaseResult<'a>| case.leaked_failure.is_some();
        let leaking = self.run.cases.iter().filter(|case| leaks(case));
        leaking.map(|case| (case, case.leaked_failure.as_deref().unwrap_or_default())).collect()
    }

    /// Fields and effects that were not observable, with the number of cases.
    pub fn masked(&self) -> BTreeMap<&str, usize> {
        let mut masked = BTreeMap::new();
        for field in self.run.cases.iter().flat_map(|result| &result.masked) {
            *masked.entry(field.as_str()).or_default() += 1;
        }
        masked
    }

    /// Reasons why cases are not supported, with the number of cases.
    pub fn unsupported(&self) -> BTreeMap<&str, usize> {
        let mut reasons = BTreeMap::new();
        for result in &self.run.cases {
            if let Verdict::Unsupported(reason) = &result.verdict {
                *reasons.entry(reason.as_str()).or_default() += 1;
            }
        }
        reasons
    }

    /// The exit status: 0 all that was judged is as documented or known, and the rest is accepted; 1 a divergence, a
    /// wrong expectation or a claimed profile that it does not pass; 3 not finished, or nothing was judged at all.
    pub fn exit_status(&self) -> u8 {
        Totals {
            counts: self.counts(),
            mismatches: self.mismatches.as_ref().map(Vec::len),
            fails_profile: self.profiles.iter().any(|profile| profile.claimed && !profile.passes()),
            leaks: !self.leaks().is_empty(),
        }
        .exit_status()
    }
}
