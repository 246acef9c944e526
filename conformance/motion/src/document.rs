//! What laws and bound say of a motion, as a document for programs.

use gaugeblock_reference::motion::laws::{Verdict, Violation};
use schemars::JsonSchema;
use serde::Serialize;

use super::Summary;

/// Output of `plan` and `motion check` with `--format json`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "Motion")]
pub struct MotionDocument {
    /// `motion`.
    pub gaugeblock: &'static str,
    /// Version of this form.
    pub version: u32,
    /// The exit status of the call.
    pub exit_status: u8,
    /// Seconds from the first to the last moving sample, with dwells before and after.
    pub seconds: f64,
    /// No motion that keeps its limits at every instant takes less; none if that is not known.
    pub least_seconds: Option<f64>,
    /// Why the least time is not known.
    pub least_unknown: Option<String>,
    /// The bounds that the least time rests on.
    pub bounds: Vec<&'static str>,
    /// Each motion rule, in the order in which they are judged.
    pub rules: Vec<JudgedMotionRule>,
}

/// A motion rule and its verdict.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct JudgedMotionRule {
    /// Its id.
    pub rule: &'static str,
    /// The verdict.
    pub verdict: MotionVerdict,
    /// The greatest share of what is allowed that was used, if it is measured.
    pub share: Option<f64>,
    /// Why it is not judged.
    pub why: Option<String>,
    /// Where it is broken.
    pub violations: Vec<MotionViolation>,
}

/// The verdict of a motion rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub enum MotionVerdict {
    /// Every sample keeps it.
    #[serde(rename = "holds")]
    Holds,
    /// A sample breaks it.
    #[serde(rename = "broken")]
    Broken,
    /// The samples do not have what it needs.
    #[serde(rename = "not judged")]
    NotJudged,
    /// The program has nothing that it is about, or nothing moves.
    #[serde(rename = "not applicable")]
    NotApplicable,
}

/// A place at which a motion rule is broken.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MotionViolation {
    /// The first servo cycle.
    pub cycle: usize,
    /// How many cycles in a row.
    pub cycles: usize,
    /// The axis, if it is of one axis.
    pub axis: Option<String>,
    /// What was measured, in the unit of the rule.
    pub measured: f64,
    /// What is allowed.
    pub allowed: f64,
    /// In a sentence.
    pub message: String,
}

impl Summary {
    /// The summary as a document, in which places have the names that `name` gives to a message.
    pub fn document(&self, exit_status: u8, name: &dyn Fn(&str) -> String) -> MotionDocument {
        let violation = |violation: &Violation| MotionViolation {
            cycle: violation.cycle,
            cycles: violation.cycles,
            axis: violation.axis.map(|axis| axis.to_string()),
            measured: violation.measured,
            allowed: violation.allowed,
            message: name(&violation.to_string()),
        };
        let rules = self.judgement.0.iter().map(|(law, verdict)| {
            let (word, share, why, violations) = match verdict {
                Verdict::Satisfied { .. } if !self.moves() => {
                    (MotionVerdict::NotApplicable, None, None, Vec::new())
                }
                Verdict::Satisfied { share } => (MotionVerdict::Holds, *share, None, Vec::new()),
                Verdict::NotApplicable => (MotionVerdict::NotApplicable, None, None, Vec::new()),
                Verdict::NotJudged(why) => {
                    (MotionVerdict::NotJudged, None, Some(name(why)), Vec::new())
                }
                Verdict::Violated(violations) => {
                    let violations = violations.iter().map(violation).collect();
                    (MotionVerdict::Broken, None, None, violations)
                }
            };
            JudgedMotionRule { rule: law.id(), verdict: word, share, why, violations }
        });
        MotionDocument {
            gaugeblock: "motion",
            version: 1,
            exit_status,
            seconds: self.time,
            least_seconds: self.least.as_ref().ok().copied(),
            least_unknown: self.least.as_ref().err().cloned(),
            bounds: self.kinds.clone(),
            rules: rules.collect(),
        }
    }
}
