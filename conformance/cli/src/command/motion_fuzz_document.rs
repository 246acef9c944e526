//! What `motion fuzz` found, as a document for programs.

use schemars::JsonSchema;
use serde::Serialize;

/// Output of `motion fuzz --format json`.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "MotionFuzz")]
pub(crate) struct MotionFuzzDocument {
    /// `motion-fuzz`.
    pub(crate) gaugeblock: &'static str,
    /// Version of this form.
    pub(crate) version: u32,
    /// The exit status of the call.
    pub(crate) exit_status: u8,
    /// The random seed.
    pub(crate) seed: u64,
    /// Number of programs.
    pub(crate) programs: u64,
    /// Number of planned servo cycles.
    pub(crate) cycles: usize,
    /// Each kind of violation.
    pub(crate) violations: Vec<ReportedViolation>,
    /// Why programs were not planned.
    pub(crate) not_planned: Vec<ReportedGap>,
    /// Which motion rules were not judged, and why.
    pub(crate) not_judged: Vec<ReportedGap>,
}

/// Violations of a kind.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct ReportedViolation {
    /// The motion rule, or the change of the program that broke its time.
    pub(crate) kind: String,
    /// How many programs have it.
    pub(crate) count: u64,
    /// Number of the first program that has it.
    pub(crate) first: u64,
    /// What was seen there, in a sentence.
    pub(crate) message: String,
    /// The minimised program.
    pub(crate) program: String,
    /// Calls that plan it again, in the folder of --report.
    pub(crate) calls: Vec<String>,
}

/// Programs that were not planned, or not judged, for one reason.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct ReportedGap {
    /// The reason.
    pub(crate) why: String,
    /// How many programs.
    pub(crate) count: u64,
    /// Number of the first program.
    pub(crate) first: u64,
}
