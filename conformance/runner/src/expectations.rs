//! Expectations: the known divergences of a controller. They are strict and never stale.
//!
//! A known divergence has rule, case and what was found. The run fails if the controller does something else, if it no
//! longer diverges, and if a divergence is not listed.

use std::collections::{BTreeMap, BTreeSet};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::certify::{Cause, EXPECTATIONS, RuleDivergence, Run, Verdict};

/// A known divergence.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnownDivergence {
    /// The rule.
    pub rule: String,
    /// Its case.
    pub case: String,
    /// What is found, in the words of the report.
    pub found: String,
    /// The quirk, or the other option of a choice, that explains it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub explanation: Option<String>,
    /// Why it differs: a sentence, or a name in [`Expectations::reasons`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl KnownDivergence {
    /// Whether it lists that the case could not be judged, and it could not.
    fn is_unjudged(&self, verdict: &Verdict) -> bool {
        matches!(verdict, Verdict::NotJudged(reason) if self.found == reason.cause.word())
    }
}

/// The known divergences of a controller from an edition.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectations {
    /// The controller.
    pub controller: String,
    /// Its version.
    pub version: String,
    /// The edition that it is compared with.
    pub edition: String,
    /// Reasons that several divergences share, by their names.
    #[serde(default, skip_serializing)]
    pub reasons: BTreeMap<String, String>,
    /// The divergences, ordered by rule and case.
    #[serde(default)]
    pub known: Vec<KnownDivergence>,
}

/// How a run and the expectations disagree.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "trouble", rename_all = "snake_case")]
pub enum ExpectationMismatch {
    /// A divergence that is not listed.
    New {
        /// The rule.
        rule: String,
        /// Its case.
        case: String,
        /// What is found.
        found: String,
    },
    /// A listed divergence that is another one now, or a case that passed in the baseline and is not judged any more.
    Changed {
        /// The rule.
        rule: String,
        /// Its case.
        case: String,
        /// What is listed.
        listed: String,
        /// What is found.
        found: String,
    },
    /// A listed divergence of a case that passes now, or was not judged.
    Stale {
        /// The rule.
        rule: String,
        /// Its case.
        case: String,
        /// Why it is stale.
        why: String,
    },
}

impl ExpectationMismatch {
    /// Its rule and case.
    pub fn place(&self) -> (&str, &str) {
        match self {
            Self::New { rule, case, .. }
            | Self::Changed { rule, case, .. }
            | Self::Stale { rule, case, .. } => (rule, case),
        }
    }
}

impl std::fmt::Display for ExpectationMismatch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::New { rule, case, found } => write!(f, "new: {rule} / {case}: {found}"),
            Self::Changed { rule, case, listed, found } => {
                write!(f, "changed: {rule} / {case}: listed {listed}; now {found}")
            }
            Self::Stale { rule, case, why } => write!(f, "stale: {rule} / {case}: {why}"),
        }
    }
}

impl Expectations {
    /// Reads a file of expectations.
    ///
    /// # Errors
    /// It is not in the form, with line and column; a divergence is listed twice; a reason is empty, has an unknown
    /// name, or is a named one that no divergence has.
    pub fn read(text: &str) -> Result<Self, String> {
        let read: Self = toml::from_str(text).map_err(|error| error.to_string())?;
        let mut seen = BTreeSet::new();
        let mut unused: BTreeSet<&String> = read.reasons.keys().collect();
        for known in &read.known {
            let KnownDivergence { rule, case, reason, .. } = known;
            if !seen.insert((rule, case)) {
                return Err(format!("{rule} / {case} is listed twice"));
            }
            if let Some(reason) = reason
                && !unused.remove(reason)
                && !read.reasons.contains_key(reason)
                && !reason.trim().contains(' ')
            {
                return Err(format!(
                    "invalid reason of {rule} / {case}: {reason:?}; expected a sentence, or a name in [reasons]"
                ));
            }
        }
        if let Some((name, _)) = read.reasons.iter().find(|(_, text)| text.trim().is_empty()) {
            return Err(format!("invalid reason {name}: \"\"; expected a sentence"));
        }
        match unused.first() {
            Some(name) => Err(format!("unused reason: {name}; expected a divergence that has it")),
            None => Ok(read),
        }
    }

    /// The divergences of a run, as expectations, and its cases that could not be judged, each with the word of its
    /// verdict. A side difference is listed unless all that explains it explains a
    /// listed divergence, too.
    pub fn of(run: &Run<'_>, controller: &str, version: &str) -> Self {
        let own = run.cases.iter().filter_map(|result| result.verdict.own_divergence());
        let explained: BTreeSet<&str> =
            own.flat_map(|divergence| &divergence.explanation).map(String::as_str).collect();
        let known = run.cases.iter().filter_map(|result| {
            if let Verdict::NotJudged(reason) = &result.verdict {
                return (reason.cause != Cause::NotRun).then(|| KnownDivergence {
                    rule: result.rule.id.clone(),
                    case: result.name.to_owned(),
                    found: reason.cause.word().to_owned(),
                    explanation: None,
                    reason: None,
                });
            }
            let divergence = result.verdict.divergence()?;
            let is_own = result.verdict.own_divergence().is_some();
            if !is_own && is_explained(divergence, &explained) {
                return None;
            }
            Some(KnownDivergence {
                rule: result.rule.id.clone(),
                case: result.name.to_owned(),
                found: divergence.summary(),
                explanation: joined(&divergence.explanation),
                reason: None,
            })
        });
        Self {
            controller: controller.to_owned(),
            version: version.to_owned(),
            edition: run.edition.id.clone(),
            reasons: BTreeMap::new(),
            known: known.collect(),
        }
    }

    /// Takes the reasons of an earlier list over to the divergences of the same rules and cases. Returns a note for each
    /// whose difference has changed: its reason may not apply any more.
    pub fn keep_reasons(&mut self, earlier: &Self) -> Vec<String> {
        let places = earlier.known.iter().map(|known| ((&known.rule, &known.case), known));
        let before: BTreeMap<_, _> = places.collect();
        let mut notes = Vec::new();
        for known in &mut self.known {
            let Some(old) = before.get(&(&known.rule, &known.case)) else { continue };
            let Some(reason) = &old.reason else { continue };
            if old.found != known.found {
                notes.push(format!(
                    "the difference of {} / {} has changed: check its reason",
                    known.rule, known.case
                ));
            }
            if let Some(text) = earlier.reasons.get(reason) {
                self.reasons.insert(reason.clone(), text.clone());
            }
            known.reason = Some(reason.clone());
        }
        notes
    }

    /// Why the divergence of a case is listed, if the file says so.
    pub fn reason(&self, rule: &str, case: &str) -> Option<&str> {
        let known = self.known.iter().find(|known| known.rule == rule && known.case == case)?;
        let reason = known.reason.as_ref()?;
        Some(self.reasons.get(reason).unwrap_or(reason))
    }

    /// What accepts the divergence of a case: this list, with its reason.
    pub fn source(&self, rule: &str, case: &str) -> String {
        match self.reason(rule, case) {
            Some(reason) => format!("{EXPECTATIONS}: {reason}"),
            None => EXPECTATIONS.to_owned(),
        }
    }

    /// What accepts that a case could not be judged, by the word of its verdict: this list, with its reason.
    pub fn accepts_unjudged(&self, rule: &str, case: &str, word: &str) -> Option<String> {
        let is_listed =
            |known: &&KnownDivergence| (known.rule.as_str(), known.case.as_str()) == (rule, case);
        let known = self.known.iter().find(is_listed)?;
        (known.found == word).then(|| self.source(rule, case))
    }

    /// The text of a file of expectations.
    ///
    /// # Errors
    /// TOML cannot hold the text.
    pub fn to_text(&self) -> Result<String, String> {
        let text = toml::to_string(self).map_err(|error| error.to_string())?;
        let text: String = text.lines().map(wrapped).collect();
        if self.reasons.is_empty() {
            return Ok(text);
        }
        // Named reasons are paragraphs, in lines that a person can read.
        let reasons: String = self
            .reasons
            .iter()
            .map(|(name, text)| format!("{name} = {}\n", paragraph(text)))
            .collect();
        let at = text.find("\n[[known]]").unwrap_or(text.len());
        let (head, known) = text.split_at(at);
        Ok(format!("{head}\n[reasons]\n{reasons}{known}"))
    }

    /// Differences between a run and these expectations; none if the run diverges exactly as listed.
    ///
    /// With `whole` every case was selected. Only then is a listed case stale because it was not run.
    pub fn compare<'a>(&'a self, run: &'a Run<'_>, whole: bool) -> Vec<ExpectationMismatch> {
        let mut listed: BTreeMap<(&str, &str), &KnownDivergence> = self
            .known
            .iter()
            .map(|known| ((known.rule.as_str(), known.case.as_str()), known))
            .collect();
        let explanations = self.known.iter().filter_map(|known| known.explanation.as_deref());
        let explained: BTreeSet<&str> = explanations.flat_map(parts).collect();
        let mut mismatches = Vec::new();
        for result in &run.cases {
            let (rule, case) = (result.rule.id.clone(), result.name.to_owned());
            let known = listed.remove(&(result.rule.id.as_str(), result.name));
            match (&result.verdict, result.verdict.divergence(), known) {
                (Verdict::SideDifference(divergence), _, None)
                    if is_explained(divergence, &explained) => {}
                (_, Some(divergence), None) => {
                    let found = divergence.summary();
                    mismatches.push(ExpectationMismatch::New { rule, case, found });
                }
                (_, Some(divergence), Some(known)) if divergence.summary() != known.found => {
                    let (listed, found) = (known.found.clone(), divergence.summary());
                    mismatches.push(ExpectationMismatch::Changed { rule, case, listed, found });
                }
                (_, Some(_), Some(_)) | (_, None, None) => {}
                (Verdict::Pass, None, Some(_)) => {
                    let why = "the case passes: take the entry out".to_owned();
                    mismatches.push(ExpectationMismatch::Stale { rule, case, why });
                }
                (verdict, None, Some(known)) if known.is_unjudged(verdict) => {}
                (verdict, None, Some(_)) => {
                    let why = verdict.reason().unwrap_or_default();
                    let why = format!("the case is not judged: {}: {why}", verdict.word());
                    mismatches.push(ExpectationMismatch::Stale { rule, case, why });
                }
            }
        }
        for known in listed.into_values().filter(|_| whole) {
            mismatches.push(ExpectationMismatch::Stale {
                rule: known.rule.clone(),
                case: known.case.clone(),
                why: "the suite has no such case in this edition".to_owned(),
            });
        }
        mismatches
    }
}

/// Whether a side difference has causes, and all of them are among those of listed divergences.
fn is_explained(divergence: &RuleDivergence, explained: &BTreeSet<&str>) -> bool {
    let parts = &divergence.explanation;
    !parts.is_empty() && parts.iter().all(|part| explained.contains(part.as_str()))
}

/// The text between the parts of an explanation.
const AND: &str = " and ";

fn joined(explanation: &[String]) -> Option<String> {
    (!explanation.is_empty()).then(|| explanation.join(AND))
}

fn parts(explanation: &str) -> impl Iterator<Item = &str> {
    explanation.split(AND)
}

/// Wraps a long line `key = "text"` of TOML, if that keeps each blank of the text.
fn wrapped(line: &str) -> String {
    const COLUMNS_MAX: usize = 120;
    let texts = toml::from_str::<BTreeMap<String, String>>(line).unwrap_or_default();
    match texts.first_key_value() {
        Some((key, text))
            if line.chars().count() > COLUMNS_MAX
                && text.split_whitespace().collect::<Vec<_>>().join(" ") == *text =>
        {
            format!("{key} = {}\n", paragraph(text))
        }
        _ => format!("{line}\n"),
    }
}

/// A text of TOML in lines of 120 columns at most, as far as its words allow; TOML joins them again.
fn paragraph(text: &str) -> String {
    const COLUMNS_MAX: usize = 118;
    const CLOSING: usize = 1;
    let mut written = String::from("\"\"\"\n");
    let mut column = 0;
    let mut words = text.split_whitespace().map(escaped).peekable();
    while let Some(word) = words.next() {
        // The closing quotes are one column wider than the backslash of other lines.
        let closing = if words.peek().is_none() { CLOSING } else { 0 };
        let width = word.chars().count() + closing;
        if column > 0 && column + 1 + width > COLUMNS_MAX {
            written.push_str(" \\\n");
            column = 0;
        } else if column > 0 {
            written.push(' ');
            column += 1;
        }
        written.push_str(&word);
        column += width;
    }
    written + "\"\"\""
}

/// A word without what ends or controls a text of TOML.
fn escaped(word: &str) -> String {
    let escape = |letter: char| match letter {
        '"' | '\\' => format!("\\{letter}"),
        _ if letter.is_control() => format!("\\u{:04X}", u32::from(letter)),
        _ => letter.to_string(),
    };
    word.chars().map(escape).collect()
}
