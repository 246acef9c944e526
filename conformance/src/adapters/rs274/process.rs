//! One run of the program: a cleaned environment, limits, and nothing left behind.

use std::ffi::OsString;
use std::io::{Read, Write};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process_group, waitid};

use crate::adapters::HarnessError;

/// What is started.
#[derive(Clone, Copy, Debug)]
pub(super) struct Started<'a> {
    /// The binary.
    pub(super) binary: &'a Path,
    /// Home of the Python within; its own if none.
    pub(super) python: Option<&'a Path>,
}

/// What a run may cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Wall time.
    pub(super) time: Duration,
    /// Bytes on each output stream.
    pub(super) bytes: usize,
}

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

/// What a run left.
#[derive(Debug)]
pub(super) struct Output {
    /// How it stopped.
    pub(super) stop: Stop,
    /// Standard output, bytes that are not UTF-8 replaced.
    pub(super) stdout: String,
    /// Standard error, likewise.
    pub(super) stderr: String,
}

impl Output {
    /// The last lines of the error output, for a person.
    pub(super) fn stderr_tail(&self) -> String {
        let lines: Vec<_> = self.stderr.lines().filter(|line| !line.trim().is_empty()).collect();
        lines[lines.len().saturating_sub(3)..].join(" | ")
    }
}

/// One of the two output streams, read to its end or its limit.
struct Stream {
    is_error: bool,
    bytes: Vec<u8>,
    flooded: bool,
}

/// Runs the program in `directory`, which is its home as well, and waits until it and all that it started are gone.
///
/// # Errors
/// It could not be started, or it was ended by a signal that is not ours.
pub(super) fn run(
    program: Started<'_>,
    arguments: &[OsString],
    directory: &Path,
    input: &str,
    limits: Limits,
) -> Result<Output, HarnessError> {
    let not_run = |error: std::io::Error| HarnessError::NotRun(error.to_string());
    let python = program.python.map(|home| ("PYTHONHOME", home));
    let mut child = Command::new(program.binary)
        .args(arguments)
        .current_dir(directory)
        .env_clear()
        .env("HOME", directory)
        .env("LC_ALL", "C")
        .envs(python)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .process_group(0)
        .spawn()
        .map_err(not_run)?;
    let streams = read_streams(&mut child, limits.bytes);
    if let Some(mut stdin) = child.stdin.take() {
        // The program may end before it has read everything; that is its right.
        let _unread = stdin.write_all(input.as_bytes());
    }
    let deadline = now() + limits.time;
    let (stdout, stderr, early) = collect(&streams, deadline);
    let early = early.or_else(|| (!exits(&child, deadline)).then_some(Stop::TimedOut));
    end_group(&child);
    let status = child.wait().map_err(not_run)?;
    let stop = match early {
        Some(early) => early,
        None => Stop::Exited(exit_code(status, &stderr)?),
    };
    Ok(Output { stop, stdout, stderr })
}

#[expect(
    clippy::disallowed_methods,
    reason = "a foreign program may hang; its outcome does not depend on the time"
)]
fn now() -> Instant {
    Instant::now()
}

fn exit_code(status: ExitStatus, stderr: &str) -> Result<i32, HarnessError> {
    status.code().ok_or_else(|| HarnessError::Crashed {
        status: match status.signal() {
            Some(signal) => format!("signal {signal}"),
            None => status.to_string(),
        },
        stderr: stderr.lines().last().unwrap_or_default().to_owned(),
    })
}

/// Reads both streams in threads of their own, so that neither blocks the program.
fn read_streams(child: &mut Child, limit: usize) -> Receiver<Stream> {
    let (sender, receiver) = channel();
    if let Some(stdout) = child.stdout.take() {
        read_one(stdout, false, limit, sender.clone());
    }
    if let Some(stderr) = child.stderr.take() {
        read_one(stderr, true, limit, sender);
    }
    receiver
}

fn read_one(
    stream: impl Read + Send + 'static,
    is_error: bool,
    limit: usize,
    sender: Sender<Stream>,
) {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        let most = u64::try_from(limit).unwrap_or(u64::MAX).saturating_add(1);
        // A stream that breaks is judged by what came before.
        let _broken = stream.take(most).read_to_end(&mut bytes);
        let flooded = bytes.len() > limit;
        // Nobody listens any more once the time is up.
        let _late = sender.send(Stream { is_error, bytes, flooded });
    });
}

/// Waits for both streams: standard output, standard error, and why to stop before the program ends.
fn collect(streams: &Receiver<Stream>, deadline: Instant) -> (String, String, Option<Stop>) {
    let (mut stdout, mut stderr) = (String::new(), String::new());
    for _ in 0..2 {
        let left = deadline.saturating_duration_since(now());
        let Ok(read) = streams.recv_timeout(left) else {
            return (stdout, stderr, Some(Stop::TimedOut));
        };
        let text = String::from_utf8_lossy(&read.bytes).into_owned();
        *if read.is_error { &mut stderr } else { &mut stdout } = text;
        if read.flooded {
            return (stdout, stderr, Some(Stop::Flooded));
        }
    }
    (stdout, stderr, None)
}

fn pid(child: &Child) -> Option<Pid> {
    i32::try_from(child.id()).ok().and_then(Pid::from_raw)
}

/// Whether the program exits in time. It is not reaped yet: its number stays taken, and its group can be ended safely.
fn exits(child: &Child, deadline: Instant) -> bool {
    let Some(pid) = pid(child) else { return false };
    let options = WaitIdOptions::EXITED | WaitIdOptions::NOWAIT | WaitIdOptions::NOHANG;
    loop {
        match waitid(WaitId::Pid(pid), options) {
            Ok(None) if now() < deadline => thread::sleep(Duration::from_micros(200)),
            Ok(status) => return status.is_some(),
            Err(_) => return false,
        }
    }
}

/// Ends the program, if it still runs, and whatever it left behind.
fn end_group(child: &Child) {
    if let Some(pid) = pid(child) {
        // An empty group is what we want.
        let _gone = kill_process_group(pid, Signal::KILL);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(script: &str, limits: Limits) -> Result<Output, HarnessError> {
        let directory = std::env::temp_dir();
        let program = Started { binary: Path::new("/bin/sh"), python: None };
        run(program, &["-c".into(), script.into()], &directory, "from stdin\n", limits)
    }

    const SHORT: Limits = Limits { time: Duration::from_millis(300), bytes: 1000 };

    #[test]
    fn output_and_status_come_back() {
        let output = shell("cat; echo wrong >&2; exit 3", SHORT).unwrap();
        assert_eq!(output.stop, Stop::Exited(3));
        assert_eq!(output.stdout, "from stdin\n");
        assert_eq!(output.stderr, "wrong\n");
    }

    #[test]
    fn a_hang_a_flood_and_a_crash_are_told_apart() {
        assert_eq!(shell("sleep 5", SHORT).unwrap().stop, Stop::TimedOut);
        assert_eq!(shell("while :; do echo flood; done", SHORT).unwrap().stop, Stop::Flooded);
        assert!(matches!(shell("kill -SEGV $$", SHORT), Err(HarnessError::Crashed { .. })));
    }

    #[test]
    fn nothing_is_left_behind() {
        let begun = now();
        let output = shell("sleep 5 >&- 2>&- & echo $!", SHORT).unwrap();
        assert_eq!(output.stop, Stop::Exited(0));
        assert!(begun.elapsed() < Duration::from_secs(2));
        let child = Path::new("/proc").join(output.stdout.trim());
        // A killed orphan is a zombie until init reaps it, and needs a moment to become one.
        let state = || std::fs::read_to_string(child.join("stat")).unwrap_or_default();
        let gone = || state().is_empty() || state().contains(" Z ");
        assert!(
            (0..100).any(|_| gone() || {
                thread::sleep(Duration::from_millis(10));
                gone()
            }),
            "{}",
            state()
        );
    }

    #[test]
    fn the_environment_is_clean() {
        let output = shell("env | sort", SHORT).unwrap();
        let names: Vec<_> =
            output.stdout.lines().filter_map(|line| line.split('=').next()).collect();
        assert!(
            names
                .iter()
                .all(|name| ["HOME", "LC_ALL", "PWD", "SHLVL", "OLDPWD", "_"].contains(name)),
            "{names:?}"
        );
    }
}
