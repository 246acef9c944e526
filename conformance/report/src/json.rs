//! The report as one JSON document.

use gaugeblock_compare::{Accuracy, Tally};
use gaugeblock_runner::certify::Scope;
use gaugeblock_runner::expectations::ExpectationMismatch;
use gaugeblock_runner::findings::{Divergent, Finding, FindingCause, Severity};
use gaugeblock_runner::fingerprint::FingerprintEntry;
use gaugeblock_runner::measure::Measurement;
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::Source;
use gaugeblock_vocabulary::Options;
use schemars::{JsonSchema, Schema, schema_for};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::grouping::title;
use super::merge::{ControllerFile, VERSION};
use super::stored::StoredCase;
use super::{Counts, Header, Report, RuleVerdict};

/// A report: what it is of, what it comes to, and what came of each case. The same run gives the same bytes, so that
/// what it cost is not here.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "Report")]
pub struct Document {
    /// `report`.
    pub gaugeblock: &'static str,
    /// Version of this form.
    pub schema: u32,
    /// Version of the tolerances by which numbers are compared.
    pub tolerances: u32,
    /// The controller.
    pub controller: String,
    /// Its version.
    pub version: String,
    /// Its files, as far as they are within reach.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub controller_files: Vec<ControllerFile>,
    /// What a person should know of how it was run.
    pub notes: Vec<String>,
    /// The edition that it was held to.
    pub edition: String,
    /// Options that the controller declares to read the documents by.
    pub options: Options,
    /// What the verdicts look at: the whole outcome, or only the assertions of the cases.
    pub scope: Scope,
    /// How exactly the controller reports numbers, by its own declaration.
    pub accuracy: Accuracy,
    /// Digest of the suite.
    pub suite: String,
    /// Version of gaugeblock.
    pub gaugeblock_version: String,
    /// The rules that were asked for; all where there are none.
    pub only: Vec<String>,
    /// Whether it judges samples of others by laws of motion, instead of moving itself.
    pub laws: bool,
    /// The part of the cases, such as `3/8`.
    pub shard: Shard,
    /// How many cases of a hundred were run twice.
    pub twice: u8,
    /// What the call ended with.
    pub exit_status: u8,
    /// How many cases came to what.
    pub counts: Counts,
    /// Each profile.
    pub profiles: Vec<JudgedProfile>,
    /// Each rule that was run.
    pub rules: Vec<JudgedRule>,
    /// Rules that do not exist in the edition.
    pub void: Vec<VoidRule>,
    /// What the controller does otherwise, by cause, the worst first.
    pub findings: Vec<ReportedFinding>,
    /// What the controller shows of each choice and quirk, where it was asked for.
    pub fingerprint: Option<Vec<FingerprintEntry>>,
    /// The controller's limits, where they were measured.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub measurements: Vec<Measurement>,
    /// Each case.
    pub cases: Vec<StoredCase>,
    /// Where it disagrees with what is known of it, if it was held against that.
    pub expectations: Option<Vec<ExpectationMismatch>>,
}

/// What a controller does otherwise, by one cause.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ReportedFinding {
    /// The rule that is broken; none if the cause is unknown.
    pub rule: Option<String>,
    /// How bad it is.
    pub severity: Severity,
    /// The quirks and other options of choices that explain every case.
    pub explanation: Vec<String>,
    /// What differs, or what explains it, in words.
    pub what: String,
    /// Whether expectations, a baseline or a waiver accept all of it.
    pub known: bool,
    /// The cases of the rule with a failing assertion, the smallest program first; without a rule, all cases.
    pub cases: Vec<CaseName>,
    /// Cases of other rules of which an assertion does not hold by the same cause.
    pub touched: Vec<CaseName>,
    /// Cases of which every assertion holds, and that differ by the same cause.
    pub side_differences: Vec<CaseName>,
}

/// A case.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct CaseName {
    /// Id of the rule.
    pub rule: String,
    /// Name of its case.
    pub case: String,
}

fn reported_finding(report: &Report<'_>, finding: &Finding<'_, '_>) -> ReportedFinding {
    let names = |cases: &[Divergent<'_, '_>]| {
        let names = cases.iter().map(|(result, _)| CaseName {
            rule: result.rule.id.clone(),
            case: result.name.to_owned(),
        });
        names.collect()
    };
    ReportedFinding {
        rule: finding.rule.map(|rule| rule.id.clone()),
        severity: finding.severity,
        explanation: match &finding.cause {
            FindingCause::Options(options) => options.clone(),
            FindingCause::Rule | FindingCause::Unknown(_) => Vec::new(),
        },
        what: title(&report.header.controller, finding),
        known: finding.is_known,
        cases: names(&finding.cases),
        touched: names(&finding.touched),
        side_differences: names(&finding.side_differences),
    }
}

/// A profile: claimed or not, passed or not, and how many of its rules came to what.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[expect(missing_docs, reason = "the words of the verdicts")]
pub struct JudgedProfile {
    pub profile: String,
    pub version: u32,
    #[serde(default)]
    pub sentence: String,
    pub claimed: bool,
    pub passes: bool,
    pub rules: usize,
    pub pass: usize,
    pub diverges: usize,
    pub unsupported: usize,
    pub not_judged: usize,
    pub not_run: usize,
    /// The rules that do not pass.
    #[serde(default)]
    pub missing: Vec<MissingRule>,
}

/// A rule that a controller needs to pass a profile.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct MissingRule {
    /// Its id.
    pub rule: String,
    /// The word of its verdict, or `not run`.
    pub verdict: String,
}

/// What came of a rule.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct JudgedRule {
    /// Its id.
    pub rule: String,
    /// What it demands.
    pub sentence: String,
    /// The profile that it counts for.
    pub profile: String,
    /// Where the documents of the edition state it.
    pub sources: Vec<Source>,
    /// The verdict.
    pub verdict: RuleVerdict,
    /// How many cases it has here.
    pub cases: usize,
    /// What was compared.
    pub compared: Tally,
}

/// A rule that does not exist in the edition.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct VoidRule {
    /// Its id.
    pub rule: String,
    /// Why it does not.
    pub why: String,
}

/// The schema of a report.
pub fn schema() -> Schema {
    let mut schema = schema_for!(Document);
    schema.insert("$id".to_owned(), format!("urn:gaugeblock:report:{VERSION}").into());
    schema
}

/// The report as JSON.
pub fn json(report: &Report<'_>) -> Value {
    serde_json::to_value(document(report)).unwrap_or_default()
}

/// The report as the text of its file.
pub fn text(report: &Report<'_>) -> String {
    format!("{:#}\n", json(report))
}

/// The report as a document.
pub fn document(report: &Report<'_>) -> Document {
    let header: Header = report.header.clone();
    let rules = report.rules().into_iter().map(|result| JudgedRule {
        rule: result.rule.id.clone(),
        sentence: result.rule.sentence.clone(),
        profile: report.suite.profile_of(result.rule).to_owned(),
        sources: report.run.edition.cited(&result.rule.sources),
        verdict: result.verdict,
        cases: result.counts.all(),
        compared: result.compared,
    });
    let void = report.run.not_applicable.iter();
    let void = void.map(|(rule, why)| VoidRule { rule: rule.id.clone(), why: (*why).to_owned() });
    Document {
        gaugeblock: "report",
        schema: VERSION,
        tolerances: gaugeblock_compare::tolerance::VERSION,
        controller: header.controller,
        version: header.version,
        controller_files: header.controller_files,
        notes: report.notes.clone(),
        edition: header.edition,
        options: header.options,
        scope: header.scope,
        accuracy: header.accuracy,
        suite: header.suite,
        gaugeblock_version: header.gaugeblock_version,
        only: header.only,
        laws: header.laws,
        shard: header.shard,
        twice: header.twice,
        exit_status: report.exit_status(),
        counts: report.counts(),
        profiles: profiles(report),
        rules: rules.collect(),
        void: void.collect(),
        findings: report.findings().iter().map(|it| reported_finding(report, it)).collect(),
        fingerprint: report.run.fingerprint.clone(),
        measurements: report.measurements.clone(),
        cases: report.run.cases.iter().map(StoredCase::of).collect(),
        expectations: report.mismatches.clone(),
    }
}

/// Each profile: claimed or not, passed or not, and how many rules came to what.
pub(super) fn profiles(report: &Report<'_>) -> Vec<JudgedProfile> {
    let missing = |(word, ids): (&'static str, Vec<&str>)| {
        let rule = |id: &str| MissingRule { rule: id.to_owned(), verdict: word.to_owned() };
        ids.into_iter().map(rule).collect::<Vec<_>>()
    };
    let judged = report.profiles.iter().map(|result| JudgedProfile {
        profile: result.profile.id.clone(),
        version: result.profile.version,
        sentence: result.profile.sentence.clone(),
        claimed: result.claimed,
        passes: result.passes(),
        rules: result.rules.len(),
        pass: result.count(RuleVerdict::Pass),
        diverges: result.count(RuleVerdict::Diverges),
        unsupported: result.count(RuleVerdict::Unsupported),
        not_judged: result.count(RuleVerdict::NotJudged),
        not_run: result.not_run(),
        missing: result.missing().into_iter().flat_map(missing).collect(),
    });
    judged.collect()
}
