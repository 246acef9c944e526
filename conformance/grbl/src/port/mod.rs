//! Lines to and from the controller, in bounded time and of bounded length.

mod serial;
mod telnet;
mod transcript;

use std::fs::File;
use std::io::{self, ErrorKind, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::os::fd::OwnedFd;
use std::time::{Duration, Instant};

use gaugeblock_adapter::HarnessError;
use gaugeblock_adapter::clock::now;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::ioctl_fionbio;

use crate::interrupt::Interrupt;
use crate::setup::Address;
pub use serial::BITS_PER_SECOND;
use telnet::Telnet;
pub(crate) use transcript::Transcript;

/// Bytes of a line that are read before it counts as unreadable.
const LINE_BYTES_MAX: usize = 4096;

/// Bytes per read.
const READ_BYTES: usize = 1024;

/// How often a wait checks whether the user interrupts it.
const INTERRUPT_INTERVAL: Duration = Duration::from_millis(50);

/// Lines that are kept for the message about a failure.
const RECENT_LINES: usize = 5;

/// Bytes that went over the link.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// Bytes to the controller.
    pub sent: u64,
    /// Bytes from the controller.
    pub received: u64,
}

/// A connection to the controller.
#[derive(Debug)]
pub(crate) struct Port {
    stream: File,
    telnet: Option<Telnet>,
    /// Bytes that were read and are not a whole line yet.
    read: Vec<u8>,
    /// The last lines, for messages.
    recent: Vec<String>,
    traffic: Traffic,
    interrupt: Interrupt,
    transcript: Option<Transcript>,
    is_closed: bool,
}

impl Port {
    /// Connects to the controller.
    ///
    /// # Errors
    /// The device cannot be opened or set up, or nothing listens at the address.
    pub(crate) fn open(
        address: &Address,
        wait: Duration,
        interrupt: Interrupt,
        transcript: Option<Transcript>,
    ) -> Result<Self, HarnessError> {
        let (stream, telnet) = match address {
            Address::Device(path) => (serial::open_device(path), None),
            Address::Socket(address) => (connect(address, wait), Some(Telnet::default())),
        };
        let stream = stream.and_then(|stream| {
            ioctl_fionbio(&stream, true)?;
            Ok(stream)
        });
        let name = || match address {
            Address::Device(path) => path.display().to_string(),
            Address::Socket(address) => address.clone(),
        };
        let stream =
            stream.map_err(|error| HarnessError::NotRun(format!("{}: {error}", name())))?;
        let (read, recent) = (Vec::new(), Vec::new());
        let traffic = Traffic::default();
        let is_closed = false;
        Ok(Self { stream, telnet, read, recent, traffic, interrupt, transcript, is_closed })
    }

    /// Whether the connection has ended.
    pub(crate) fn is_closed(&self) -> bool {
        self.is_closed
    }

    /// Bytes that went over the link so far.
    pub(crate) fn traffic(&self) -> Traffic {
        self.traffic
    }

    /// The last lines that arrived, for a message.
    pub(crate) fn recent(&self) -> String {
        self.recent.join(" | ")
    }

    /// Writes all of these bytes.
    ///
    /// # Errors
    /// The link takes no bytes in time, or is closed, or the user interrupts.
    pub(crate) fn send(&mut self, bytes: &[u8], wait: Duration) -> Result<(), HarnessError> {
        let deadline = now() + wait;
        let mut unsent = bytes;
        while !unsent.is_empty() {
            match self.stream.write(unsent) {
                Ok(count) => unsent = &unsent[count..],
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) if error.kind() == ErrorKind::WouldBlock => {
                    if !self.wait(PollFlags::OUT, deadline)? {
                        return Err(timed_out(wait));
                    }
                }
                Err(error) => return Err(self.closed(&error.to_string())),
            }
        }
        self.traffic.sent += bytes.len() as u64;
        self.transcript.as_mut().map_or(Ok(()), |transcript| transcript.sent(bytes))
    }

    /// The next line, without its end, or none if none arrives by the deadline.
    ///
    /// # Errors
    /// The link is closed, a line is too long, or the user interrupts.
    pub(crate) fn line(&mut self, deadline: Instant) -> Result<Option<String>, HarnessError> {
        loop {
            if let Some(line) = self.take_line()? {
                if self.recent.len() == RECENT_LINES {
                    self.recent.remove(0);
                }
                self.recent.push(line.clone());
                return Ok(Some(line));
            }
            if self.read.len() > LINE_BYTES_MAX {
                let line = String::from_utf8_lossy(&self.read[..80]).into_owned();
                self.read.clear();
                return Err(HarnessError::Unreadable { what: "a line too long".to_owned(), line });
            }
            if !self.receive()? && !self.wait(PollFlags::IN, deadline)? {
                return Ok(None);
            }
        }
    }

    /// Discards what arrives until the link is silent for as long as `silence`, for `most` at most.
    ///
    /// # Errors
    /// The link is closed, or the user interrupts.
    pub(crate) fn drain(&mut self, silence: Duration, most: Duration) -> Result<(), HarnessError> {
        let end = now() + most;
        loop {
            self.discard()?;
            let deadline = (now() + silence).min(end);
            if !self.receive()? && !self.wait(PollFlags::IN, deadline)? || now() >= end {
                return self.discard();
            }
        }
    }

    /// Takes what has arrived.
    fn discard(&mut self) -> Result<(), HarnessError> {
        while self.take_line()?.is_some() {}
        self.read.clear();
        Ok(())
    }

    /// Takes the first whole line. Empty ones are left out: ends of lines have two bytes.
    fn take_line(&mut self) -> Result<Option<String>, HarnessError> {
        while let Some(end) = self.read.iter().position(|byte| [b'\n', b'\r'].contains(byte)) {
            let line: Vec<u8> = self.read.drain(..=end).collect();
            let line = String::from_utf8_lossy(&line[..end]).trim().to_owned();
            if !line.is_empty() {
                if let Some(transcript) = &mut self.transcript {
                    transcript.received(&line)?;
                }
                return Ok(Some(line));
            }
        }
        Ok(None)
    }

    /// Reads what is there. False if nothing is.
    fn receive(&mut self) -> Result<bool, HarnessError> {
        let mut buffer = [0; READ_BYTES];
        match self.stream.read(&mut buffer) {
            Ok(0) => Err(self.closed("the connection was closed")),
            Ok(count) => {
                let bytes = &buffer[..count];
                self.traffic.received += count as u64;
                match &mut self.telnet {
                    Some(telnet) => self.read.extend(telnet.text(bytes)),
                    None => self.read.extend_from_slice(bytes),
                }
                Ok(true)
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => Ok(true),
            Err(error) if error.kind() == ErrorKind::WouldBlock => Ok(false),
            Err(error) => Err(self.closed(&error.to_string())),
        }
    }

    /// Waits until the stream is ready. False if it is not by the deadline.
    fn wait(&self, readiness: PollFlags, deadline: Instant) -> Result<bool, HarnessError> {
        loop {
            self.interrupt.check()?;
            let left = deadline.saturating_duration_since(now());
            if left.is_zero() {
                return Ok(false);
            }
            let pace = left.min(INTERRUPT_INTERVAL);
            let pace = Timespec { tv_sec: 0, tv_nsec: pace.subsec_nanos().into() };
            match poll(&mut [PollFd::new(&self.stream, readiness)], Some(&pace)) {
                Ok(0) => {}
                // An interrupted wait is repeated by the caller, too.
                Ok(_) | Err(_) => return Ok(true),
            }
        }
    }

    fn closed(&mut self, why: &str) -> HarnessError {
        self.is_closed = true;
        HarnessError::Crashed { status: why.to_owned(), stderr: self.recent() }
    }
}

/// The error of a wait of this length.
pub(crate) fn timed_out(wait: Duration) -> HarnessError {
    HarnessError::TimedOut { seconds: wait.as_secs().max(1) }
}

/// Connects to an address.
fn connect(address: &str, wait: Duration) -> io::Result<File> {
    let mut last = io::Error::from(ErrorKind::NotFound);
    for place in address.to_socket_addrs()? {
        match TcpStream::connect_timeout(&place, wait) {
            Ok(stream) => {
                stream.set_nodelay(true)?;
                return Ok(File::from(OwnedFd::from(stream)));
            }
            Err(error) => last = error,
        }
    }
    Err(last)
}
