//! The adapter protocol, version 1: one JSON object a line, a request and its answer by turns.
//!
//! `conformance/adapters/PROTOCOL.md` tells it to whoever writes an adapter; a test holds that page's examples to these types. The referee's side is
//! [`crate::adapters::exec`], and [`serve`] speaks the controller's side for a controller of this project.

pub mod check;
mod declaration;
mod features;
mod form;
mod serve;

use gaugeblock_trace::{Outcome, Scenario};
use schemars::{JsonSchema, Schema, schema_for};
use serde::{Deserialize, Serialize};

pub use declaration::{Clock, Declaration, Observables, vocabulary};
pub use features::{FEATURES, needed};
pub use serve::serve;

/// The version that is frozen: what stands in it stays, and what comes is optional.
pub const VERSION: u32 = 1;

/// What the referee asks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "form::Request")]
pub struct Request {
    /// The answer has the same; never the same twice in a session.
    pub id: u64,
    /// What is asked.
    #[serde(flatten)]
    pub operation: Operation,
}

/// What can be asked.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "op", rename_all = "snake_case")]
pub enum Operation {
    /// The first request of a session: who are you, and what do you show? Answered by `hello`.
    Hello {
        /// Version of the protocol that the referee speaks.
        protocol: u32,
        /// The referee and its version, for a log.
        referee: String,
    },
    /// Be as after power-on: nothing of an earlier program is left. Answered by `done`.
    Reset {},
    /// Run this; everything that it depends on is here. Answered by `outcome` or `unsupported`.
    Run {
        /// All that the run depends on.
        scenario: Box<Scenario>,
    },
    /// The session ends: answer with `done`, and exit.
    Bye {},
}

impl Operation {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Hello { .. } => "hello",
            Self::Reset {} => "reset",
            Self::Run { .. } => "run",
            Self::Bye {} => "bye",
        }
    }
}

/// What the adapter answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "form::Answer")]
pub struct Answer {
    /// That of the request.
    pub id: u64,
    /// The answer.
    #[serde(flatten)]
    pub reply: Reply,
}

/// What can be answered.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Reply {
    /// To `hello`.
    Hello(Box<Declaration>),
    /// To `reset` and `bye`.
    Done {},
    /// To `run`: what was observed.
    Outcome(Box<Outcome>),
    /// To `run`: the controller does not have what this scenario needs, and why. Nothing was run. It counts as unsupported.
    Unsupported(String),
    /// To anything: the adapter does not know this operation, or could not do it, and why. It is never a verdict on the controller.
    Refused(String),
}

impl Reply {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Hello(_) => "hello",
            Self::Done {} => "done",
            Self::Outcome(_) => "outcome",
            Self::Unsupported(_) => "unsupported",
            Self::Refused(_) => "refused",
        }
    }
}

/// The schema of a [`Request`].
pub fn request_schema() -> Schema {
    identified::<Request>("request")
}

/// The schema of an [`Answer`].
pub fn answer_schema() -> Schema {
    identified::<Answer>("answer")
}

fn identified<T: JsonSchema>(name: &str) -> Schema {
    let mut schema = schema_for!(T);
    schema.insert("$id".to_owned(), format!("urn:gaugeblock:adapter:{name}:{VERSION}").into());
    schema
}
