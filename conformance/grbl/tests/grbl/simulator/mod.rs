//! A simulator of the family's protocol, at a pseudo-terminal or a socket.

mod controller;
mod toy;
mod transcript;

use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::net::TcpListener;
use std::os::fd::{AsFd, OwnedFd};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{JoinHandle, spawn};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{Mode, OFlags, open};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

pub(crate) use controller::{Controller, Member, Misbehaviour};
pub(crate) use transcript::Transcript;

/// Something that answers bytes with bytes.
pub(crate) trait Device: Send + 'static {
    /// What it sends when a connection begins.
    fn connected(&mut self) -> Vec<u8>;
    /// What it sends after these bytes.
    fn receive(&mut self, bytes: &[u8]) -> Vec<u8>;
}

/// A device that runs in a thread until it is dropped.
#[derive(Debug)]
pub(crate) struct Running {
    /// Name of the pseudo-terminal or address of the socket.
    pub(crate) address: String,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
    /// Keeps the pseudo-terminal open between two connections.
    terminal: Option<OwnedFd>,
}

impl Running {
    /// Runs a device at a pseudo-terminal.
    pub(crate) fn at_terminal(mut device: impl Device) -> Self {
        let control = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a pseudo-terminal");
        grantpt(&control).expect("a pseudo-terminal");
        unlockpt(&control).expect("a pseudo-terminal");
        let name = ptsname(&control, Vec::new()).expect("a name");
        let path = PathBuf::from(name.to_str().expect("a name"));
        let terminal = open(&path, OFlags::RDWR | OFlags::NOCTTY, Mode::empty()).expect("a device");
        let stop = Arc::new(AtomicBool::new(false));
        let thread = {
            let stop = Arc::clone(&stop);
            spawn(move || serve(File::from(control), &mut device, &stop))
        };
        let address = path.display().to_string();
        Self { address, stop, thread: Some(thread), terminal: Some(terminal) }
    }

    /// Runs a device at a socket, which sends commands of the telnet protocol first.
    pub(crate) fn at_socket(mut device: impl Device) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a socket");
        let address = listener.local_addr().expect("an address").to_string();
        let stop = Arc::new(AtomicBool::new(false));
        let thread = {
            let stop = Arc::clone(&stop);
            spawn(move || {
                while !stop.load(Ordering::Relaxed) {
                    if !is_readable(&listener) {
                        continue;
                    }
                    let Ok((mut stream, _)) = listener.accept() else { return };
                    let _closed = stream.write_all(b"\xff\xfb\x01\xff\xfd\x03");
                    serve(stream, &mut device, &stop);
                }
            })
        };
        Self { address, stop, thread: Some(thread), terminal: None }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        // A socket is closed then. A terminal may have no reader left, so that a write to it never ends.
        if let Some(thread) = self.thread.take().filter(|_| self.terminal.is_none()) {
            let _panicked = thread.join();
        }
    }
}

fn is_readable(stream: &impl AsFd) -> bool {
    let pace = Timespec { tv_sec: 0, tv_nsec: 20_000_000 };
    poll(&mut [PollFd::new(stream, PollFlags::IN)], Some(&pace)).is_ok_and(|ready| ready > 0)
}

/// Answers until the stream ends or the device is stopped.
fn serve(mut stream: impl Read + Write + AsFd, device: &mut impl Device, stop: &AtomicBool) {
    if stream.write_all(&device.connected()).is_err() {
        return;
    }
    let mut buffer = [0; 256];
    while !stop.load(Ordering::Relaxed) {
        if !is_readable(&stream) {
            continue;
        }
        match stream.read(&mut buffer) {
            Ok(0) => return,
            Ok(count) => {
                if stream.write_all(&device.receive(&buffer[..count])).is_err() {
                    return;
                }
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) => return,
        }
    }
}
