//! Why a program, or a run, does not go on.

use crate::ids::Rule;
use gaugeblock_vocabulary::{Bound, FaultKind};

/// A statement, or a line of the toolpath, that is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The rule that refuses it; none where it is a matter of form that no document names.
    pub rule: Option<Rule>,
    /// The kind of fault.
    pub kind: FaultKind,
    /// For people: what is wrong.
    pub message: String,
}

/// Why it does not go on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StepError {
    /// It is refused.
    Refused(Refusal),
    /// The documents leave it open, and no choice covers it.
    Unspecified(String),
    /// The budget is used up.
    Exhausted(Bound),
}

/// A refusal by a rule.
pub fn refuse(rule: impl Into<Rule>, kind: FaultKind, message: impl Into<String>) -> StepError {
    StepError::Refused(Refusal { rule: Some(rule.into()), kind, message: message.into() })
}

/// A refusal that no document names.
pub fn refuse_form(kind: FaultKind, message: impl Into<String>) -> StepError {
    StepError::Refused(Refusal { rule: None, kind, message: message.into() })
}
