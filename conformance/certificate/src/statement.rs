//! The statement: which controller was judged, by what, with which verdicts.

use gaugeblock_report::{Counts, Header, RuleVerdict};
use gaugeblock_runner::expectations::ExpectationMismatch;
use gaugeblock_runner::shard::Shard;
use schemars::{JsonSchema, Schema, schema_for};
use serde::{Deserialize, Serialize};

use super::case::CertifiedCase;

/// The type of every in-toto statement of version 1.
pub const STATEMENT_TYPE: &str = "https://in-toto.io/Statement/v1";

/// The type of the predicate; the number is its version.
pub const PREDICATE_TYPE: &str = "urn:gaugeblock:certificate:1";

/// An in-toto statement about the files of a controller.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "Certificate")]
pub struct Statement {
    /// `https://in-toto.io/Statement/v1`.
    #[serde(rename = "_type")]
    pub statement_type: String,
    /// The files of the controller.
    pub subject: Vec<Subject>,
    /// `urn:gaugeblock:certificate:1`.
    #[serde(rename = "predicateType")]
    pub predicate_type: String,
    /// What the run found.
    pub predicate: Predicate,
}

/// A file of the controller.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Subject {
    /// Its name, without its folder.
    pub name: String,
    /// Its digest.
    pub digest: Digest,
    /// The controller.
    pub annotations: SubjectAnnotations,
}

/// The digest of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Digest {
    /// SHA-256, in hexadecimal.
    pub sha256: String,
}

/// The controller of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SubjectAnnotations {
    /// Its name.
    pub controller: String,
    /// Its version.
    pub version: String,
}

/// What a run found, and under which circumstances.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Predicate {
    /// What the run is of: controller, edition, options, scope, suite, selection, shard.
    pub run: Header,
    /// Whether every case of the edition was selected.
    pub coverage: Coverage,
    /// The whole SHA-256 of the suite. `run` has its beginning.
    pub suite_sha256: String,
    /// Version of the tolerances by which numbers are compared.
    pub tolerances: u32,
    /// What judged the controller.
    pub tool: Tool,
    /// The verdict of the run.
    pub result: RunResult,
    /// How many cases have which verdict.
    pub counts: Counts,
    /// The profiles that were claimed, and those that passed.
    pub profiles: Vec<CertifiedProfile>,
    /// Lists of known and waived divergences that the run was compared with.
    pub lists: Vec<AcceptanceList>,
    /// Where the run disagrees with these lists; none without a list.
    pub mismatches: Option<Vec<ExpectationMismatch>>,
    /// What a person should know of how it was run.
    pub notes: Vec<String>,
    /// What random choices depend on.
    pub seeds: Seeds,
    /// SHA-256 of the file `report.json` of this run.
    pub report_sha256: String,
    /// The shards that were merged; none for a run that was not.
    pub shards: Vec<CertifiedShard>,
    /// The machine on which the statement was made.
    pub host: Host,
    /// When the run began, in UTC; none for a merged run.
    pub started: Option<String>,
    /// When the statement was made, in UTC.
    pub made: String,
    /// Each rule that was run, with its cases.
    pub rules: Vec<CertifiedRule>,
}

/// Whether every case of an edition was selected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Coverage {
    /// Every case of the edition, or one shard of all cases.
    Complete,
    /// Only what `run.only` selects. It says nothing about other rules.
    Partial,
}

/// The verdict of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum RunResult {
    /// Every judged case passes, is known or is waived; exit status 0.
    Passes,
    /// A divergence, a mismatch with a list, or a claimed profile that is not passed; exit status 1.
    Fails,
    /// A case could not be judged, or none was; exit status 3.
    Unfinished,
}

/// What judged the controller.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Tool {
    /// `gaugeblock`.
    pub name: String,
    /// Its version.
    pub version: String,
    /// SHA-256 of its binary.
    pub sha256: String,
}

/// A profile that was claimed or passed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct CertifiedProfile {
    /// Its id.
    pub profile: String,
    /// Its version.
    pub version: u32,
    /// Whether it was claimed.
    pub claimed: bool,
    /// Whether every rule of it was run and passes.
    pub passes: bool,
}

/// A list that accepts divergences.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct AcceptanceList {
    /// Which kind of list.
    pub kind: ListKind,
    /// The name of its file.
    pub file: String,
    /// The SHA-256 of its file.
    pub sha256: String,
}

/// A kind of list that accepts divergences.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ListKind {
    /// Known divergences.
    Expectations,
    /// An earlier report.
    Baseline,
    /// Divergences that an owner accepts until a day.
    Waivers,
}

impl ListKind {
    /// In a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Expectations => "expectations",
            Self::Baseline => "baseline",
            Self::Waivers => "waivers",
        }
    }
}

/// What random choices of a run depend on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Seeds {
    /// What decides which `run.twice` percent of the cases are run twice.
    pub run_twice: String,
}

impl Default for Seeds {
    /// Those of every run of this version.
    fn default() -> Self {
        Self { run_twice: "SHA-256 of RULE / CASE".to_owned() }
    }
}

/// A shard that was merged.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct CertifiedShard {
    /// Which one.
    pub shard: Shard,
    /// SHA-256 of its `report.json`.
    pub report_sha256: String,
}

/// A machine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Host {
    /// Its operating system.
    pub system: String,
    /// The version of its kernel, where it is known.
    pub kernel: Option<String>,
    /// The architecture of its processor.
    pub architecture: String,
    /// How many processors the run could use.
    pub processors: usize,
}

/// A rule that was run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct CertifiedRule {
    /// Its id.
    pub rule: String,
    /// The verdict.
    pub verdict: RuleVerdict,
    /// Its cases.
    pub cases: Vec<CertifiedCase>,
}

impl Statement {
    /// Reads a statement.
    ///
    /// # Errors
    /// It is not a certificate of this version, or has another form; the message follows the name of the file.
    pub fn read(text: &str) -> Result<Self, String> {
        #[derive(Deserialize)]
        struct Types {
            #[serde(rename = "_type")]
            statement_type: String,
            #[serde(rename = "predicateType")]
            predicate_type: String,
        }
        let wrong = |error: serde_json::Error| format!("is not a certificate (JSON): {error}");
        let types: Types = serde_json::from_str(text).map_err(wrong)?;
        for (found, expected) in
            [(types.statement_type, STATEMENT_TYPE), (types.predicate_type, PREDICATE_TYPE)]
        {
            if found != expected {
                return Err(format!("is of type {found}; expected {expected}"));
            }
        }
        let statement: Self = serde_json::from_str(text).map_err(wrong)?;
        match first_difference(text, &statement.to_text()) {
            None => Ok(statement),
            Some(line) => Err(format!(
                "has another form than a certificate, first in line {line}: \
                 expected each field once and none of another version"
            )),
        }
    }

    /// The one text of this statement.
    pub fn to_text(&self) -> String {
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        format!("{text}\n")
    }

    /// How many cases it has a verdict of.
    pub fn case_count(&self) -> usize {
        self.predicate.rules.iter().map(|rule| rule.cases.len()).sum()
    }
}

/// The first line in which two texts differ, counted from 1.
fn first_difference(one: &str, other: &str) -> Option<usize> {
    if one == other {
        return None;
    }
    let same = one.lines().zip(other.lines()).take_while(|(one, other)| one == other).count();
    Some(same + 1)
}

/// The schema of a certificate.
pub fn schema() -> Schema {
    let mut schema = schema_for!(Statement);
    schema.insert("$id".to_owned(), PREDICATE_TYPE.into());
    schema
}
