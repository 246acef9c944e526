//! The processes of a session: started with limits, and ended with everything that they started.

use std::io::{PipeReader, PipeWriter};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Child, Command, ExitStatus};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use rustix::process::{
    Pid, Resource, Rlimit, Signal, WaitId, WaitIdOptions, kill_process, kill_process_group,
    prlimit, waitid,
};

use super::limits::Limits;
use crate::clock::now;

/// An environment variable that marks all processes of a session, to find those that left its group.
const MARK: &str = "GAUGEBLOCK_SESSION";

/// A session's process, which leads a group of its own. It is ended when this is dropped.
#[derive(Debug)]
pub(super) struct Process {
    child: Child,
    mark: String,
    /// How it ended, after it was reaped.
    ended: Option<String>,
}

impl Process {
    /// Starts a command of the shell.
    ///
    /// # Errors
    /// It could not be started.
    pub(super) fn start(
        command: &str,
        (input, output, errors): (PipeReader, PipeWriter, PipeWriter),
        limits: Limits,
    ) -> std::io::Result<Self> {
        static SESSIONS: AtomicU64 = AtomicU64::new(0);
        let session = SESSIONS.fetch_add(1, Ordering::Relaxed);
        let mark = format!("{}-{session}", std::process::id());
        let child = Command::new("/bin/sh")
            .args(["-c", &without_shell(command)])
            .env(MARK, &mark)
            .process_group(0)
            .stdin(input)
            .stdout(output)
            .stderr(errors)
            .spawn()?;
        let process = Self { child, mark, ended: None };
        if let Some(pid) = process.pid() {
            let most = |bytes| Rlimit { current: Some(bytes), maximum: Some(bytes) };
            // The system may have set lower limits, which cannot be raised; those then apply.
            let _memory = prlimit(Some(pid), Resource::As, most(limits.memory));
            let _file = prlimit(Some(pid), Resource::Fsize, most(limits.file));
            let _core = prlimit(Some(pid), Resource::Core, most(0));
        }
        Ok(process)
    }

    /// How it ended, if it ends within this time.
    pub(super) fn ends_within(&mut self, time: Duration) -> Option<String> {
        if self.ended.is_some() {
            return self.ended.clone();
        }
        let deadline = now() + time;
        let options = WaitIdOptions::EXITED | WaitIdOptions::NOWAIT | WaitIdOptions::NOHANG;
        while waitid(WaitId::Pid(self.pid()?), options).ok()?.is_none() {
            if now() >= deadline {
                return None;
            }
            std::thread::sleep(Duration::from_micros(200));
        }
        // Before the process is reaped its id is not reused, so its group can be killed safely.
        self.end_group();
        self.ended = self.child.wait().ok().map(describe_exit);
        self.ended.clone()
    }

    fn pid(&self) -> Option<Pid> {
        i32::try_from(self.child.id()).ok().and_then(Pid::from_raw)
    }

    fn end_group(&self) {
        if let Some(pid) = self.pid() {
            // An empty group is the goal.
            let _gone = kill_process_group(pid, Signal::KILL);
        }
    }

    /// Kills processes that left the group: the mark of the session is in their environment.
    fn end_others(&self) {
        let wanted = format!("{MARK}={}", self.mark);
        let Ok(entries) = std::fs::read_dir("/proc") else { return };
        for entry in entries.flatten() {
            let Some(pid) = entry.file_name().to_str().and_then(|name| name.parse().ok()) else {
                continue;
            };
            let environment = std::fs::read(entry.path().join("environ")).unwrap_or_default();
            let is_ours =
                environment.split(|byte| *byte == 0).any(|entry| entry == wanted.as_bytes());
            if let Some(pid) = Pid::from_raw(pid)
                && is_ours
            {
                let _gone = kill_process(pid, Signal::KILL);
            }
        }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // After it is reaped, its id may belong to another process.
        if self.ended.is_none() {
            self.end_group();
            // It may have left its group.
            let _ended_before = self.child.kill();
            let _status = self.child.wait();
        }
        self.end_others();
    }
}

/// A plain command replaces the shell, so that its own exit status is reported.
fn without_shell(command: &str) -> String {
    let is_plain = !command.contains(|c: char| ";|&(){}<>\n".contains(c))
        && !command.split_whitespace().next().is_some_and(|word| word.contains('='));
    if is_plain { format!("exec {command}") } else { command.to_owned() }
}

/// How a process ended, in words.
fn describe_exit(status: ExitStatus) -> String {
    match (status.code(), status.signal()) {
        (Some(code), _) => format!("exit status {code}"),
        (None, Some(signal)) => format!("signal {signal}"),
        (None, None) => status.to_string(),
    }
}
