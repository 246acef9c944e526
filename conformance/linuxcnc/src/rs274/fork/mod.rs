//! Runs without a start each: the controller is started once, and forked for each run.
//!
//! A small library, `server.c`, is loaded into the controller. It stops it where it has started and has read nothing of
//! a case but its tool table, and serves forks from there (`server`). What a fork does depends on nothing else that
//! the controller did before; that it does the same as a controller of its own is checked by each run of the suite,
//! since a sample of the programs is run on such controllers too.

mod server;

use std::io;
use std::path::Path;
use std::process::ExitStatus;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use gaugeblock_adapter::clock::now;
use rustix::process::{Pid, Signal, kill_process_group};

use super::command::Started;
use super::streams::Streams;
use crate::instrumentation::workspace::Workspace;
pub(super) use server::Start;
use server::{Answer, PATIENCE, Server};

/// The library, as the build script made it; nothing where it could not.
const LIBRARY: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/fork-server.so"));

/// The file of the library in its folder.
const NAME: &str = "fork-server.so";

/// How many servers are kept at rest. They differ in what the controller was started with.
const AT_REST: usize = 12;

/// Controllers that have started.
#[derive(Debug)]
pub(super) struct Servers {
    library: io::Result<Workspace>,
    at_rest: Mutex<Vec<(Start, Server)>>,
    failed: Mutex<Vec<(Start, String)>>,
}

/// A run's process, forked from a controller that had started before.
#[derive(Debug)]
pub(super) struct Fork<'a> {
    servers: &'a Servers,
    start: Start,
    server: Server,
    group: Pid,
    status: Option<ExitStatus>,
}

impl Servers {
    /// None yet.
    pub(super) fn new() -> Self {
        Self { library: library(), at_rest: Mutex::default(), failed: Mutex::default() }
    }

    /// Begins a run in `directory` on a controller that has started so, if there can be one.
    pub(super) fn run(
        &self,
        program: Started<'_>,
        start: &Start,
        directory: &Path,
    ) -> Option<(Fork<'_>, Streams)> {
        if lock(&self.failed).iter().any(|(failed, _)| failed == start) {
            return None;
        }
        // One that has died at rest is replaced.
        let rested = self.rested(start).and_then(|server| self.fork(server, start, directory).ok());
        rested.or_else(|| {
            let fresh = self.start(program, start);
            match fresh.and_then(|server| self.fork(server, start, directory)) {
                Ok(forked) => Some(forked),
                Err(error) => {
                    lock(&self.failed).push((start.clone(), why(&error)));
                    None
                }
            }
        })
    }

    /// Why some or all runs have a controller of their own, in a sentence; nothing if all went well.
    pub(super) fn trouble(&self) -> Option<String> {
        let failed = lock(&self.failed);
        let (_, why) = failed.first()?;
        Some(format!("slow: some or all programs were started and not forked, since {why}"))
    }

    fn start(&self, program: Started<'_>, start: &Start) -> io::Result<Server> {
        match &self.library {
            Ok(library) => Server::start(program, &library.path().join(NAME), start),
            Err(error) => Err(io::Error::new(error.kind(), error.to_string())),
        }
    }

    fn fork(
        &self,
        mut server: Server,
        start: &Start,
        directory: &Path,
    ) -> io::Result<(Fork<'_>, Streams)> {
        let (streams, ends) = Streams::new()?;
        let group = server.fork(directory, &ends)?;
        let fork = Fork { servers: self, start: start.clone(), server, group, status: None };
        Ok((fork, streams))
    }

    /// Takes a server that has started so.
    fn rested(&self, start: &Start) -> Option<Server> {
        let mut at_rest = lock(&self.at_rest);
        let place = at_rest.iter().rposition(|(started, _)| started == start)?;
        Some(at_rest.remove(place).1)
    }

    /// Keeps a server, at the expense of the one that rests longest.
    fn rest(&self, start: Start, server: Server) {
        let mut at_rest = lock(&self.at_rest);
        at_rest.push((start, server));
        let longest = (at_rest.len() > AT_REST).then(|| at_rest.remove(0));
        drop(at_rest);
        drop(longest);
    }
}

impl Fork<'_> {
    /// Whether it exits in time.
    pub(super) fn exits(&mut self, deadline: Instant) -> bool {
        let left = deadline.saturating_duration_since(now());
        if let Ok(Answer::Ended(status)) = self.server.answer(left) {
            self.status = Some(status);
        }
        self.status.is_some()
    }

    /// Kills it, if it still runs, with all of its processes.
    ///
    /// # Errors
    /// Its server is gone.
    pub(super) fn end(mut self) -> io::Result<ExitStatus> {
        match self.let_go() {
            Ok(status) => {
                self.servers.rest(self.start, self.server);
                Ok(status)
            }
            Err(error) => {
                // Nobody has waited for it, so that its number still is its group's.
                let _gone = kill_process_group(self.group, Signal::KILL);
                Err(error)
            }
        }
    }

    fn let_go(&mut self) -> io::Result<ExitStatus> {
        self.server.let_go()?;
        match self.status {
            Some(status) => Ok(status),
            None => match self.server.answer(PATIENCE)? {
                Answer::Ended(status) => Ok(status),
                Answer::Ready | Answer::Begun(_) => Err(io::ErrorKind::InvalidData.into()),
            },
        }
    }
}

/// Why a start cannot be forked, for a person.
fn why(error: &io::Error) -> String {
    let silent = [io::ErrorKind::WouldBlock, io::ErrorKind::TimedOut];
    if error.kind() == io::ErrorKind::UnexpectedEof {
        "it ended before it could be forked".to_owned()
    } else if silent.contains(&error.kind()) {
        format!("it could not be forked after {} s", PATIENCE.as_secs())
    } else {
        error.to_string()
    }
}

fn library() -> io::Result<Workspace> {
    if LIBRARY.is_empty() {
        return Err(io::Error::other("it was built without a C compiler, or not for Linux"));
    }
    let folder = Workspace::new("rs274").map_err(io::Error::other)?;
    // The loader takes a list that these would end.
    if folder.path().to_string_lossy().contains([' ', ':']) {
        return Err(io::Error::other("the path of temporary files has a blank or colon"));
    }
    folder.write(NAME, LIBRARY).map_err(io::Error::other)?;
    Ok(folder)
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests;
