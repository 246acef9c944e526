//! The form of a comparison.

use schemars::JsonSchema;
use serde::Serialize;

use crate::json::MissingRule;

/// Controllers side by side.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Comparison {
    /// `comparison`.
    pub gaugeblock: &'static str,
    /// Version of this form.
    pub schema: u32,
    /// What a reader should know before comparing numbers.
    pub notes: Vec<String>,
    /// The controllers. Every list below has a member for each of them, in this order.
    pub controllers: Vec<Column>,
    /// Per chapter, how many rules pass.
    pub chapters: Vec<ChapterRow>,
    /// Per profile, how far each controller is from it.
    pub profiles: Vec<ProfileRow>,
    /// The limits of the controllers that were measured.
    pub limits: Vec<LimitRow>,
    /// Each rule that exists for one of the controllers.
    pub rules: Vec<RuleRow>,
    /// How many rules are void in the editions of all controllers: these are left out.
    pub void_for_all: usize,
    /// What only one controller does.
    pub alone: Vec<Alone>,
    /// Each controller and edition with several reports.
    pub trends: Vec<Trend>,
}

/// A controller under an edition.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Column {
    /// The name by which it was listed, or that of the controller.
    pub name: String,
    /// The controller.
    pub controller: String,
    /// Its version.
    pub version: String,
    /// The edition that it was compared against.
    pub edition: String,
    /// The day of the report.
    pub date: String,
    /// Address of its own report, relative to the comparison.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub report: Option<String>,
    /// Digest of the suite.
    pub suite: String,
    /// Version of gaugeblock.
    pub gaugeblock_version: String,
    /// What the run ended with.
    pub exit_status: u8,
    /// How many rules have each verdict.
    pub counts: RuleCounts,
}

/// How many rules have each verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
#[expect(missing_docs, reason = "the words of the verdicts")]
pub struct RuleCounts {
    pub rules: usize,
    pub pass: usize,
    pub diverges: usize,
    pub unsupported: usize,
    pub not_judged: usize,
    pub void: usize,
    pub not_run: usize,
}

/// What a rule is for a controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CellVerdict {
    /// The assertions of every case that was judged hold.
    Pass,
    /// An assertion of a case does not hold.
    Diverges,
    /// A case was not judged.
    #[serde(rename = "not judged")]
    NotJudged,
    /// No case could be run on this controller.
    Unsupported,
    /// The edition does not have the rule.
    Void,
    /// The report does not have the rule.
    #[serde(rename = "not run")]
    NotRun,
}

impl CellVerdict {
    /// All, the worst first.
    pub(super) const ALL: [Self; 6] =
        [Self::Diverges, Self::NotJudged, Self::Unsupported, Self::Pass, Self::Void, Self::NotRun];

    /// In a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Diverges => "diverges",
            Self::NotJudged => "not judged",
            Self::Unsupported => "unsupported",
            Self::Void => "void",
            Self::NotRun => "not run",
        }
    }

    /// Whether the rule exists for the controller and was run.
    pub(super) fn is_judged(self) -> bool {
        !matches!(self, Self::Void | Self::NotRun)
    }
}

impl RuleCounts {
    pub(super) fn add(&mut self, verdict: CellVerdict) {
        self.rules += usize::from(verdict.is_judged());
        let count = match verdict {
            CellVerdict::Pass => &mut self.pass,
            CellVerdict::Diverges => &mut self.diverges,
            CellVerdict::NotJudged => &mut self.not_judged,
            CellVerdict::Unsupported => &mut self.unsupported,
            CellVerdict::Void => &mut self.void,
            CellVerdict::NotRun => &mut self.not_run,
        };
        *count += 1;
    }
}

/// How many rules of a chapter pass.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ChapterRow {
    /// The chapter.
    pub chapter: String,
    /// Per controller.
    pub counts: Vec<RuleCounts>,
}

/// How far the controllers are from a profile.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ProfileRow {
    /// Its id.
    pub profile: String,
    /// What it comprises.
    pub sentence: String,
    /// Per controller; absent if its edition has no rule of the profile, or the report has no profiles.
    pub distances: Vec<Option<Distance>>,
}

/// A measured limit of each controller.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct LimitRow {
    /// Its name.
    pub id: String,
    /// A phrase that names the quantity.
    pub title: String,
    /// Per controller; absent if its report has no measurement of it.
    pub results: Vec<Option<String>>,
}

/// How far a controller is from a profile.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Distance {
    /// Version of the profile.
    pub version: u32,
    /// Whether it is passed.
    pub passes: bool,
    /// How many of its rules pass.
    pub pass: usize,
    /// How many rules it has in the edition.
    pub rules: usize,
    /// Its rules that do not pass.
    pub missing: Vec<MissingRule>,
}

/// A rule on each controller.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct RuleRow {
    /// Its id.
    pub rule: String,
    /// The part of its id before the point.
    pub chapter: String,
    /// What it requires.
    pub sentence: String,
    /// The profile that it counts for.
    pub profile: String,
    /// Whether the controllers that were judged on it have different verdicts.
    pub differs: bool,
    /// Per controller.
    pub cells: Vec<Cell>,
}

/// A rule on a controller.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Cell {
    /// The verdict.
    pub verdict: CellVerdict,
    /// How many of its cases pass.
    pub pass: usize,
    /// Of how many cases an assertion does not hold, known or not.
    pub diverges: usize,
    /// How many cases it has here.
    pub cases: usize,
    /// The first case that does not pass, with what was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

/// What only one controller does, among those that were judged on the same rule.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Alone {
    /// Rules that no other one passes.
    pub passes: Vec<String>,
    /// Rules that every other one passes.
    pub fails: Vec<MissingRule>,
}

/// A controller over time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Trend {
    /// Its name.
    pub name: String,
    /// Its edition.
    pub edition: String,
    /// Its runs, the earliest first.
    pub runs: Vec<TrendRun>,
}

/// A run of a controller.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct TrendRun {
    /// The day of the report.
    pub date: String,
    /// Version of the controller.
    pub version: String,
    /// Digest of the suite.
    pub suite: String,
    /// How many rules have each verdict.
    pub counts: RuleCounts,
    /// Rules that pass here and did not in the run before.
    pub gained: Vec<String>,
    /// Rules that passed in the run before and do not here, with the word of the verdict.
    pub lost: Vec<MissingRule>,
}
