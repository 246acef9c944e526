//! Why a block does not go on: it is refused by a rule, or this model does not go there.

use crate::ids::Rule;
use gaugeblock_vocabulary::{End, FaultKind, Span};

/// A block refused by a rule.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// The rule that refuses it.
    pub rule: Rule,
    /// The kind of fault.
    pub kind: FaultKind,
    /// For people: what is wrong, in the field's words.
    pub message: String,
    /// The part of the line that it is about, where there is one.
    pub span: Option<Span>,
}

/// Why a block does not go on.
#[derive(Clone, Debug, PartialEq)]
pub enum StepError {
    /// It is refused.
    Refused(Refusal),
    /// The documents leave it open, and no choice covers it; the sentence says what is open.
    Unspecified(String),
    /// The run ends here for another reason: the operator has ended it or does not let it go on, or the budget is used
    /// up.
    Ended(End),
    /// It does more than the budget of effects allows in a single block.
    TooManyEffects,
    /// It waits for something that never comes, so that the budget of time runs out.
    WaitsForEver,
}

/// A refusal by a rule, without a place in the line.
pub fn refuse(rule: impl Into<Rule>, kind: FaultKind, message: impl Into<String>) -> StepError {
    StepError::Refused(Refusal { rule: rule.into(), kind, message: message.into(), span: None })
}

/// A refusal by a rule, about a part of the line.
pub fn refuse_at(
    rule: impl Into<Rule>,
    kind: FaultKind,
    span: Span,
    message: impl Into<String>,
) -> StepError {
    StepError::Refused(Refusal {
        rule: rule.into(),
        kind,
        message: message.into(),
        span: Some(span),
    })
}
