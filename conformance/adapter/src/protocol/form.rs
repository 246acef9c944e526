//! The form of requests and answers in a line. They are parsed in one pass, so that an error has its place.

use gaugeblock_vocabulary::motion::{MotionLimits, MotionScript};
use gaugeblock_vocabulary::scenario::{OperatorEvent, RunPoint};
use gaugeblock_vocabulary::{Outcome, Scenario, Step};
use serde::Deserialize;

use super::{ControllerState, Declaration, Observables, Operation, Reply, RunModes, Stream};

/// A request with any operation. Unknown members are ignored: later versions may add some.
#[derive(Debug, Deserialize)]
pub(super) struct Request {
    id: u64,
    op: String,
    protocol: Option<u32>,
    referee: Option<String>,
    folder: Option<String>,
    scenario: Option<Box<Scenario>>,
    stream: Option<Stream>,
    #[serde(default)]
    digest: bool,
    #[serde(default)]
    live: Vec<RunPoint>,
    limits: Option<MotionLimits>,
    script: Option<MotionScript>,
    every: Option<u32>,
    batches: Option<u32>,
    event: Option<OperatorEvent>,
}

impl TryFrom<Request> for super::Request {
    type Error = String;

    fn try_from(form: Request) -> Result<Self, String> {
        let Request { id, op, scenario, .. } = form;
        let lacks = |what: &str| format!("`{op}` lacks `{what}`");
        let operation = match op.as_str() {
            "hello" => Operation::Hello {
                protocol: form.protocol.ok_or_else(|| lacks("protocol"))?,
                referee: form.referee.ok_or_else(|| lacks("referee"))?,
                folder: form.folder,
            },
            "reset" => Operation::Reset {},
            "run" => Operation::Run {
                scenario: scenario.ok_or_else(|| lacks("scenario"))?,
                modes: RunModes { stream: form.stream, digest: form.digest, live: form.live },
            },
            "move" => Operation::Move {
                scenario: scenario.ok_or_else(|| lacks("scenario"))?,
                limits: form.limits.ok_or_else(|| lacks("limits"))?,
                script: form.script.ok_or_else(|| lacks("script"))?,
                every: form.every,
            },
            "shows" => Operation::Shows { scenario: scenario.ok_or_else(|| lacks("scenario"))? },
            "cancel" => Operation::Cancel {},
            "state" => Operation::State {},
            "credit" => {
                Operation::Credit { batches: form.batches.ok_or_else(|| lacks("batches"))? }
            }
            "operator" => Operation::Operator { event: form.event.ok_or_else(|| lacks("event"))? },
            "outcome" => Operation::Outcome {},
            "bye" => Operation::Bye {},
            _ => return Err(format!("unknown operation `{op}`")),
        };
        Ok(Self { id, operation })
    }
}

/// Any answer. Unknown members are ignored: later versions may add some.
#[derive(Debug, Deserialize)]
pub(super) struct Answer {
    id: u64,
    hello: Option<Box<Declaration>>,
    done: Option<Done>,
    outcome: Option<Box<Outcome>>,
    file: Option<String>,
    samples: Option<String>,
    shows: Option<Box<Observables>>,
    state: Option<Box<ControllerState>>,
    steps: Option<Vec<Step>>,
    at: Option<u32>,
    digest: Option<String>,
    unsupported: Option<String>,
    refused: Option<String>,
}

#[derive(Debug, Deserialize)]
struct Done {}

impl TryFrom<Answer> for super::Answer {
    type Error = String;

    fn try_from(form: Answer) -> Result<Self, String> {
        let Answer { id, .. } = form;
        let replies = [
            form.hello.map(Reply::Hello),
            form.done.map(|Done {}| Reply::Done {}),
            form.outcome.map(Reply::Outcome),
            form.file.map(Reply::File),
            form.samples.map(Reply::Samples),
            form.shows.map(Reply::Shows),
            form.state.map(Reply::State),
            form.steps.map(Reply::Steps),
            form.at.map(Reply::At),
            form.digest.map(Reply::Digest),
            form.unsupported.map(Reply::Unsupported),
            form.refused.map(Reply::Refused),
        ];
        let mut replies = replies.into_iter().flatten();
        match (replies.next(), replies.next()) {
            (Some(reply), None) => Ok(Self { id, reply }),
            (Some(one), Some(other)) => {
                Err(format!("it answers `{}` and `{}` at once", one.name(), other.name()))
            }
            (None, _) => {
                Err("it has none of `hello`, `done`, `outcome`, `unsupported`, `refused`"
                    .to_owned())
            }
        }
    }
}
