//! Requests in the order of arrival, and runs that can be abandoned.

use std::collections::VecDeque;
use std::io::{BufRead, Error, ErrorKind, Read as _, Result};
use std::sync::mpsc::{Receiver, Sender, channel};

use gaugeblock_vocabulary::scenario::{Budget, Environment, OperatorEvent};
use gaugeblock_vocabulary::{Machine, Options, Program};
use serde::Deserialize;
use serde_json::value::RawValue;

use super::super::{Operation, Request, RunModes, Stream};

/// The source of requests.
pub(super) enum Requests {
    /// Read on demand: a run ends before the next request is read.
    InTurn(Lines),
    /// Read on arrival, so that a run can be cancelled.
    AtOnce {
        /// Lines, up to the end of the stream.
        lines: Receiver<Arrival>,
        /// Sender for the next run.
        ended: Sender<Arrival>,
        /// Lines that arrived during a run.
        waiting: VecDeque<Vec<u8>>,
    },
}

/// Lines of a stream.
pub(super) struct Lines {
    stream: Box<dyn BufRead + Send>,
    longest: u64,
}

/// What arrives while requests are read on arrival.
pub(super) enum Arrival {
    /// A request.
    Line(Result<Vec<u8>>),
    /// The end of the stream.
    EndOfStream,
    /// A run has ended and has left its result.
    RunEnded,
}

/// How a run ended.
pub(super) enum RunResult<T> {
    /// With a result.
    Done(T),
    /// Cancelled by the request of this id.
    Cancelled(u64),
    /// The session has ended.
    SessionEnded,
}

impl Requests {
    /// Requests of a stream, of at most `longest` bytes each.
    pub(super) fn of(stream: Box<dyn BufRead + Send>, longest: u64, can_cancel: bool) -> Self {
        let mut source = Lines { stream, longest };
        if !can_cancel {
            return Self::InTurn(source);
        }
        let (sender, lines) = channel();
        let ended = sender.clone();
        // It ends with the stream. If the session ends before, the owner of the stream ends it.
        std::thread::spawn(move || {
            loop {
                let arrival = match source.next() {
                    Ok(Some(line)) => Arrival::Line(Ok(line)),
                    Ok(None) => Arrival::EndOfStream,
                    Err(error) => Arrival::Line(Err(error)),
                };
                let goes_on = matches!(arrival, Arrival::Line(Ok(_)));
                if sender.send(arrival).is_err() || !goes_on {
                    return;
                }
            }
        });
        Self::AtOnce { lines, ended, waiting: VecDeque::new() }
    }

    /// The next line that is not blank.
    pub(super) fn next(&mut self) -> Result<Option<Vec<u8>>> {
        match self {
            Self::InTurn(source) => source.next(),
            Self::AtOnce { lines, waiting, .. } => {
                if let Some(line) = waiting.pop_front() {
                    return Ok(Some(line));
                }
                loop {
                    match lines.recv() {
                        Ok(Arrival::Line(line)) => return line.map(Some),
                        Ok(Arrival::EndOfStream) | Err(_) => return Ok(None),
                        // The end of a cancelled run.
                        Ok(Arrival::RunEnded) => (),
                    }
                }
            }
        }
    }

    /// Runs work that takes time.
    pub(super) fn run<T: Send + 'static>(
        &mut self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<RunResult<T>> {
        let Self::AtOnce { lines, ended, waiting } = self else {
            return Ok(RunResult::Done(work()));
        };
        let (result, results) = channel();
        let ended = ended.clone();
        std::thread::spawn(move || {
            // Without a receiver it was cancelled.
            let _left = result.send(work());
            let _told = ended.send(Arrival::RunEnded);
        });
        loop {
            match lines.recv() {
                Ok(Arrival::Line(line)) => {
                    let line = line?;
                    match read(&line) {
                        Ok(Request { id, operation: Operation::Cancel {} }) => {
                            return Ok(RunResult::Cancelled(id));
                        }
                        _ => waiting.push_back(line),
                    }
                }
                Ok(Arrival::EndOfStream) | Err(_) => return Ok(RunResult::SessionEnded),
                // It may be the end of a cancelled run.
                Ok(Arrival::RunEnded) => {
                    if let Ok(result) = results.try_recv() {
                        return Ok(RunResult::Done(result));
                    }
                }
            }
        }
    }
}

/// Parses a request. An error has the id, if there is one, and what is wrong.
pub(super) fn read(line: &[u8]) -> std::result::Result<Request, (u64, String)> {
    #[derive(Deserialize)]
    struct Id {
        id: u64,
    }
    serde_json::from_slice(line).map_err(|error| {
        let id = serde_json::from_slice(line).map_or(0, |Id { id }| id);
        (id, format!("not understood: {error}"))
    })
}

/// Parses requests. Most of them run a program with the options of the previous one.
#[derive(Debug, Default)]
pub(super) struct Reader {
    /// The text of the last options, and their value.
    last: (String, Options),
}

impl Reader {
    /// Parses a request. An error has the id, if there is one, and what is wrong.
    pub(super) fn read(&mut self, line: &[u8]) -> std::result::Result<Request, (u64, String)> {
        self.run(line).map_or_else(|| read(line), Ok)
    }

    /// Fast path of [`read`] for a plain request to run a scenario.
    fn run(&mut self, line: &[u8]) -> Option<Request> {
        let Run { id, op: Op::Run, scenario, stream, digest } =
            serde_json::from_slice(line).ok()?;
        let Scenario { program, options, machine, environment, operator, budget } = scenario;
        let options = match options.map(RawValue::get) {
            None => Options::default(),
            Some(text) if text == self.last.0 => self.last.1.clone(),
            Some(text) => {
                self.last = (text.to_owned(), serde_json::from_str(text).ok()?);
                self.last.1.clone()
            }
        };
        let scenario = gaugeblock_vocabulary::Scenario {
            program,
            options,
            machine,
            environment,
            operator,
            budget,
        };
        let modes = RunModes { stream, digest, live: Vec::new() };
        Some(Request { id, operation: Operation::Run { scenario: Box::new(scenario), modes } })
    }
}

/// The form of most requests. Others are parsed as [`Request`].
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Run<'a> {
    id: u64,
    op: Op,
    #[serde(borrow)]
    scenario: Scenario<'a>,
    stream: Option<Stream>,
    #[serde(default)]
    digest: bool,
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum Op {
    Run,
}

/// A scenario whose options are not parsed.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Scenario<'a> {
    #[serde(default)]
    program: Program,
    #[serde(borrow)]
    options: Option<&'a RawValue>,
    #[serde(default)]
    machine: Machine,
    #[serde(default)]
    environment: Environment,
    #[serde(default)]
    operator: Vec<OperatorEvent>,
    #[serde(default)]
    budget: Budget,
}

impl Lines {
    /// The next line that is not blank.
    fn next(&mut self) -> Result<Option<Vec<u8>>> {
        let mut line = Vec::new();
        loop {
            line.clear();
            let mut limited = self.stream.as_mut().take(self.longest);
            if limited.read_until(b'\n', &mut line)? == 0 {
                return Ok(None);
            }
            if limited.limit() == 0 && line.last() != Some(&b'\n') {
                let why = format!("a request of more than {} bytes", self.longest);
                return Err(Error::new(ErrorKind::InvalidData, why));
            }
            if !line.trim_ascii().is_empty() {
                return Ok(Some(line));
            }
        }
    }
}
