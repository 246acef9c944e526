//! Why a run does not go on.

use crate::ids::Rule;
use gaugeblock_vocabulary::{Bound, FaultKind};

/// A block that is refused.
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
    /// This edition does not hold it.
    Unsupported(String),
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

/// What no document settles.
pub fn open(why: impl Into<String>) -> StepError {
    StepError::Unspecified(why.into())
}
