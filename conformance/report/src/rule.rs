//! The verdict of each rule, and how many cases came to what.

use gaugeblock_compare::Tally;
use gaugeblock_runner::certify::{CaseResult, Cause, Run, Verdict};
use gaugeblock_suite::Rule;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A verdict on a whole rule.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
pub enum RuleVerdict {
    /// The assertions of every case that was judged hold, and at least one was judged.
    #[serde(rename = "pass")]
    Pass,
    /// An assertion of a case does not hold, known or not.
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

/// The rules of a chapter, by verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChapterCounts<'a> {
    /// The chapter.
    pub chapter: &'a str,
    /// All of its rules.
    pub rules: usize,
    /// Rules that pass.
    pub pass: usize,
    /// Rules that are broken.
    pub diverges: usize,
    /// Rules without a supported case.
    pub unsupported: usize,
    /// Rules that could not be judged.
    pub not_judged: usize,
}

impl<'a> ChapterCounts<'a> {
    fn of(chapter: &'a str) -> Self {
        Self { chapter, rules: 0, pass: 0, diverges: 0, unsupported: 0, not_judged: 0 }
    }

    fn add(&mut self, verdict: RuleVerdict) {
        self.rules += 1;
        let count = match verdict {
            RuleVerdict::Pass => &mut self.pass,
            RuleVerdict::Diverges => &mut self.diverges,
            RuleVerdict::Unsupported => &mut self.unsupported,
            RuleVerdict::NotJudged => &mut self.not_judged,
        };
        *count += 1;
    }
}

/// The chapters of rules, in their order.
pub(super) fn chapters<'a>(rules: &[RuleResult<'a>]) -> Vec<ChapterCounts<'a>> {
    let mut chapters: Vec<ChapterCounts<'a>> = Vec::new();
    for RuleResult { rule, verdict, .. } in rules {
        let chapter = rule.chapter();
        if chapters.last().is_none_or(|last| last.chapter != chapter) {
            chapters.push(ChapterCounts::of(chapter));
        }
        if let Some(last) = chapters.last_mut() {
            last.add(*verdict);
        }
    }
    chapters
}

/// How many cases came to what.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Counts {
    /// All cases.
    pub cases: usize,
    /// Cases that pass.
    pub pass: usize,
    /// Cases that pass although an assertion of theirs could not be judged.
    pub pass_in_part: usize,
    /// Cases of which an assertion does not hold, and no list accepts that.
    pub diverges: usize,
    /// Cases of which every assertion holds, and that differ in something else.
    pub side_difference: usize,
    /// Cases of which an assertion does not hold, accepted or not: they break their rule.
    pub broken: usize,
    /// Cases that diverge exactly as is known.
    pub known: usize,
    /// Cases that diverge, and a list accepts it.
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
    /// Cases that were not run.
    pub not_run: usize,
    /// Cases without an assertion, or not judged as expectations, a baseline or a waiver accept.
    pub not_judged_accepted: usize,
}

impl Counts {
    pub(crate) fn add(&mut self, result: &CaseResult<'_>) {
        self.add_verdict(&result.verdict, result.accepted.is_some(), &result.compared);
    }

    /// Adds a case by its verdict, whether a list accepts that it is not judged, and what was compared.
    pub(crate) fn add_verdict(&mut self, verdict: &Verdict, accepted: bool, compared: &Tally) {
        self.cases += 1;
        self.broken += usize::from(verdict.own_divergence().is_some());
        let is_open = verdict.undetermined_reason().is_some();
        let is_accepted = accepted || verdict.is_without_assertion();
        self.not_judged_accepted += usize::from(is_open && is_accepted);
        if *verdict == Verdict::Pass && compared.unjudged() > 0 {
            self.pass_in_part += 1;
        }
        let count = match verdict {
            Verdict::Pass => &mut self.pass,
            Verdict::Diverges(_) => &mut self.diverges,
            Verdict::SideDifference(_) => &mut self.side_difference,
            Verdict::Known(..) => &mut self.known,
            Verdict::Waived(..) => &mut self.waived,
            Verdict::Unsupported(_) => &mut self.unsupported,
            Verdict::Inconclusive(_) => &mut self.inconclusive,
            Verdict::NotJudged(not_judged) => match not_judged.cause {
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
    pub fn not_judged_by_verdict(self) -> [(&'static str, usize); 6] {
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
        self.not_judged_by_verdict().into_iter().map(|(_, count)| count).sum()
    }

    /// Cases that were to be judged and are not, and nothing accepts that.
    pub fn open(self) -> usize {
        self.not_judged() - self.not_judged_accepted
    }

    /// Judged cases: those that pass and those that differ, accepted or not.
    pub fn judged(self) -> usize {
        self.pass + self.side_difference + self.diverges + self.known + self.waived
    }

    /// The passing cases with an assertion that could not be judged, and their share; nothing if there are none.
    pub fn in_part(self) -> Option<String> {
        let share = (1000 * self.pass_in_part / self.pass.max(1)).max(1);
        (self.pass_in_part > 0).then(|| {
            format!(
                "{} of them ({}.{} %) with an assertion that could not be judged",
                self.pass_in_part,
                share / 10,
                share % 10
            )
        })
    }

    fn verdict(self) -> RuleVerdict {
        if self.broken > 0 {
            RuleVerdict::Diverges
        } else if self.not_judged() > 0 {
            RuleVerdict::NotJudged
        } else if self.judged() > 0 {
            RuleVerdict::Pass
        } else {
            RuleVerdict::Unsupported
        }
    }
}

/// What an exit status follows from.
pub(crate) struct Totals {
    pub(crate) counts: Counts,
    /// How often the run disagrees with its expectations, if there are any.
    pub(crate) mismatches: Option<usize>,
    /// Whether a claimed profile is not passed.
    pub(crate) fails_profile: bool,
    /// Whether a case failed only where other programs had run before.
    pub(crate) leaks: bool,
}

impl Totals {
    pub(crate) fn exit_status(&self) -> u8 {
        let counts = self.counts;
        let wrong = match self.mismatches {
            Some(mismatches) => mismatches > 0,
            None => counts.diverges + counts.side_difference > 0,
        };
        if wrong || self.fails_profile {
            1
        } else if counts.open() > 0 || counts.judged() == 0 || self.leaks {
            3
        } else {
            0
        }
    }
}

/// Each rule of a run with its verdict, in order.
pub(crate) fn verdicts<'a>(run: &Run<'a>) -> Vec<RuleResult<'a>> {
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
            last.counts.add(result);
            last.compared.extend(&result.compared);
            last.verdict = last.counts.verdict();
        }
    }
    rules
}
