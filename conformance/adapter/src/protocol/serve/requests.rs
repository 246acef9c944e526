//! Requests as they come, and runs that can be left where they are.

use std::collections::VecDeque;
use std::io::{BufRead, Error, ErrorKind, Read as _, Result};
use std::sync::mpsc::{Receiver, Sender, channel};

use gaugeblock_vocabulary::scenario::{Budget, Environment, OperatorEvent};
use gaugeblock_vocabulary::{Machine, Options, Program};
use serde::Deserialize;
use serde_json::value::RawValue;

use super::super::{Operation, Request, RunModes, Stream};

/// Where requests come from.
pub(super) enum Requests {
    /// They are read when they are wanted: a run is over before the next one is seen.
    InTurn(Lines),
    /// They are read as they come, so that a run can be cancelled.
    AtOnce {
        /// Lines, until there are no more.
        lines: Receiver<Came>,
        /// For the next run.
        ended: Sender<Came>,
        /// Lines that came while something ran.
        waiting: VecDeque<Vec<u8>>,
    },
}

/// Lines of a stream.
pub(super) struct Lines {
    stream: Box<dyn BufRead + Send>,
    longest: u64,
}

/// What comes while requests are read as they come.
pub(super) enum Came {
    /// A request.
    Line(Result<Vec<u8>>),
    /// There are no more requests.
    NoMore,
    /// A run is over, and has left its result.
    Over,
}

/// What became of a run.
pub(super) enum Ran<T> {
    /// It is over.
    Done(T),
    /// It was cancelled, by the request of this id.
    Cancelled(u64),
    /// Nobody waits for it any more.
    Alone,
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
        // It ends with the stream; where the session ends before, whoever holds the stream ends it.
        std::thread::spawn(move || {
            loop {
                let came = match source.next() {
                    Ok(Some(line)) => Came::Line(Ok(line)),
                    Ok(None) => Came::NoMore,
                    Err(error) => Came::Line(Err(error)),
                };
                let goes_on = matches!(came, Came::Line(Ok(_)));
                if sender.send(came).is_err() || !goes_on {
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
                        Ok(Came::Line(line)) => return line.map(Some),
                        Ok(Came::NoMore) | Err(_) => return Ok(None),
                        // Of a run that was cancelled.
                        Ok(Came::Over) => (),
                    }
                }
            }
        }
    }

    /// Does something that takes time.
    pub(super) fn run<T: Send + 'static>(
        &mut self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<Ran<T>> {
        let Self::AtOnce { lines, ended, waiting } = self else { return Ok(Ran::Done(work())) };
        let (result, results) = channel();
        let ended = ended.clone();
        std::thread::spawn(move || {
            // Where nobody waits any more it was cancelled.
            let _left = result.send(work());
            let _told = ended.send(Came::Over);
        });
        loop {
            match lines.recv() {
                Ok(Came::Line(line)) => {
                    let line = line?;
                    match read(&line) {
                        Ok(Request { id, operation: Operation::Cancel {} }) => {
                            return Ok(Ran::Cancelled(id));
                        }
                        _ => waiting.push_back(line),
                    }
                }
                Ok(Came::NoMore) | Err(_) => return Ok(Ran::Alone),
                // It may be that of a run that was cancelled.
                Ok(Came::Over) => {
                    if let Ok(result) = results.try_recv() {
                        return Ok(Ran::Done(result));
                    }
                }
            }
        }
    }
}

/// A request, or the id of what is none and what is wrong with it.
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

/// Reads requests, most of which are to run a program under the options of the one before.
#[derive(Debug, Default)]
pub(super) struct Reader {
    /// The text of the last options, and what it says.
    last: (String, Options),
}

impl Reader {
    /// A request, or the id of what is none and what is wrong with it.
    pub(super) fn read(&mut self, line: &[u8]) -> std::result::Result<Request, (u64, String)> {
        self.run(line).map_or_else(|| read(line), Ok)
    }

    /// A plain request to run something.
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
        let ways = RunModes { stream, digest, live: Vec::new() };
        Some(Request { id, operation: Operation::Run { scenario: Box::new(scenario), ways } })
    }
}

/// A request as most of them are. Any other one is read as [`Request`].
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

/// A scenario whose options have not been read.
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
