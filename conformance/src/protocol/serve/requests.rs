//! Requests as they come, and runs that can be left where they are.

use std::collections::VecDeque;
use std::io::{BufRead, Result};
use std::sync::mpsc::{Receiver, Sender, channel};

use super::super::{Operation, Request};

/// Where requests come from.
pub(super) enum Requests {
    /// They are read when they are wanted: a run is over before the next one is seen.
    InTurn(Box<dyn BufRead + Send>),
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
    /// Requests of a stream.
    pub(super) fn of(mut stream: Box<dyn BufRead + Send>, can_cancel: bool) -> Self {
        if !can_cancel {
            return Self::InTurn(stream);
        }
        let (sender, lines) = channel();
        let ended = sender.clone();
        // It ends with the stream; where the session ends before, whoever holds the stream ends it.
        std::thread::spawn(move || {
            loop {
                let came = match line(stream.as_mut()) {
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
            Self::InTurn(stream) => line(stream.as_mut()),
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
    #[derive(serde::Deserialize)]
    struct Id {
        id: u64,
    }
    serde_json::from_slice(line).map_err(|error| {
        let id = serde_json::from_slice(line).map_or(0, |Id { id }| id);
        (id, format!("not understood: {error}"))
    })
}

/// The next line that is not blank.
fn line(stream: &mut (dyn BufRead + Send)) -> Result<Option<Vec<u8>>> {
    let mut line = Vec::new();
    loop {
        line.clear();
        if stream.read_until(b'\n', &mut line)? == 0 {
            return Ok(None);
        }
        if !line.trim_ascii().is_empty() {
            return Ok(Some(line));
        }
    }
}
