//! One run of the program: a cleaned environment, limits, and no surviving process.

use std::ffi::OsString;
use std::io;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, ExitStatus};
use std::thread;
use std::time::{Duration, Instant};

use gaugeblock_adapter::HarnessError;
use gaugeblock_adapter::clock::now;
use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process_group, waitid};

use super::command::Started;
use super::fork::Fork;
use super::hal;
use super::streams::{Stop, Streams};

/// What a run may cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Wall time.
    pub(super) time: Duration,
    /// Bytes on each output stream.
    pub(super) bytes: usize,
}

/// What a run left.
#[derive(Debug, PartialEq, Eq)]
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

/// A run that has begun.
#[derive(Debug)]
pub(super) struct Run<'a> {
    /// Its process.
    pub(super) process: Process<'a>,
    /// Its streams.
    pub(super) streams: Streams,
}

/// The process of a run, which leads a group of its own.
#[derive(Debug)]
pub(super) enum Process<'a> {
    /// Started for this run.
    Plain(Child),
    /// Forked from one that had started before.
    Forked(Fork<'a>),
}

impl Started<'_> {
    /// Starts the program in `directory`.
    ///
    /// # Errors
    /// It could not be started.
    pub(super) fn run(
        &self,
        arguments: &[OsString],
        directory: &Path,
    ) -> Result<Run<'static>, HarnessError> {
        let begin = || {
            let (streams, ends) = Streams::new()?;
            let mut command = self.command(arguments, directory);
            command.stdin(ends.input).stdout(ends.output).stderr(ends.errors);
            Ok(Run { process: Process::Plain(command.spawn()?), streams })
        };
        begin().map_err(not_run)
    }
}

impl Run<'_> {
    /// Waits until the program and all that it started are gone.
    ///
    /// # Errors
    /// It was ended by a signal that is not ours.
    pub(super) fn watch(mut self, input: &str, limits: Limits) -> Result<Output, HarnessError> {
        let deadline = now() + limits.time;
        let early = self.streams.pass(input, limits.bytes, deadline);
        let early = early.or_else(|| (!self.process.exits(deadline)).then_some(Stop::TimedOut));
        let status = self.process.end().map_err(not_run)?;
        let stdout = self.streams.output.text();
        let stderr = hal::without_complaints(self.streams.errors.text());
        let stop = match early {
            Some(early) => early,
            None => Stop::Exited(exit_code(status, &stderr)?),
        };
        Ok(Output { stop, stdout, stderr })
    }
}

impl Process<'_> {
    /// Whether it exits in time. It is not reaped yet: its number stays taken, and its group can be ended safely.
    fn exits(&mut self, deadline: Instant) -> bool {
        match self {
            Self::Plain(child) => exits(child, deadline),
            Self::Forked(fork) => fork.exits(deadline),
        }
    }

    /// Kills it, if it still runs, with all of its processes.
    fn end(self) -> io::Result<ExitStatus> {
        match self {
            Self::Plain(mut child) => {
                if let Some(pid) = pid(&child) {
                    // An empty group is what we want.
                    let _gone = kill_process_group(pid, Signal::KILL);
                }
                child.wait()
            }
            Self::Forked(fork) => fork.end(),
        }
    }
}

fn not_run(error: io::Error) -> HarnessError {
    HarnessError::NotRun(error.to_string())
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

fn pid(child: &Child) -> Option<Pid> {
    i32::try_from(child.id()).ok().and_then(Pid::from_raw)
}

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

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(script: &str, limits: Limits) -> Result<Output, HarnessError> {
        let directory = std::env::temp_dir();
        let program = Started { binary: Path::new("/bin/sh"), python: None };
        let arguments = ["-c".into(), script.into()];
        program.run(&arguments, &directory)?.watch("from stdin\n", limits)
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
    fn hang_flood_and_crash_are_distinguished() {
        assert_eq!(shell("sleep 5", SHORT).unwrap().stop, Stop::TimedOut);
        assert_eq!(shell("while :; do echo flood; done", SHORT).unwrap().stop, Stop::Flooded);
        assert!(matches!(shell("kill -SEGV $$", SHORT), Err(HarnessError::Crashed { .. })));
    }

    #[test]
    fn no_process_survives() {
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
