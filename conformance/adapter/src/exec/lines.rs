//! Writes and reads lines on streams that may hang, flood or end at any moment.

use std::fmt;
use std::fs::File;
use std::io::{BufRead, ErrorKind, Read, Write};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::ioctl_fionbio;

use crate::HarnessError;
use crate::clock::now;
use crate::protocol::SpinWait;

/// Bytes of standard error that are kept: its end.
const STDERR_TAIL_BYTES: usize = 4096;

/// Bytes per read.
const READ_BYTES: usize = 64 << 10;

/// How often a wait checks whether the process is still alive.
const LIVENESS_INTERVAL: Duration = Duration::from_millis(50);

/// Why no line was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ReadLineError {
    /// The stream ended.
    Ended,
    /// Not in time. The flag says whether the request was written completely.
    Late(bool),
    /// More bytes than allowed without an end of line.
    TooLong,
}

/// The result of a wait.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum WaitResult {
    /// Nothing is ready.
    TimedOut,
    /// A stream is ready.
    Ready {
        /// Whether the output can be read, or has ended.
        output: bool,
    },
}

/// The streams of a session.
pub(super) struct Lines {
    input: File,
    output: File,
    /// Standard error, if there is one.
    errors: Option<File>,
    /// Bytes that were read and not yet returned.
    read: Vec<u8>,
    /// How many of them contain no end of line.
    scanned: usize,
    /// Length of the last line that was returned.
    last_line_length: usize,
    /// The end of standard error.
    stderr: Vec<u8>,
    /// Whether the output has ended.
    ended: bool,
    spin_wait: SpinWait,
    /// Buffer for one read.
    buffer: Box<[u8]>,
}

impl fmt::Debug for Lines {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes not taken", self.read.len())
    }
}

impl Lines {
    /// Takes the referee's ends of the streams.
    ///
    /// # Errors
    /// They cannot be made non-blocking.
    pub(super) fn new(
        input: File,
        output: File,
        errors: Option<File>,
    ) -> Result<Self, HarnessError> {
        for stream in [Some(&input), Some(&output), errors.as_ref()].into_iter().flatten() {
            ioctl_fionbio(stream, true).map_err(|error| HarnessError::NotRun(error.to_string()))?;
        }
        Ok(Self {
            input,
            output,
            errors,
            read: Vec::new(),
            scanned: 0,
            last_line_length: 0,
            stderr: Vec::new(),
            ended: false,
            spin_wait: SpinWait::default(),
            buffer: vec![0; READ_BYTES].into_boxed_slice(),
        })
    }

    /// Bytes that have arrived without a request.
    pub(super) fn unrequested(&mut self) -> Option<&[u8]> {
        self.receive(1);
        self.surplus()
    }

    /// Bytes that arrived after the last line.
    pub(super) fn surplus(&self) -> Option<&[u8]> {
        (!self.read.is_empty()).then_some(self.read.as_slice())
    }

    /// Whether the output has ended.
    pub(super) fn has_ended(&self) -> bool {
        self.ended
    }

    /// Writes as much of a line as the stream takes, and returns the rest.
    pub(super) fn write_line(&mut self, line: &[u8]) -> Vec<u8> {
        let mut unsent = line;
        // If the stream is closed, the next read notices.
        let _is_open = self.send(&mut unsent);
        unsent.to_vec()
    }

    /// Writes a line, which may be empty, and reads one. `is_gone` says whether the process has ended: another process
    /// may hold its streams open.
    pub(super) fn exchange(
        &mut self,
        line: &[u8],
        most: usize,
        deadline: Instant,
        mut is_gone: impl FnMut() -> bool,
    ) -> Result<Vec<u8>, ReadLineError> {
        let mut unsent = line;
        let (mut waited, mut gone) = (false, false);
        let mut is_open = self.send(&mut unsent);
        // The answer to this request cannot be there yet.
        let mut is_ready = line.is_empty() || !is_open;
        loop {
            if is_ready {
                self.receive(most);
            }
            if let Some(line) = self.take_line() {
                return Ok(line);
            }
            if self.read.len() > most {
                return Err(ReadLineError::TooLong);
            }
            if self.ended || !is_open {
                return Err(ReadLineError::Ended);
            }
            let left = deadline.saturating_duration_since(now());
            if left.is_zero() {
                return Err(ReadLineError::Late(unsent.is_empty()));
            }
            // What it wrote before it ended has arrived by now.
            if gone {
                return Err(ReadLineError::Ended);
            }
            if waited && is_gone() {
                (gone, is_ready) = (true, true);
                continue;
            }
            let result = self.wait(left, !unsent.is_empty());
            waited = result == WaitResult::TimedOut;
            is_ready = matches!(result, WaitResult::Ready { output: true });
            is_open = self.send(&mut unsent);
            is_ready |= !is_open;
        }
    }

    /// Waits until a stream can be read or written, and reads standard error.
    fn wait(&mut self, left: Duration, has_unsent: bool) -> WaitResult {
        if !has_unsent && self.spin_wait.poll_briefly(&self.output) {
            return WaitResult::Ready { output: true };
        }
        let none = PollFlags::empty();
        let errors = self.errors.as_ref().unwrap_or(&self.output);
        let heard = if self.errors.is_some() { PollFlags::IN } else { none };
        let mut streams = [
            PollFd::new(&self.output, PollFlags::IN),
            PollFd::new(errors, heard),
            PollFd::new(&self.input, PollFlags::OUT),
        ];
        let streams = &mut streams[..if has_unsent { 3 } else { 2 }];
        let pace =
            Timespec { tv_sec: 0, tv_nsec: left.min(LIVENESS_INTERVAL).subsec_nanos().into() };
        let result = match poll(streams, Some(&pace)) {
            Ok(0) => return WaitResult::TimedOut,
            Ok(_) => WaitResult::Ready { output: !streams[0].revents().is_empty() },
            // Only the next check comes earlier.
            Err(_) => WaitResult::Ready { output: true },
        };
        if !streams[1].revents().is_empty() {
            self.read_stderr();
        }
        result
    }

    /// Length of the last line.
    pub(super) fn last_line_length(&self) -> usize {
        self.last_line_length
    }

    /// The last lines of standard error, for a message.
    pub(super) fn stderr_tail(&mut self) -> String {
        self.read_stderr();
        let text = String::from_utf8_lossy(&self.stderr);
        let lines: Vec<_> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
        lines[lines.len().saturating_sub(3)..].join(" | ")
    }

    /// Writes what the stream takes. False if it is closed.
    fn send(&mut self, unsent: &mut &[u8]) -> bool {
        while !unsent.is_empty() {
            match self.input.write(unsent) {
                Ok(count) => *unsent = &unsent[count..],
                Err(error) => return error.kind() == ErrorKind::WouldBlock,
            }
        }
        true
    }

    /// Reads what is there, up to one byte over the limit.
    fn receive(&mut self, most: usize) {
        while !self.ended {
            let left = most.saturating_add(1).saturating_sub(self.read.len()).min(READ_BYTES);
            if left == 0 {
                return;
            }
            match self.output.read(&mut self.buffer[..left]) {
                Ok(0) => self.ended = true,
                Ok(count) => {
                    self.read.extend_from_slice(&self.buffer[..count]);
                    if count < left {
                        return;
                    }
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => (),
                Err(error) => {
                    self.ended = error.kind() != ErrorKind::WouldBlock;
                    return;
                }
            }
        }
    }

    /// Reads standard error and keeps its end.
    fn read_stderr(&mut self) {
        let mut part = [0; STDERR_TAIL_BYTES];
        while let Some(errors) = &mut self.errors {
            match errors.read(&mut part) {
                Ok(0) => self.errors = None,
                Ok(count) => {
                    self.stderr.extend_from_slice(&part[..count]);
                    let surplus = self.stderr.len().saturating_sub(STDERR_TAIL_BYTES);
                    self.stderr.drain(..surplus);
                    if count < part.len() {
                        return;
                    }
                }
                Err(error) if error.kind() == ErrorKind::WouldBlock => return,
                Err(_) => self.errors = None,
            }
        }
    }

    /// Takes the first whole line, without its end.
    fn take_line(&mut self) -> Option<Vec<u8>> {
        // Skipping bytes in memory never fails.
        let stepped = (&self.read[self.scanned..]).skip_until(b'\n').unwrap_or_default();
        let end = (self.scanned + stepped).checked_sub(1).filter(|end| self.read[*end] == b'\n');
        let Some(end) = end else {
            self.scanned = self.read.len();
            return None;
        };
        let rest = self.read.split_off(end + 1);
        let mut line = std::mem::replace(&mut self.read, rest);
        line.truncate(end);
        self.scanned = 0;
        self.last_line_length = end;
        Some(line)
    }
}
