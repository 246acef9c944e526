//! One report out of those of shards: what is missing, twice there, or not of one run is refused.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_adapter::Adapter;
use gaugeblock_compare::Accuracy;
use gaugeblock_runner::certify::{CaseResult, Plan, RepeatSampling, Scope};
use gaugeblock_runner::fingerprint::FingerprintEntry;
use gaugeblock_runner::measure::Measurement;
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::Options;
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::consistency;
use super::stored::StoredCase;

/// Version of the form.
pub const VERSION: u32 = 2;

/// Reads a report, or those of its parts that are of use.
///
/// # Errors
/// It is not a report of this version; the message follows the name of the file.
pub fn read<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    #[derive(Deserialize)]
    struct Form {
        gaugeblock: String,
        schema: u32,
    }
    let not_a_report = |why: String| format!("is not a Gaugeblock report (JSON): {why}");
    let wrong = |error: serde_json::Error| not_a_report(error.to_string());
    let Form { gaugeblock, schema } = serde_json::from_str(text).map_err(wrong)?;
    if gaugeblock != "report" {
        return Err(not_a_report(format!("it is a document of Gaugeblock's kind `{gaugeblock}`")));
    }
    if schema != VERSION {
        return Err(format!(
            "is a report of version {schema}, and this Gaugeblock reads version {VERSION}: run certify again"
        ));
    }
    serde_json::from_str(text).map_err(wrong)
}

/// A file that decides what a controller does, such as its binary.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
pub struct ControllerFile {
    /// Its name, without its folder.
    pub name: String,
    /// Its SHA-256, in hexadecimal.
    pub sha256: String,
}

/// What a report is of: two reports can be compared case by case, or merged, only where this is equal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Header {
    /// The controller.
    pub controller: String,
    /// Its version.
    pub version: String,
    /// Its files, as far as they are within reach.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub controller_files: Vec<ControllerFile>,
    /// The edition that it was held to.
    pub edition: String,
    /// Options that the controller reads the documents by.
    pub options: Options,
    /// What the verdicts look at; `full` in reports that do not say it.
    #[serde(default)]
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
    /// The part of the cases.
    pub shard: Shard,
    /// How many cases of a hundred are run twice.
    pub twice: u8,
}

impl Header {
    /// Whether some cases were left out: by a selection, or since others are in other shards.
    pub fn is_in_part(&self) -> bool {
        !self.only.is_empty() || self.shard != Shard::WHOLE
    }

    /// What a run is of.
    pub fn of(plan: Plan<'_>, controller: &dyn Adapter, shard: Shard) -> Self {
        let observables = controller.capabilities();
        Self {
            controller: observables.name.clone(),
            version: observables.version.clone(),
            controller_files: Vec::new(),
            edition: plan.edition.id.clone(),
            options: controller.options(),
            scope: plan.scope,
            accuracy: observables.accuracy(),
            suite: plan.suite.digest.clone(),
            gaugeblock_version: env!("CARGO_PKG_VERSION").to_owned(),
            only: plan.only.to_vec(),
            laws: controller.has_laws_of_motion(),
            shard,
            twice: RepeatSampling::default().0,
        }
    }
}

/// A report that is read again: as much of it as the rest follows from.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Stored {
    /// What it is of.
    #[serde(flatten)]
    pub header: Header,
    /// What a person should know of how it was run.
    pub notes: Vec<String>,
    /// Its cases.
    pub cases: Vec<StoredCase>,
    /// What the controller shows of each choice and quirk.
    pub fingerprint: Option<Vec<FingerprintEntry>>,
    /// The controller's limits, where they were measured.
    #[serde(default)]
    pub measurements: Vec<Measurement>,
    profiles: Vec<Claimed>,
}

#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
struct Claimed {
    profile: String,
    claimed: bool,
}

impl Stored {
    /// Reads a report in JSON.
    ///
    /// # Errors
    /// It is not one, or its counts or its exit status do not follow from its cases; the message follows the name of
    /// the file.
    pub fn read(text: &str) -> Result<Self, String> {
        let stored: Self = read(text)?;
        consistency::check(&read(text)?, &stored.cases)?;
        Ok(stored)
    }

    /// The profiles that were claimed.
    pub fn claimed(&self) -> Vec<String> {
        let claimed = self.profiles.iter().filter(|profile| profile.claimed);
        claimed.map(|profile| profile.profile.clone()).collect()
    }
}

/// Puts the parts of a run together, as far as the parts are there.
///
/// # Errors
/// A part that is missing or there twice, or parts of different runs, with their names.
pub fn merged(parts: &[(String, Stored)]) -> Result<Stored, String> {
    let Some((first_name, first)) = parts.first() else {
        return Err("there is no report to merge".to_owned());
    };
    let of = first.header.shard.of;
    let mut by_index: BTreeMap<u64, &str> = BTreeMap::new();
    for (name, part) in parts {
        let shard = part.header.shard;
        if (Header { shard, ..first.header.clone() }) != part.header
            || shard.of != of
            || part.claimed() != first.claimed()
        {
            return Err(format!(
                "{first_name} and {name} are not of one run: {}",
                first_mismatch(first, part)
            ));
        }
        if let Some(other) = by_index.insert(shard.index, name) {
            return Err(format!("{other} and {name} are both shard {shard}"));
        }
    }
    let missing: Vec<_> = (1..=of).filter(|index| !by_index.contains_key(index)).collect();
    if !missing.is_empty() {
        let missing: Vec<_> = missing.iter().map(|index| format!("{index}/{of}")).collect();
        return Err(format!("shards are missing: {}", missing.join(", ")));
    }
    let notes: BTreeSet<&String> = parts.iter().flat_map(|(_, part)| &part.notes).collect();
    let measured = parts.iter().map(|(_, part)| part).find(|part| !part.measurements.is_empty());
    Ok(Stored {
        header: Header { shard: Shard::WHOLE, ..first.header.clone() },
        notes: notes.into_iter().cloned().collect(),
        cases: parts.iter().flat_map(|(_, part)| part.cases.iter().cloned()).collect(),
        fingerprint: parts.iter().find_map(|(_, part)| part.fingerprint.clone()),
        measurements: measured.map_or_else(Vec::new, |part| part.measurements.clone()),
        profiles: first.profiles.clone(),
    })
}

/// In what two parts differ.
fn first_mismatch(a: &Stored, b: &Stored) -> String {
    let (one, other) = (a.claimed().join(" "), b.claimed().join(" "));
    let claims = (one != other).then(|| format!("--profile {one:?} and {other:?}"));
    let number = || {
        let (one, other) = (a.header.shard.of, b.header.shard.of);
        (one != other).then(|| format!("number of shards \"{one}\" and \"{other}\""))
    };
    let header = Header { shard: a.header.shard, ..b.header.clone() };
    let first = first_difference(&a.header, &header).or(claims).or_else(number);
    first.unwrap_or_else(|| "other options".to_owned())
}

/// In what two runs differ first, with both; nothing if they are of the same.
pub fn first_difference(first: &Header, second: &Header) -> Option<String> {
    if first == second {
        return None;
    }
    let of = |what: &str, one: &str, other: &str| {
        (one != other).then(|| format!("{what} {one:?} and {other:?}"))
    };
    let known = [
        of("controller", &first.controller, &second.controller),
        of("version", &first.version, &second.version),
        of("controller files", &listed_files(first), &listed_files(second)),
        of("edition", &first.edition, &second.edition),
        of("options", &listed_options(first), &listed_options(second)),
        of("scope", first.scope.words(), second.scope.words()),
        of("accuracy", &first.accuracy.to_string(), &second.accuracy.to_string()),
        of("suite", &first.suite, &second.suite),
        of("gaugeblock", &first.gaugeblock_version, &second.gaugeblock_version),
        of("--only", &first.only.join(" "), &second.only.join(" ")),
        of("--repeat-percent", &first.twice.to_string(), &second.twice.to_string()),
    ];
    Some(known.into_iter().flatten().next().unwrap_or_else(|| "another selection".to_owned()))
}

/// The files of a controller, in a line.
fn listed_files(header: &Header) -> String {
    let files = header.controller_files.iter().map(|file| format!("{} {}", file.name, file.sha256));
    files.collect::<Vec<_>>().join(", ")
}

/// The options of a run, in a line.
fn listed_options(header: &Header) -> String {
    let options = header.options.0.iter().map(|(id, option)| format!("{id} = {option}"));
    options.collect::<Vec<_>>().join(", ")
}

/// The cases of a stored report in the order of `all` cases of a run: each of them exactly once.
///
/// # Errors
/// A case that is missing, there twice, or not of the run.
pub fn in_order<'a>(
    stored: &[StoredCase],
    all: &[(&str, &str)],
    suite: &'a Suite,
) -> Result<Vec<CaseResult<'a>>, String> {
    let mut results = BTreeMap::new();
    for case in stored {
        let key = (case.rule.as_str(), case.case.as_str());
        if results.insert(key, case.result(suite)?).is_some() {
            return Err(format!("{} / {} is there twice", case.rule, case.case));
        }
    }
    let ordered = all.iter().map(|(rule, case)| {
        let result = results.remove(&(*rule, *case));
        result.ok_or_else(|| format!("{rule} / {case} is missing"))
    });
    let ordered = ordered.collect::<Result<Vec<_>, _>>()?;
    match results.keys().next() {
        Some((rule, case)) => Err(format!("{rule} / {case} is not of this run")),
        None => Ok(ordered),
    }
}
