//! The adapter protocol, version 1: one JSON object a line, a request and its answer by turns.
//!
//! `PROTOCOL.md` of this crate tells it to whoever writes an adapter; a test holds that page's examples to
//! these types. The referee's side is [`crate::exec`], and [`serve`] speaks the controller's side for a
//! controller of this project.

mod answer_reader;
mod declaration;
pub mod digest;
mod extensions;
mod features;
mod form;
mod number_literals;
mod serve;
mod spin_wait;
mod suggestion;

use gaugeblock_vocabulary::motion::{MotionLimits, MotionScript};
use gaugeblock_vocabulary::scenario::{OperatorEvent, RunPoint};
use gaugeblock_vocabulary::{Indexed, Outcome, Scenario, Settings, State, Step, schema};
use schemars::{JsonSchema, Schema, schema_for};
use serde::{Deserialize, Serialize};

pub(crate) use answer_reader::AnswerReader;
pub use declaration::{Clock, Declaration, Observables, VERSION, vocabulary};
pub use extensions::{EXTENSIONS, Extension};
pub use features::{FEATURES, needed};
pub use gaugeblock_vocabulary::{CommentKind, DeclaredLanguage, ParameterKind};
pub(crate) use number_literals::read_json;
pub use serve::{Caller, Served, serve};
pub use spin_wait::SpinWait;
pub(crate) use suggestion::with_suggestion;

/// The page that tells the protocol to whoever writes an adapter.
pub const PAGE: &str = include_str!("../../PROTOCOL.md");

/// What the referee asks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "form::Request")]
#[schemars(!try_from)]
pub struct Request {
    /// The answer has the same; never the same twice in a session.
    pub id: u64,
    /// What is asked.
    #[serde(flatten)]
    pub operation: Operation,
}

/// What can be asked. What belongs to an [`Extension`] is asked of nobody who does not declare it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "op", rename_all = "snake_case")]
pub enum Operation {
    /// The first request of a session: who are you, and what do you show? Answered by `hello`.
    Hello {
        /// Version of the protocol that the referee speaks.
        protocol: u32,
        /// The referee and its version, for a log.
        referee: String,
        /// For [`Extension::Files`]: a folder in which answers may be laid, where both are on one machine.
        #[serde(skip_serializing_if = "Option::is_none")]
        folder: Option<String>,
    },
    /// Be as after power-on: nothing of an earlier program is left. Answered by `done`.
    Reset {},
    /// Run this; everything that it depends on is here. Answered by `outcome` or `unsupported`.
    Run {
        /// All that the run depends on.
        scenario: Box<Scenario>,
        /// How it may be told.
        #[serde(flatten)]
        modes: RunModes,
    },
    /// [`Extension::Motion`]: run this, and tell what is commanded of the axes. Answered by `samples`, `file` or
    /// `unsupported`.
    Move {
        /// All that the run depends on.
        scenario: Box<Scenario>,
        /// What the axes can do, and the servo period.
        limits: MotionLimits,
        /// What a person and the inputs do, by servo cycle.
        script: MotionScript,
        /// The planner is given a segment in so many servo cycles; as many as it takes where nothing is said.
        #[serde(skip_serializing_if = "Option::is_none")]
        every: Option<u32>,
    },
    /// [`Extension::Shows`]: tell what is observed of this scenario when it is run. Answered by `shows`.
    Shows {
        /// What `run` will have.
        scenario: Box<Scenario>,
    },
    /// [`Extension::Cancel`]: end the run that is going on and be as after `reset`. Answered by `done`; the run is not
    /// answered any more.
    Cancel {},
    /// [`Extension::State`]: tell what is in force now. Answered by `state`.
    State {},
    /// [`Extension::Stream`]: so many more batches may come. It has the id of the run and no answer of its own.
    Credit {
        /// How many more.
        batches: u32,
    },
    /// [`Extension::LiveOperator`]: do this now. It has the id of the run and no answer of its own.
    Operator {
        /// What, and where it belongs.
        event: OperatorEvent,
    },
    /// [`Extension::Digest`]: report the outcome of the last run, whose digest was answered. Answered by `outcome` or
    /// `file`.
    Outcome {},
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
            Self::Move { .. } => "move",
            Self::Shows { .. } => "shows",
            Self::Cancel {} => "cancel",
            Self::State {} => "state",
            Self::Credit { .. } => "credit",
            Self::Operator { .. } => "operator",
            Self::Outcome {} => "outcome",
            Self::Bye {} => "bye",
        }
    }
}

/// How a run may be told beside one whole outcome in one line.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct RunModes {
    /// [`Extension::Stream`]: its steps may come in batches before the outcome, which then has the rest of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stream: Option<Stream>,
    /// [`Extension::Digest`]: a digest will do for an answer.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    #[schemars(default)]
    pub digest: bool,
    /// [`Extension::LiveOperator`]: the places of the operator's events, which are not in the scenario then.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default)]
    pub live: Vec<RunPoint>,
}

/// What may be streamed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Stream {
    /// How many batches may come before more are allowed by `credit`.
    pub credit: u32,
}

/// What is in force between runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ControllerState {
    /// Settings in force.
    pub settings: Settings,
    /// The state, where there is one to tell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<State>,
    /// Numbered parameters that are not zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parameters: Option<Indexed<u32, f64>>,
}

/// What the adapter answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "form::Answer")]
#[schemars(!try_from)]
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
    /// To `reset`, `cancel` and `bye`.
    Done {},
    /// To `run` and `outcome`: what was observed.
    Outcome(Box<Outcome>),
    /// To `run` and `outcome`: the name of a file in the folder of `hello`, which holds the outcome as it would stand
    /// in the line; to `move`: one which holds samples in either form.
    File(String),
    /// To `move`: samples as a table of text.
    Samples(String),
    /// To `shows`: what is observed; more than the declaration says is not judged.
    Shows(Box<Observables>),
    /// To `state`: what is in force.
    State(Box<ControllerState>),
    /// To `run`, before the answer proper: a batch of its steps.
    Steps(Vec<Step>),
    /// To `run`, before the answer proper: the controller is at this place of those in `live`, counted from 0.
    At(u32),
    /// To `run`: the digest of the outcome, which can be asked for.
    Digest(String),
    /// To `run`: the controller does not have what this scenario needs, and why. Nothing was run. It counts as
    /// unsupported.
    Unsupported(String),
    /// To anything: the adapter does not know this operation, or could not do it, and why. It is never a verdict on
    /// the controller.
    Refused(String),
}

impl Reply {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Hello(_) => "hello",
            Self::Done {} => "done",
            Self::Outcome(_) => "outcome",
            Self::File(_) => "file",
            Self::Samples(_) => "samples",
            Self::Shows(_) => "shows",
            Self::State(_) => "state",
            Self::Steps(_) => "steps",
            Self::At(_) => "at",
            Self::Digest(_) => "digest",
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
    let mut schema = identified::<Answer>("answer");
    schema::admit_not_finite(&mut schema, &["Clock", "Declaration", "Observables"]);
    schema
}

fn identified<T: JsonSchema>(name: &str) -> Schema {
    let mut schema = schema_for!(T);
    schema.insert("$id".to_owned(), format!("urn:gaugeblock:adapter:{name}:{VERSION}").into());
    schema
}
