//! One running controller: started in name spaces of its own, driven through pipes, ended with all that it started.

use std::collections::BTreeSet;
use std::io::{BufRead, BufReader, Read, Write};
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;
use std::{fs, io};

use gaugeblock_adapter::HarnessError;
use gaugeblock_adapter::clock::now;
use serde_json::Value;

use super::setup::{self, Setup};
use crate::instrumentation::checkpoint::Checkpoint;
use crate::instrumentation::workspace::{RECORDED_SAMPLES, Workspace};

/// What begins a line of the driver.
pub(super) const MARK: &str = "@gaugeblock@ ";

/// An ordinary user without rights: the controller refuses to run as root.
const NOBODY: u32 = 65534;

/// How long a controller may take to start; one second is usual.
const START: Duration = Duration::from_secs(30);

/// How often a controller is started that does not come up.
const STARTS: usize = 3;

/// The priority of the controller where it may be raised, as for `nice`.
const PRIORITY: &str = "-15";

/// Bytes that one run may print.
const BYTES: usize = 256 << 20;

/// The installed description of the controller's message channels.
const CHANNELS: &str = "/usr/share/linuxcnc/linuxcnc.nml";

/// Bytes of the error channel in it, and those that it gets: marks pass through it faster than they are taken out.
const ERROR_BYTES: (&str, &str) = ("localhost 8192", "localhost 1000000");

const DRIVER: &str = include_str!("driver.py");
const RECORDER: &str = include_str!("record.py");

/// The first process of the private name spaces: its temporary directory is the session's, so that the controller's
/// fixed lock file and whatever a program writes stay in there. All other mounts become read-only; those that are
/// hidden below others cannot be reached and stay. The parameter file is in memory: the controller waits until it is on
/// the disk, which may take seconds on a busy machine. What goes to either output stays in order.
const ENTER: &str = r#"
mount --bind "$1" /tmp && shift &&
while read -r _ _ _ _ point _; do
  point=$(printf %b "$point")
  case $point in /tmp | /tmp/*) continue ;; esac
  mountpoint -q "$point" || continue
  mount --options-source=mtab -o remount,bind,ro "$point" || exit
done < /proc/self/mountinfo && cd /tmp &&
mount -t tmpfs -o mode=777,size=16m memory memory && cp parameters.var memory && chmod 666 memory/parameters.var &&
exec "$@" 2>&1
"#;

/// Gives the controller's servo thread a real-time priority once it exists, as it has on a machine. It is in a process
/// group of its own and bound to one processor: as an ordinary thread it may wait for seconds there, whatever its
/// priority, and the task controller then takes motion for dead.
const REALTIME: &str = r#"
(
  for _ in $(seq 600); do
    for name in /proc/[0-9]*/task/*/comm; do
      read -r thread < "$name" || continue
      case $thread in 'rtapi_app:T#'*) thread=${name%/comm}; chrt --fifo --pid 1 "${thread##*/}"; exit ;; esac
    done
    sleep 0.05
  done
) < /dev/null > /dev/null 2>&1 &
"#;

/// A running controller.
#[derive(Debug)]
pub(super) struct Session {
    /// Its configuration.
    pub(super) setup: Setup,
    /// Names that programs have given values: they stay for as long as it runs.
    pub(super) names: BTreeSet<String>,
    /// The checkpoint at the beginning of the first program.
    pub(super) fresh: Option<Checkpoint>,
    /// Text of the tool table that it has read.
    pub(super) tools: String,
    /// How many errors it has reported.
    pub(super) errors: usize,
    workspace: Workspace,
    child: Child,
    orders: Option<ChildStdin>,
    lines: Receiver<String>,
}

impl Session {
    /// Starts a controller and waits until it is ready. One that does not come up is started again: on a loaded machine
    /// its real-time tasks may come too late to be switched on, and nothing of a scenario has been run by then.
    ///
    /// # Errors
    /// It could not be started, or said why it is not ready, each time.
    pub(super) fn start(setup: &Setup, tools: &str) -> Result<Self, HarnessError> {
        let mut start = Self::start_once(setup, tools.to_owned());
        for _ in 1..STARTS {
            if !matches!(start, Err(HarnessError::Crashed { .. } | HarnessError::TimedOut { .. })) {
                break;
            }
            start = Self::start_once(setup, tools.to_owned());
        }
        start
    }

    fn start_once(setup: &Setup, tools: String) -> Result<Self, HarnessError> {
        let workspace = Workspace::new("linuxcnc")?;
        write_files(&workspace, setup, &tools)
            .map_err(|error| HarnessError::NotRun(format!("private directory: {error}")))?;
        let mut session = Self::spawn(workspace, setup, tools)?;
        session.read_until("ready", START)?;
        Ok(session)
    }

    fn spawn(workspace: Workspace, setup: &Setup, tools: String) -> Result<Self, HarnessError> {
        let mut child = command(workspace.path())
            .spawn()
            .map_err(|error| HarnessError::NotRun(format!("unshare: {error}")))?;
        let lines = read_lines(child.stdout.take());
        let orders = child.stdin.take();
        Ok(Self {
            setup: setup.clone(),
            names: BTreeSet::new(),
            fresh: None,
            tools,
            errors: 0,
            workspace,
            child,
            orders,
            lines,
        })
    }

    /// Starts a controller that records the motion of one program, and waits until it has ended. The samples, as the
    /// sampler prints them.
    ///
    /// # Errors
    /// It could not be started, complained, hung or flooded, or left no samples.
    pub(super) fn record(
        setup: &Setup,
        tools: &str,
        parameters: &str,
        time: Duration,
    ) -> Result<String, HarnessError> {
        let workspace = Workspace::new("linuxcnc")?;
        let not_run =
            |error: io::Error| HarnessError::NotRun(format!("private directory: {error}"));
        write_files(&workspace, setup, tools)
            .and_then(|()| own(&workspace, "parameters.var", parameters, 0o644))
            .and_then(|()| own(&workspace, "record.py", RECORDER, 0o755))
            .map_err(not_run)?;
        let mut session = Self::spawn(workspace, setup, tools.to_owned())?;
        session.read_until("recorded", time)?;
        fs::read_to_string(session.workspace.path().join(RECORDED_SAMPLES)).map_err(not_run)
    }

    /// Writes a file into its directory.
    ///
    /// # Errors
    /// It cannot be written.
    pub(super) fn write(&self, name: &str, text: &str) -> Result<(), HarnessError> {
        own(&self.workspace, name, text, 0o644)
            .map_err(|error| HarnessError::NotRun(format!("{name}: {error}")))
    }

    /// Removes the program files of the run before.
    ///
    /// # Errors
    /// They cannot be removed.
    pub(super) fn clear_programs(&self) -> Result<(), HarnessError> {
        let clear = || -> io::Result<()> {
            for entry in fs::read_dir(self.workspace.path().join("programs"))? {
                let path = entry?.path();
                if path.is_dir() { fs::remove_dir_all(path)? } else { fs::remove_file(path)? }
            }
            Ok(())
        };
        clear().map_err(|error| HarnessError::NotRun(format!("programs: {error}")))
    }

    /// User programs that were not there when the controller started.
    ///
    /// # Errors
    /// They cannot be written.
    pub(super) fn add_late_programs(&self) -> Result<(), HarnessError> {
        for (name, text, executable, at_start) in &self.setup.programs {
            if !at_start {
                let mode = if *executable { 0o755 } else { 0o644 };
                own(&self.workspace, name, text, mode)
                    .map_err(|error| HarnessError::NotRun(format!("{name}: {error}")))?;
            }
        }
        Ok(())
    }

    /// The numbered parameters that are not zero at the end of the last run.
    ///
    /// # Errors
    /// The parameter file is not readable.
    pub(super) fn parameters(&self) -> Result<std::collections::BTreeMap<u32, f64>, HarnessError> {
        self.workspace.read_parameters("parameters.end")
    }

    /// Gives an order and returns all that was printed until it was done.
    ///
    /// # Errors
    /// The controller ended, failed, hung or flooded.
    pub(super) fn order(
        &mut self,
        order: &Value,
        time: Duration,
    ) -> Result<Vec<String>, HarnessError> {
        let text = format!("{order}\n");
        let sent = self.orders.as_mut().map(|orders| orders.write_all(text.as_bytes()));
        match sent {
            Some(Ok(())) => self.read_until("done", time),
            Some(Err(_)) | None => Err(self.crashed(&[])),
        }
    }

    fn read_until(&mut self, what: &str, time: Duration) -> Result<Vec<String>, HarnessError> {
        let deadline = now() + time;
        let mut lines = Vec::new();
        let mut bytes = 0;
        loop {
            let left = deadline.saturating_duration_since(now());
            let line = match self.lines.recv_timeout(left) {
                Ok(line) => line,
                Err(RecvTimeoutError::Timeout) => {
                    return Err(HarnessError::TimedOut { seconds: time.as_secs() });
                }
                Err(RecvTimeoutError::Disconnected) => return Err(self.crashed(&lines)),
            };
            bytes += line.len();
            if bytes > BYTES {
                return Err(HarnessError::Flooded { bytes: BYTES });
            }
            let told =
                line.strip_prefix(MARK).and_then(|told| serde_json::from_str::<Value>(told).ok());
            if let Some(told) = told {
                if let Some(why) = told.get("failed") {
                    let late = told.get("late").is_some();
                    return Err(if late {
                        HarnessError::TimedOut { seconds: time.as_secs() }
                    } else {
                        HarnessError::Crashed {
                            status: why.to_string(),
                            stderr: last_words(&lines),
                        }
                    });
                }
                let is_it = told.get(what).is_some();
                lines.push(line);
                if is_it {
                    return Ok(lines);
                }
            } else {
                lines.push(line);
            }
        }
    }

    fn crashed(&mut self, lines: &[String]) -> HarnessError {
        let status = match self.child.wait() {
            Ok(status) => status.to_string(),
            Err(error) => error.to_string(),
        };
        HarnessError::Crashed { status, stderr: last_words(lines) }
    }
}

/// The last lines that were printed, for a person.
fn last_words(lines: &[String]) -> String {
    let lines: Vec<_> = lines.iter().filter(|line| !line.trim().is_empty()).cloned().collect();
    lines[lines.len().saturating_sub(3)..].join(" | ")
}

impl Drop for Session {
    fn drop(&mut self) {
        // The guard ends with its input, and the kernel ends what is in its process space with it; the holder of the
        // name spaces is ended too, should the guard be stuck.
        drop(self.orders.take());
        let _gone = self.child.kill();
        let _status = self.child.wait();
    }
}

/// The command that starts a controller in its own process, mount, network and message spaces. Root takes an ordinary
/// user's rights inside; anyone else needs a user space, which the system must allow.
fn command(directory: &Path) -> Command {
    let mut command = Command::new("unshare");
    if !is_root() {
        command.args(["--user", "--map-current-user", "--keep-caps"]);
    }
    command.args(["-i", "-n", "-m", "-p", "-f", "--mount-proc", "--kill-child"]);
    let realtime = if is_root() { REALTIME } else { "" };
    command.args(["sh", "-c", &[realtime, ENTER].concat(), "sh"]).arg(directory);
    if is_root() {
        // Its real-time tasks must not be late because others use the machine.
        command.args(["nice", "-n", PRIORITY]);
        let (user, group) = (format!("--reuid={NOBODY}"), format!("--regid={NOBODY}"));
        command.args(["setpriv", &user, &group, "--clear-groups"]);
    } else {
        // What may mount here could make the mounts writable again.
        command.args(["setpriv", "--ambient-caps=-all", "--inh-caps=-all"]);
    }
    command.args(["python3", "./driver.py", "guard", "linuxcnc", "-r", "machine.ini"]);
    command
        .current_dir("/")
        .env_clear()
        .env("HOME", "/tmp")
        .env("LC_ALL", "C")
        .env("PATH", "/usr/bin:/bin:/usr/sbin:/sbin")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null());
    command
}

/// Whether this process may do what root may.
pub(super) fn is_root() -> bool {
    rustix::process::geteuid().is_root()
}

fn write_files(workspace: &Workspace, setup: &Setup, tools: &str) -> io::Result<()> {
    for folder in ["programs", "prefix", "user", "elsewhere", "memory"] {
        let path = workspace.path().join(folder);
        fs::create_dir(&path)?;
        give(&fs::File::open(path)?, 0o755)?;
    }
    own(workspace, "driver.py", DRIVER, 0o755)?;
    own(workspace, "driver.json", &setup.driver, 0o644)?;
    own(workspace, "machine.ini", &setup.ini, 0o644)?;
    own(workspace, "machine.hal", &setup.hal, 0o644)?;
    own(workspace, "channels.nml", &channels(&fs::read_to_string(CHANNELS)?), 0o644)?;
    own(workspace, "tools.tbl", tools, 0o644)?;
    own(workspace, "parameters.var", "", 0o644)?;
    let (gate, text) = setup::gate();
    own(workspace, &gate, &text, 0o755)?;
    for (name, text, executable, at_start) in &setup.programs {
        if *at_start {
            own(workspace, name, text, if *executable { 0o755 } else { 0o644 })?;
        }
    }
    give(&fs::File::open(workspace.path())?, 0o700)
}

/// The message channels with a larger error channel.
fn channels(installed: &str) -> String {
    let line = |line: &str| {
        let words: Vec<_> = line.split_whitespace().collect();
        let spaced = words.join(" ");
        if spaced.starts_with("B emcError ") {
            spaced.replacen(ERROR_BYTES.0, ERROR_BYTES.1, 1) + "\n"
        } else {
            format!("{line}\n")
        }
    };
    installed.lines().map(line).collect()
}

fn own(workspace: &Workspace, name: &str, text: &str, mode: u32) -> io::Result<()> {
    give(&workspace.write(name, text).map_err(io::Error::other)?, mode)
}

/// Gives a file to the user that the controller runs as.
fn give(file: &fs::File, mode: u32) -> io::Result<()> {
    file.set_permissions(fs::Permissions::from_mode(mode))?;
    if is_root() {
        std::os::unix::fs::fchown(file, Some(NOBODY), Some(NOBODY))?;
    }
    Ok(())
}

fn read_lines(stream: Option<impl Read + Send + 'static>) -> Receiver<String> {
    let (sender, receiver) = channel();
    thread::spawn(move || {
        let Some(stream) = stream else { return };
        let mut reader = BufReader::new(stream);
        let mut bytes = Vec::new();
        while reader.read_until(b'\n', &mut bytes).is_ok_and(|count| count > 0) {
            let line = String::from_utf8_lossy(&bytes);
            // The controller prints some lines in parts, and the driver may come between.
            let (before, own) = line.split_at(line.find(MARK).unwrap_or_default());
            for part in [before, own].into_iter().filter(|part| !part.is_empty()) {
                if sender.send(part.trim_end_matches('\n').to_owned()).is_err() {
                    return;
                }
            }
            bytes.clear();
        }
    });
    receiver
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tries to write to each place, and says where it could.
    const INTRUDER: &str = "
import json
written = []
for place in json.load(open('places.json')):
    try:
        with open(place, 'a') as file:
            file.write('x')
        written.append(place)
    except OSError:
        pass
print(json.dumps(written))
";

    #[test]
    fn what_runs_in_the_name_spaces_writes_into_the_workspace_alone() {
        if super::super::version::query().is_err() {
            return;
        }
        let outside = Workspace::new("outside").expect("a folder");
        give(&fs::File::open(outside.path()).expect("it is there"), 0o777).expect("permissions");
        let shared = Path::new("/dev/shm/gaugeblock-intruder");
        let places = [
            "/tmp/inside".to_owned(),
            "inside-too".to_owned(),
            outside.path().join("file").display().to_string(),
            shared.display().to_string(),
            "/var/tmp/gaugeblock-intruder".to_owned(),
            "/dev/null".to_owned(),
        ];
        let workspace = Workspace::new("linuxcnc").expect("a folder");
        let places = serde_json::to_string(&places).expect("JSON");
        own(&workspace, "places.json", &places, 0o644).expect("a file");
        own(&workspace, "driver.py", INTRUDER, 0o755).expect("a file");
        own(&workspace, "parameters.var", "", 0o644).expect("a file");
        fs::create_dir(workspace.path().join("memory")).expect("a folder");
        give(&fs::File::open(workspace.path()).expect("it is there"), 0o700).expect("permissions");
        let output = command(workspace.path()).stdin(Stdio::null()).output().expect("it runs");
        let said = String::from_utf8_lossy(&output.stdout);
        assert_eq!(said.trim(), r#"["/tmp/inside", "inside-too", "/dev/null"]"#);
        assert!(workspace.path().join("inside").exists());
        assert!(!outside.path().join("file").exists() && !shared.exists());
    }
}
