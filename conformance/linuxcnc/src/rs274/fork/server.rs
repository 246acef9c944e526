//! A controller that has started, and forks on request.

use std::ffi::OsString;
use std::io::{self, IoSlice, Read, Write};
use std::mem::MaybeUninit;
use std::os::fd::{AsFd, OwnedFd};
use std::os::unix::ffi::OsStrExt;
use std::os::unix::net::UnixStream;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, ExitStatus, Stdio};
use std::time::Duration;

use rustix::net::{SendAncillaryBuffer, SendAncillaryMessage, SendFlags, sendmsg};
use rustix::process::Pid;

use crate::instrumentation::workspace::{TOOLS, Workspace};
use crate::rs274::command::Started;
use crate::rs274::streams::Ends;

/// All that a controller reads before it forks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::rs274) struct Start {
    /// Arguments.
    pub(in crate::rs274) arguments: Vec<OsString>,
    /// The text of the tool table.
    pub(in crate::rs274) tools: String,
}

/// How long the server may take to start, or to give an answer that depends only on itself.
pub(super) const PATIENCE: Duration = Duration::from_secs(5);

/// The server, ended when it is dropped, with all its forks.
#[derive(Debug)]
pub(super) struct Server {
    child: Child,
    control: UnixStream,
    /// What it read when it started.
    _home: Workspace,
}

/// Its answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    /// It can fork.
    Ready,
    /// A fork has begun, and leads a group of this number.
    Begun(Pid),
    /// It ended, with this status.
    Ended(ExitStatus),
}

impl Server {
    /// Starts the program with the library, as far as the program can be started without a case.
    ///
    /// # Errors
    /// It did not start, or not in time, or did not reach the point where it forks.
    pub(super) fn start(program: Started<'_>, library: &Path, start: &Start) -> io::Result<Self> {
        let home = Workspace::in_memory("rs274").map_err(io::Error::other)?;
        home.write(TOOLS, &start.tools).map_err(io::Error::other)?;
        let (control, theirs) = UnixStream::pair()?;
        let mut command = program.command(&start.arguments, home.path());
        // Bound once, its functions need not be bound by each fork.
        command.env("LD_PRELOAD", library).env("LD_BIND_NOW", "1");
        command.stdin(OwnedFd::from(theirs)).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut server = Self { child: command.spawn()?, control, _home: home };
        drop(command);
        match server.answer(PATIENCE)? {
            Answer::Ready => Ok(server),
            Answer::Begun(_) | Answer::Ended(_) => Err(io::ErrorKind::InvalidData.into()),
        }
    }

    /// Has it fork, in this folder and with these streams: the number of the fork's group.
    ///
    /// # Errors
    /// It is gone, or could not.
    pub(super) fn fork(&mut self, directory: &Path, ends: &Ends) -> io::Result<Pid> {
        let streams = [ends.input.as_fd(), ends.output.as_fd(), ends.errors.as_fd()];
        let mut space = [MaybeUninit::uninit(); rustix::cmsg_space!(ScmRights(3))];
        let mut passed = SendAncillaryBuffer::new(&mut space);
        if !passed.push(SendAncillaryMessage::ScmRights(&streams)) {
            return Err(io::ErrorKind::OutOfMemory.into());
        }
        let folder = [IoSlice::new(directory.as_os_str().as_bytes())];
        sendmsg(&self.control, &folder, &mut passed, SendFlags::NOSIGNAL)?;
        match self.answer(PATIENCE)? {
            Answer::Begun(group) => Ok(group),
            Answer::Ready | Answer::Ended(_) => Err(io::ErrorKind::InvalidData.into()),
        }
    }

    /// Reads its next answer.
    ///
    /// # Errors
    /// It has ended, or does not answer in this time.
    pub(super) fn answer(&mut self, within: Duration) -> io::Result<Answer> {
        self.control.set_read_timeout(Some(within.max(Duration::from_micros(1))))?;
        let mut message = [[0; 4]; 2];
        self.control.read_exact(message.as_flattened_mut())?;
        let [kind, number] = message.map(i32::from_ne_bytes);
        let kind = u8::try_from(kind).unwrap_or_default();
        match (kind, Pid::from_raw(number)) {
            (b'R', None) => Ok(Answer::Ready),
            (b'B', Some(group)) => Ok(Answer::Begun(group)),
            (b'E', _) => Ok(Answer::Ended(ExitStatus::from_raw(number))),
            _ => Err(io::ErrorKind::InvalidData.into()),
        }
    }

    /// Kills the fork, if it still runs, with all of its processes.
    ///
    /// # Errors
    /// The server is gone.
    pub(super) fn let_go(&mut self) -> io::Result<()> {
        self.control.write_all(b".")
    }
}

impl Server {
    /// Ends it. Its forks end with it.
    pub(super) fn kill(&mut self) {
        // If it is gone already, that is what we want.
        let _gone = self.child.kill();
        let _status = self.child.wait();
    }

    /// Leaves it to itself, as the end of this process does.
    #[cfg(test)]
    pub(super) fn hang_up(&self) {
        self.control.shutdown(std::net::Shutdown::Both).expect("the socket is open");
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.kill();
    }
}
