//! A line out, a line back, over streams that may hang, flood or end at any moment.

use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::ioctl_fionbio;

use super::super::HarnessError;
use super::process::now;

/// Most of the error output that is kept: its end.
const KEPT: usize = 4096;

/// How often we look whether anybody is there.
const PACE: Duration = Duration::from_millis(50);

/// Why no line came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoLine {
    /// The stream ended.
    Ended,
    /// Not in time; whether all that was to be said could be written.
    Late(bool),
    /// More bytes than allowed without an end of line.
    TooLong,
}

/// The streams of a session.
#[derive(Debug)]
pub(super) struct Lines {
    input: File,
    output: File,
    /// Where there is an error output.
    errors: Option<File>,
    /// What was read and not taken.
    read: Vec<u8>,
    /// How many bytes of it are known to hold no end of a line.
    seen: usize,
    /// Length of the last line that was taken.
    taken: usize,
    /// The end of the error output.
    said: Vec<u8>,
    /// Whether the output has ended.
    ended: bool,
}

impl Lines {
    /// Takes our ends.
    ///
    /// # Errors
    /// They cannot be set to return at once.
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
            seen: 0,
            taken: 0,
            said: Vec::new(),
            ended: false,
        })
    }

    /// What came that nobody asked for.
    pub(super) fn unasked(&mut self) -> Option<&[u8]> {
        self.receive(1);
        (!self.read.is_empty()).then_some(self.read.as_slice())
    }

    /// Writes a line, or nothing, and reads one. `is_gone` tells whether nobody is there any more to answer: somebody else may hold the streams open.
    pub(super) fn ask(
        &mut self,
        line: &[u8],
        most: usize,
        deadline: Instant,
        mut is_gone: impl FnMut() -> bool,
    ) -> Result<Vec<u8>, NoLine> {
        let mut unsent = line;
        let (mut waited, mut gone) = (false, false);
        loop {
            let is_open = self.send(&mut unsent);
            self.receive(most);
            if let Some(line) = self.take_line() {
                return Ok(line);
            }
            if self.read.len() > most {
                return Err(NoLine::TooLong);
            }
            if self.ended || !is_open {
                return Err(NoLine::Ended);
            }
            let left = deadline.saturating_duration_since(now());
            if left.is_zero() {
                return Err(NoLine::Late(unsent.is_empty()));
            }
            // What it wrote before it went has arrived by then.
            if gone {
                return Err(NoLine::Ended);
            }
            if waited && is_gone() {
                gone = true;
                continue;
            }
            let mut streams = vec![PollFd::new(&self.output, PollFlags::IN)];
            if let Some(errors) = &self.errors {
                streams.push(PollFd::new(errors, PollFlags::IN));
            }
            if !unsent.is_empty() {
                streams.push(PollFd::new(&self.input, PollFlags::OUT));
            }
            let pace = Timespec { tv_sec: 0, tv_nsec: left.min(PACE).subsec_nanos().into() };
            // Where it fails we only look sooner.
            waited = matches!(poll(&mut streams, Some(&pace)), Ok(0));
        }
    }

    /// Length of the last line that came.
    pub(super) fn taken(&self) -> usize {
        self.taken
    }

    /// The last lines of the error output, for a person.
    pub(super) fn errors(&mut self) -> String {
        self.hear();
        let text = String::from_utf8_lossy(&self.said);
        let lines: Vec<_> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
        lines[lines.len().saturating_sub(3)..].join(" | ")
    }

    /// Writes what there is room for; whether somebody may still read.
    fn send(&mut self, unsent: &mut &[u8]) -> bool {
        while !unsent.is_empty() {
            match self.input.write(unsent) {
                Ok(count) => *unsent = &unsent[count..],
                Err(error) => return error.kind() == ErrorKind::WouldBlock,
            }
        }
        true
    }

    /// Reads what there is, and a little more than may be.
    fn receive(&mut self, most: usize) {
        let left = most.saturating_add(1).saturating_sub(self.read.len());
        if left > 0 && !self.ended {
            let left = u64::try_from(left).unwrap_or(u64::MAX);
            let end = (&self.output).take(left).read_to_end(&mut self.read);
            let is_full = self.read.len() > most;
            self.ended = match end {
                Err(error) => error.kind() != ErrorKind::WouldBlock,
                Ok(_) => !is_full,
            };
        }
        self.hear();
    }

    /// Keeps the end of the error output.
    fn hear(&mut self) {
        let mut part = [0; KEPT];
        while let Some(errors) = &mut self.errors {
            match errors.read(&mut part) {
                Ok(0) => self.errors = None,
                Ok(count) => {
                    self.said.extend_from_slice(&part[..count]);
                    let surplus = self.said.len().saturating_sub(KEPT);
                    self.said.drain(..surplus);
                    if count < part.len() {
                        return;
                    }
                }
                Err(error) if error.kind() == ErrorKind::WouldBlock => return,
                Err(_) => self.errors = None,
            }
        }
    }

    /// The first whole line, without its end.
    fn take_line(&mut self) -> Option<Vec<u8>> {
        let end = self.read[self.seen..].iter().position(|byte| *byte == b'\n');
        let Some(end) = end.map(|end| end + self.seen) else {
            self.seen = self.read.len();
            return None;
        };
        let rest = self.read.split_off(end + 1);
        let mut line = std::mem::replace(&mut self.read, rest);
        line.truncate(end);
        self.seen = 0;
        self.taken = end;
        Some(line)
    }
}
