//! The processes of a session: started with limits, and ended with everything that they started.

use std::io::{ErrorKind, PipeReader, PipeWriter};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Child, Command, ExitStatus};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use rustix::process::{
    Pid, Signal, WaitId, WaitIdOptions, kill_process, kill_process_group, waitid,
};

use super::limits::Limits;
use crate::clock::now;

/// An environment variable that marks all processes of a session, to find those that left its group.
const MARK: &str = "GAUGEBLOCK_SESSION";

/// The groups of the sessions of this process that have not been reaped.
struct Groups {
    leaders: Vec<Pid>,
    /// The process ends, and starts no more sessions.
    closed: bool,
}

static GROUPS: Mutex<Groups> = Mutex::new(Groups { leaders: Vec::new(), closed: false });

/// The list stays valid if another thread panics.
fn groups() -> MutexGuard<'static, Groups> {
    GROUPS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Kills the processes of all sessions of this process, which is about to end by a signal. None can be started
/// afterwards.
pub fn kill_sessions() {
    let mut groups = groups();
    groups.closed = true;
    for leader in &groups.leaders {
        // It is not reaped before it leaves the list, so its id is its own.
        let _gone = kill_process_group(*leader, Signal::KILL);
        let _it_may_have_left_its_group = kill_process(*leader, Signal::KILL);
    }
    let ours = format!("{MARK}={}-", std::process::id());
    kill_marked(|variable| variable.starts_with(ours.as_bytes()));
}

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
        let mut groups = groups();
        if groups.closed {
            return Err(std::io::Error::new(ErrorKind::Interrupted, "the process ends"));
        }
        let child = Command::new("/bin/sh")
            .args(["-c", &limited(command, limits)])
            .env(MARK, &mark)
            .process_group(0)
            .stdin(input)
            .stdout(output)
            .stderr(errors)
            .spawn()?;
        let process = Self { child, mark, ended: None };
        groups.leaders.extend(process.pid());
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
        self.forget();
        self.ended = self.child.wait().ok().map(describe_exit);
        self.ended.clone()
    }

    fn pid(&self) -> Option<Pid> {
        i32::try_from(self.child.id()).ok().and_then(Pid::from_raw)
    }

    /// Takes it from the list of groups, before it is reaped.
    fn forget(&self) {
        let pid = self.pid();
        groups().leaders.retain(|leader| Some(*leader) != pid);
    }

    fn end_group(&self) {
        if let Some(pid) = self.pid() {
            // An empty group is the goal.
            let _gone = kill_process_group(pid, Signal::KILL);
        }
    }

    /// Kills processes that left the group.
    fn end_others(&self) {
        let wanted = format!("{MARK}={}", self.mark);
        kill_marked(|variable| variable == wanted.as_bytes());
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // After it is reaped, its id may belong to another process.
        if self.ended.is_none() {
            self.end_group();
            // It may have left its group.
            let _ended_before = self.child.kill();
            self.forget();
            let _status = self.child.wait();
        }
        self.end_others();
    }
}

/// Kills the processes with a matching variable in their environment.
fn kill_marked(is_wanted: impl Fn(&[u8]) -> bool) {
    let Ok(entries) = std::fs::read_dir("/proc") else { return };
    for entry in entries.flatten() {
        let Some(pid) = entry.file_name().to_str().and_then(|name| name.parse().ok()) else {
            continue;
        };
        let environment = std::fs::read(entry.path().join("environ")).unwrap_or_default();
        let is_ours = environment.split(|byte| *byte == 0).any(&is_wanted);
        if let Some(pid) = Pid::from_raw(pid)
            && is_ours
        {
            let _gone = kill_process(pid, Signal::KILL);
        }
    }
}

/// A command with limits that apply before it starts. Lower limits of the system stay in force: they cannot be raised.
fn limited(command: &str, limits: Limits) -> String {
    // Units of `ulimit`: kilobytes of memory, blocks of 512 bytes of files.
    let (memory, file) = (limits.memory / 1024, limits.file / 512);
    let each = [format!("-v {memory}"), format!("-f {file}"), "-c 0".to_owned()];
    let set = each.map(|limit| format!("ulimit {limit} 2>/dev/null; "));
    format!("{}{}", set.concat(), without_shell(command))
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
