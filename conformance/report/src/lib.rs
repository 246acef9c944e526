//! What a run of the suite comes to: counts, a verdict per rule, an exit status.

pub mod baseline;
mod cards;
pub mod causes;
pub mod cost;
pub mod html;
mod inert;
pub mod json;
pub mod junit;
pub mod markdown;
pub mod matrix;
pub mod merge;
pub mod profiles;
mod sides;
pub mod stored;
pub mod terminal;

use std::collections::BTreeMap;

use gaugeblock_compare::Tally;
use gaugeblock_suite::Rule;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use inert::{inert, inert_line};
pub use merge::Header;
pub use profiles::ProfileResult;

use gaugeblock_runner::certify::{CaseResult, Cause, Run, Verdict};
use gaugeblock_runner::expectations::Trouble;

/// A verdict on a whole rule.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
pub enum RuleVerdict {
    /// Every case that was judged passes, or passes but for a quirk of other rules, and at least one was.
    #[serde(rename = "pass")]
    Pass,
    /// A case diverges, known or not.
    #[serde(rename = "diverges")]
    Diverges,
    /// No case could be run on this controller.
    #[serde(rename = "unsupported")]
    Unsupported,
    /// A case was not judged, or is inconclusive.
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Counts {
    /// All cases.
    pub cases: usize,
    /// Cases that pass.
    pub pass: usize,
    /// Cases that diverge, and nobody knows of it.
    pub diverges: usize,
    /// Cases that pass but for a quirk that is charged to other rules.
    pub charged_elsewhere: usize,
    /// Cases that diverge exactly as is known.
    pub known: usize,
    /// Cases that diverge, and somebody answers for it.
    pub waived: usize,
    /// Cases that the controller does not support.
    pub unsupported: usize,
    /// Cases that documents or model leave open.
    pub inconclusive: usize,
    /// Cases of which two runs differ.
    pub nondeterministic: usize,
    /// Cases that the controller died of.
    pub crash: usize,
    /// Cases that did not end in time.
    pub timeout: usize,
    /// Cases of which the controller could not be asked, or its answer not be read.
    pub harness_error: usize,
    /// Cases that nobody has run.
    pub not_run: usize,
}

impl Counts {
    fn add(&mut self, verdict: &Verdict) {
        self.cases += 1;
        let count = match verdict {
            Verdict::Pass => &mut self.pass,
            Verdict::Diverges(_) => &mut self.diverges,
            Verdict::ChargedElsewhere(_) => &mut self.charged_elsewhere,
            Verdict::Known(..) => &mut self.known,
            Verdict::Waived(..) => &mut self.waived,
            Verdict::Unsupported(_) => &mut self.unsupported,
            Verdict::Inconclusive(_) => &mut self.inconclusive,
            Verdict::NotJudged(unjudged) => match unjudged.cause {
                Cause::Nondeterministic => &mut self.nondeterministic,
                Cause::Crash => &mut self.crash,
                Cause::Timeout => &mut self.timeout,
                Cause::HarnessError => &mut self.harness_error,
                Cause::NotRun => &mut self.not_run,
            },
        };
        *count += 1;
    }

    /// Why cases that were to be judged are not, each with its word.
    pub fn unjudged(self) -> [(&'static str, usize); 6] {
        [
            ("inconclusive", self.inconclusive),
            ("nondeterministic", self.nondeterministic),
            ("crash", self.crash),
            ("timeout", self.timeout),
            ("harness error", self.harness_error),
            ("not run", self.not_run),
        ]
    }

    /// All cases.
    pub fn all(self) -> usize {
        self.cases
    }

    /// Cases that were to be judged and are not.
    pub fn not_judged(self) -> usize {
        self.unjudged().into_iter().map(|(_, count)| count).sum()
    }

    /// Cases of which something is known: they pass, or they depart, whoever knows of it.
    pub fn judged(self) -> usize {
        self.pass + self.charged_elsewhere + self.diverges + self.known + self.waived
    }

    fn verdict(self) -> RuleVerdict {
        if self.diverges + self.known + self.waived > 0 {
            RuleVerdict::Diverges
        } else if self.not_judged() > 0 {
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

    /// Cases that diverge, known or not, in order.
    pub fn divergences(&self) -> Vec<&CaseResult<'a>> {
        let diverges = |result: &&CaseResult<'a>| result.verdict.own_departure().is_some();
        self.run.cases.iter().filter(diverges).collect()
    }

    /// Cases that failed where other programs had run before, and not alone, with how they did: what those left there
    /// did it.
    pub fn leaks(&self) -> Vec<(&CaseResult<'a>, &str)> {
        let leaks = |case: &'_ CaseResult<'a>| case.before.is_some();
        let leaking = self.run.cases.iter().filter(|case| leaks(case));
        leaking.map(|case| (case, case.before.as_deref().unwrap_or_default())).collect()
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

    /// The exit status: 0 all that was judged is as documented or known, 1 a divergence, a wrong expectation or a
    /// claimed profile that it does not pass, 3 not finished, or nothing was judged at all.
    pub fn exit_status(&self) -> u8 {
        let counts = self.counts();
        let wrong = match &self.troubles {
            Some(troubles) => !troubles.is_empty(),
            None => counts.diverges + counts.charged_elsewhere > 0,
        };
        let fails = self.profiles.iter().any(|profile| profile.claimed && !profile.passes());
        if wrong || fails {
            1
        } else if counts.not_judged() > 0 || counts.judged() == 0 || !self.leaks().is_empty() {
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
