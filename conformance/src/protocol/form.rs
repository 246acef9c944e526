//! Requests and answers as they stand in a line: read in one pass, and what is wrong is told with its place.

use gaugeblock_trace::{Outcome, Scenario};
use schemars::JsonSchema;
use serde::Deserialize;

use super::{Declaration, Operation, Reply};

/// A request, whatever it asks. What else stands in it is left for later versions.
#[derive(Debug, Deserialize, JsonSchema)]
pub(super) struct Request {
    id: u64,
    op: String,
    protocol: Option<u32>,
    referee: Option<String>,
    scenario: Option<Box<Scenario>>,
}

impl TryFrom<Request> for super::Request {
    type Error = String;

    fn try_from(form: Request) -> Result<Self, String> {
        let Request { id, op, protocol, referee, scenario } = form;
        let lacks = |what: &str| format!("`{op}` lacks `{what}`");
        let operation = match op.as_str() {
            "hello" => Operation::Hello {
                protocol: protocol.ok_or_else(|| lacks("protocol"))?,
                referee: referee.ok_or_else(|| lacks("referee"))?,
            },
            "reset" => Operation::Reset {},
            "run" => Operation::Run { scenario: scenario.ok_or_else(|| lacks("scenario"))? },
            "bye" => Operation::Bye {},
            _ => return Err(format!("unknown operation `{op}`")),
        };
        Ok(Self { id, operation })
    }
}

/// An answer, whatever it says. What else stands in it is left for later versions.
#[derive(Debug, Deserialize, JsonSchema)]
pub(super) struct Answer {
    id: u64,
    hello: Option<Box<Declaration>>,
    done: Option<Done>,
    outcome: Option<Box<Outcome>>,
    unsupported: Option<String>,
    refused: Option<String>,
}

#[derive(Debug, Deserialize, JsonSchema)]
struct Done {}

impl TryFrom<Answer> for super::Answer {
    type Error = String;

    fn try_from(form: Answer) -> Result<Self, String> {
        let Answer { id, hello, done, outcome, unsupported, refused } = form;
        let replies = [
            hello.map(Reply::Hello),
            done.map(|Done {}| Reply::Done {}),
            outcome.map(Reply::Outcome),
            unsupported.map(Reply::Unsupported),
            refused.map(Reply::Refused),
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
