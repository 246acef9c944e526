//! The three streams of a run, fed and read by one thread that waits for none of them alone.

use std::io::{ErrorKind, PipeReader, PipeWriter, Read, Result, Write, pipe};
use std::time::Instant;

use gaugeblock_adapter::clock::now;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::ioctl_fionbio;

/// Why the output ends where it ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// The program exited with this status.
    Exited(i32),
    /// It did not end in time and was ended.
    TimedOut,
    /// It wrote too much and was ended.
    Flooded,
}

/// How long output may stay in its pipe. A controller that writes word by word would wake us for each.
const PACE: Timespec = Timespec { tv_sec: 0, tv_nsec: 1_000_000 };

/// The controller's ends.
#[derive(Debug)]
pub(super) struct Ends {
    pub(super) input: PipeReader,
    pub(super) output: PipeWriter,
    pub(super) errors: PipeWriter,
}

/// Our ends.
#[derive(Debug)]
pub(super) struct Streams {
    input: Option<PipeWriter>,
    /// Standard output.
    pub(super) output: Stream,
    /// Standard error.
    pub(super) errors: Stream,
}

/// An output stream, as far as it was read.
#[derive(Debug)]
pub(super) struct Stream {
    pipe: PipeReader,
    bytes: Vec<u8>,
    state: State,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Open,
    Ended,
    Flooded,
}

impl Streams {
    /// New streams, and the ends that the controller takes.
    ///
    /// # Errors
    /// The system has no more.
    pub(super) fn new() -> Result<(Self, Ends)> {
        let (input, our_input) = pipe()?;
        let (our_output, output) = pipe()?;
        let (our_errors, errors) = pipe()?;
        ioctl_fionbio(&our_input, true)?;
        let (ours, theirs) = (Stream::new(our_output)?, Stream::new(our_errors)?);
        let streams = Self { input: Some(our_input), output: ours, errors: theirs };
        Ok((streams, Ends { input, output, errors }))
    }

    /// Writes the input and reads both outputs to their ends, or returns why it stopped before.
    pub(super) fn pass(&mut self, input: &str, limit: usize, deadline: Instant) -> Option<Stop> {
        let mut unread = input.as_bytes();
        loop {
            self.feed(&mut unread);
            self.output.read(limit);
            self.errors.read(limit);
            let both = [&self.output, &self.errors];
            if both.iter().any(|stream| stream.state == State::Flooded) {
                return Some(Stop::Flooded);
            }
            let open = both.into_iter().filter(|stream| stream.state == State::Open);
            let mut ends: Vec<_> =
                open.map(|stream| PollFd::new(&stream.pipe, PollFlags::empty())).collect();
            if ends.is_empty() {
                return None;
            }
            if now() >= deadline {
                return Some(Stop::TimedOut);
            }
            // Asked for no event, it tells the end of a stream alone. Where it fails we only read sooner.
            let _woken = poll(&mut ends, Some(&PACE));
        }
    }

    /// Writes what the pipe has room for. The program may end before it has read everything; that is its right.
    fn feed(&mut self, unread: &mut &[u8]) {
        let Some(mut pipe) = self.input.as_ref() else { return };
        while !unread.is_empty() {
            match pipe.write(unread) {
                Ok(count) => *unread = &unread[count..],
                Err(error) if error.kind() == ErrorKind::WouldBlock => return,
                Err(_) => break,
            }
        }
        self.input = None;
    }
}

impl Stream {
    fn new(pipe: PipeReader) -> Result<Self> {
        ioctl_fionbio(&pipe, true)?;
        Ok(Self { pipe, bytes: Vec::new(), state: State::Open })
    }

    /// Its text, bytes that are not UTF-8 replaced; nothing if it was cut off by anything but its limit.
    pub(super) fn text(&self) -> String {
        match self.state {
            State::Open => String::new(),
            State::Ended | State::Flooded => String::from_utf8_lossy(&self.bytes).into_owned(),
        }
    }

    /// Reads what there is.
    fn read(&mut self, limit: usize) {
        if self.state != State::Open {
            return;
        }
        let left = limit.saturating_add(1).saturating_sub(self.bytes.len());
        let most = u64::try_from(left).unwrap_or(u64::MAX);
        match (&self.pipe).take(most).read_to_end(&mut self.bytes) {
            Err(error) if error.kind() == ErrorKind::WouldBlock => {}
            _ if self.bytes.len() > limit => self.state = State::Flooded,
            // A stream that breaks is judged by what came before.
            Ok(_) | Err(_) => self.state = State::Ended,
        }
    }
}
