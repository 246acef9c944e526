//! What a run of the suite comes to: counts, a verdict per rule, an exit status.

pub mod baseline;
pub mod html;
pub mod json;
pub mod junit;
pub mod markdown;
pub mod matrix;
pub mod merge;
pub mod profiles;
pub mod stored;
pub mod terminal;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

pub use merge::Header;
pub use profiles::ProfileResult;

use crate::certify::{CaseResult, Run, Verdict};
use crate::compare::Tally;
use crate::expectations::Trouble;
use crate::suite::Rule;

/// A verdict on a whole rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum RuleVerdict {
    /// Every case that was judged passes, or passes but for a quirk of other rules, and at least one was.
    #[serde(rename = "pass")]
    Pass,
    /// A case diverges.
    #[serde(rename = "diverges")]
    Diverges,
    /// No case could be run on this controller.
    #[serde(rename = "unsupported")]
    Unsupported,
    /// A case was not judged, or inconclusive.
    #[serde(rename = "not judged")]
    NotJudged,
}

impl RuleVerdict {
    /// In a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Diverges => "diverges",
            Self::Unsupported => "unsupported",
            Self::NotJudged => "not judged",
        }
    }
}

/// A run with what it is held against.
#[derive(Clone, Debug)]
pub struct Report<'a> {
    /// The run.
    pub run: &'a Run<'a>,
    /// What it is of.
    pub header: Header,
    /// What a person should know of how it was run.
    pub notes: Vec<String>,
    /// Each profile that the edition has rules of.
    pub profiles: Vec<ProfileResult<'a>>,
    /// Where it disagrees with the expectations, if there are any.
    pub troubles: Option<Vec<Trouble>>,
}

/// What came of a rule.
#[derive(Clone, Debug)]
pub struct RuleResult<'a> {
    /// The rule.
    pub rule: &'a Rule,
    /// The verdict.
    pub verdict: RuleVerdict,
    /// Its cases.
    pub counts: Counts,
    /// What the verdict rests on.
    pub compared: Tally,
}

/// How many cases came to what.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Cases that pass.
    pub pass: usize,
    /// Cases that diverge.
    pub diverges: usize,
    /// Cases that pass but for a quirk that is charged to other rules.
    pub charged_elsewhere: usize,
    /// Cases that the controller does not support.
    pub unsupported: usize,
    /// Cases that were not judged or are inconclusive.
    pub not_judged: usize,
}

impl Counts {
    fn add(&mut self, verdict: &Verdict) {
        match verdict {
            Verdict::Pass => self.pass += 1,
            Verdict::Diverges(_) => self.diverges += 1,
            Verdict::ChargedElsewhere(_) => self.charged_elsewhere += 1,
            Verdict::Unsupported(_) => self.unsupported += 1,
            Verdict::Inconclusive(_) | Verdict::NotJudged(_) => self.not_judged += 1,
        }
    }

    /// All cases.
    pub fn all(self) -> usize {
        self.pass + self.diverges + self.charged_elsewhere + self.unsupported + self.not_judged
    }

    fn verdict(self) -> RuleVerdict {
        if self.diverges > 0 {
            RuleVerdict::Diverges
        } else if self.not_judged > 0 {
            RuleVerdict::NotJudged
        } else if self.pass + self.charged_elsewhere > 0 {
            RuleVerdict::Pass
        } else {
            RuleVerdict::Unsupported
        }
    }
}

impl<'a> Report<'a> {
    /// Counts over all cases.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        for result in &self.run.cases {
            counts.add(&result.verdict);
        }
        counts
    }

    /// Each rule with its verdict, in order.
    pub fn rules(&self) -> Vec<RuleResult<'a>> {
        verdicts(self.run)
    }

    /// Cases that diverge, in order.
    pub fn divergences(&self) -> Vec<&CaseResult<'a>> {
        let diverges = |result: &&CaseResult<'a>| matches!(result.verdict, Verdict::Diverges(_));
        self.run.cases.iter().filter(diverges).collect()
    }

    /// Fields and effects that were not shown, with the number of cases.
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

    /// The exit status: 0 all as documented or known, 1 a divergence, a wrong expectation or a claimed profile that
    /// it does not pass, 3 not finished.
    pub fn exit_status(&self) -> u8 {
        let counts = self.counts();
        let wrong = match &self.troubles {
            Some(troubles) => !troubles.is_empty(),
            None => counts.diverges + counts.charged_elsewhere > 0,
        };
        let fails = self.profiles.iter().any(|profile| profile.claimed && !profile.passes());
        if wrong || fails {
            1
        } else if counts.not_judged > 0 || counts.all() == 0 {
            3
        } else {
            0
        }
    }
}

/// Each rule of a run with its verdict, in order.
fn verdicts<'a>(run: &Run<'a>) -> Vec<RuleResult<'a>> {
    let mut rules: Vec<RuleResult<'a>> = Vec::new();
    for result in &run.cases {
        if rules.last().is_none_or(|last| last.rule.id != result.rule.id) {
            rules.push(RuleResult {
                rule: result.rule,
                verdict: RuleVerdict::Unsupported,
                counts: Counts::default(),
                compared: Tally::default(),
            });
        }
        if let Some(last) = rules.last_mut() {
            last.counts.add(&result.verdict);
            last.compared.extend(&result.compared);
            last.verdict = last.counts.verdict();
        }
    }
    rules
}
