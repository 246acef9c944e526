//! What a verification found.

use gaugeblock_certificate::{RunResult, Statement};

use super::rerun::Rerun;

/// A certificate with a valid signature.
#[derive(Clone, Debug)]
pub(super) struct Signed {
    pub(super) file: String,
    pub(super) key: String,
    /// What was signed together with the file.
    pub(super) comment: String,
    pub(super) statement: Statement,
}

/// What a verification found.
#[derive(Clone, Debug, Default)]
pub(super) struct Verification {
    pub(super) certificates: Vec<Signed>,
    pub(super) problems: Vec<String>,
    pub(super) notes: Vec<String>,
    pub(super) rerun: Option<Rerun>,
}

impl Verification {
    /// Whether nothing is wrong with the certificates, and another run found the same.
    pub(super) fn is_verified(&self) -> bool {
        self.problems.is_empty() && self.rerun.as_ref().is_none_or(Rerun::is_same)
    }

    /// The worst result of the certificates.
    pub(super) fn result(&self) -> RunResult {
        let mut results = self.certificates.iter().map(|signed| signed.statement.predicate.result);
        let has = |wanted: RunResult| move |result: RunResult| result == wanted;
        if results.clone().any(has(RunResult::Fails)) {
            RunResult::Fails
        } else if results.any(has(RunResult::Unfinished)) {
            RunResult::Unfinished
        } else {
            RunResult::Passes
        }
    }

    /// The exit status of the call.
    pub(super) fn exit_status(&self) -> u8 {
        match (self.is_verified(), self.result()) {
            (false, _) | (true, RunResult::Fails) => 1,
            (true, RunResult::Unfinished) => 3,
            (true, RunResult::Passes) => 0,
        }
    }
}
