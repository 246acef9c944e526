//! The other end of a session: a process that was started here, or a server at an address.

use std::fs::File;
use std::io::pipe;
use std::net::{TcpStream, ToSocketAddrs};
use std::os::fd::OwnedFd;
use std::time::Duration;

use super::limits::Limits;
use super::lines::Lines;
use super::process::Process;
use crate::HarnessError;

/// How long a controller may take to exit after its output has ended or after `bye`.
pub(super) const GRACE: Duration = Duration::from_millis(500);

/// How a controller is reached.
#[derive(Clone, Debug)]
pub(super) enum Endpoint {
    /// A shell command that is started as a process.
    Command(String),
    /// An address at which an adapter listens: `HOST:PORT`.
    Address(String),
}

/// The other end of a session.
#[derive(Debug)]
pub(super) enum Connection {
    /// It was started for the session, and ends with it.
    Process(Process),
    /// A server. It runs on when the connection is closed.
    Socket,
}

impl Endpoint {
    /// Starts the command, or connects.
    pub(super) fn open(&self, limits: Limits) -> Result<(Connection, Lines), HarnessError> {
        match self {
            Self::Command(command) => start(command, limits),
            Self::Address(address) => connect(address, limits),
        }
    }
}

impl Connection {
    /// Whether the process has ended, judged without its output.
    pub(super) fn is_gone(&mut self) -> bool {
        match self {
            Self::Process(process) => process.ends_within(Duration::ZERO).is_some(),
            Self::Socket => false,
        }
    }

    /// Gives the process time to exit.
    pub(super) fn wait_for_end(&mut self) {
        if let Self::Process(process) = self {
            let _status = process.ends_within(GRACE);
        }
    }

    /// How it ended, after its output has ended.
    pub(super) fn describe_end(&mut self) -> String {
        match self {
            Self::Process(process) => process
                .ends_within(GRACE)
                .unwrap_or_else(|| "its output ended, and it runs on".to_owned()),
            Self::Socket => "the connection was closed".to_owned(),
        }
    }
}

fn start(command: &str, limits: Limits) -> Result<(Connection, Lines), HarnessError> {
    let (input, our_input) = pipe().map_err(not_run)?;
    let (our_output, output) = pipe().map_err(not_run)?;
    let (our_errors, errors) = pipe().map_err(not_run)?;
    let process = Process::start(command, (input, output, errors), limits).map_err(not_run)?;
    let file = |end: OwnedFd| File::from(end);
    let lines =
        Lines::new(file(our_input.into()), file(our_output.into()), Some(file(our_errors.into())))?;
    Ok((Connection::Process(process), lines))
}

fn connect(address: &str, limits: Limits) -> Result<(Connection, Lines), HarnessError> {
    let no_connection = |error: std::io::Error| {
        HarnessError::NotRun(format!("no connection to {address}: {error}"))
    };
    let mut stream = Err(std::io::ErrorKind::NotFound.into());
    for place in address.to_socket_addrs().map_err(no_connection)? {
        stream = TcpStream::connect_timeout(&place, limits.start);
        if stream.is_ok() {
            break;
        }
    }
    let stream = stream.map_err(no_connection)?;
    // Each line is a whole request: waiting for more would only add latency.
    let _where_it_can_be_had = stream.set_nodelay(true);
    let output = stream.try_clone().map_err(no_connection)?;
    let lines =
        Lines::new(File::from(OwnedFd::from(stream)), File::from(OwnedFd::from(output)), None)?;
    Ok((Connection::Socket, lines))
}

fn not_run(error: std::io::Error) -> HarnessError {
    HarnessError::NotRun(error.to_string())
}
