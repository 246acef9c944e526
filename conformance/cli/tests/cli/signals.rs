//! A run that ends early leaves no processes and no folders. An earlier report is not mistaken for its own.

use std::fs;
use std::os::unix::process::ExitStatusExt as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use crate::command::gaugeblock;

/// An empty folder.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("signals").join(name);
    let _absent = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

/// The processes of a command's sessions: each has a mark in its environment.
fn sessions(of: &Child) -> Vec<String> {
    let mark = format!("GAUGEBLOCK_SESSION={}-", of.id());
    let processes = fs::read_dir("/proc").expect("/proc").flatten();
    let is_marked = |environment: Vec<u8>| {
        environment.split(|byte| *byte == 0).any(|variable| variable.starts_with(mark.as_bytes()))
    };
    processes
        .filter(|process| fs::read(process.path().join("environ")).is_ok_and(is_marked))
        .map(|process| process.file_name().to_string_lossy().into_owned())
        .collect()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
}

/// Waits for a condition. A busy machine may need minutes.
fn until(what: &str, is_true: impl Fn() -> bool) {
    for _ in 0..12_000 {
        if is_true() {
            return;
        }
        sleep(Duration::from_millis(50));
    }
    panic!("{what}");
}

/// Whether this process ignores a signal, so that the processes that it starts do.
fn is_ignored_here(number: i32) -> bool {
    let status = fs::read_to_string("/proc/self/status").expect("/proc");
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = u64::from_str_radix(ignored.expect("a mask").trim(), 16).expect("a number");
    mask >> (number - 1) & 1 == 1
}

fn send(signal: &str, to: &Child) {
    let status = Command::new("kill").args(["-s", signal, &to.id().to_string()]).status();
    assert!(status.expect("kill runs").success());
}

/// Starts a command with a controller that never answers and that starts another process. Its temporary files are in a
/// folder. The shell executes `before` first.
fn hanging(temporary: &Path, before: &str) -> Child {
    let call = format!(
        "{before} exec \"$0\" certify --controller 'exec:sleep 1000 & sleep 1000' --time-limit 1000"
    );
    let child = Command::new("/bin/sh")
        .args(["-c", &call, env!("CARGO_BIN_EXE_gaugeblock")])
        .env("TMPDIR", temporary)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the command runs");
    until("a session with a folder", || sessions(&child).len() >= 2 && names(temporary).len() == 1);
    child
}

#[test]
fn signal_leaves_neither_processes_nor_folders() {
    for (name, number) in [("HUP", 1), ("INT", 2), ("TERM", 15)] {
        // A shell ignores INT in its background jobs, and so does what these start.
        if is_ignored_here(number) {
            continue;
        }
        let temporary = folder(name);
        let mut child = hanging(&temporary, "");
        send(name, &child);
        let status = child.wait().expect("it ends");
        assert_eq!(status.signal(), Some(number), "the signal ends it: {status}");
        assert_eq!(names(&temporary), [""; 0], "{name}");
        until("no process of a session", || sessions(&child).is_empty());
    }
}

#[test]
fn ignored_signal_stays_ignored() {
    let temporary = folder("nohup");
    let mut child = hanging(&temporary, "trap '' HUP;");
    send("HUP", &child);
    send("TERM", &child);
    let status = child.wait().expect("it ends");
    assert_eq!(status.signal(), Some(15), "{status}");
}

#[test]
fn earlier_report_is_not_taken_for_that_of_a_run_that_could_not_begin() {
    let folder = folder("report");
    let report = folder.join("report.json");
    let path = folder.to_str().expect("UTF-8");
    let run = |controller: &str, more: &[&str]| {
        let call =
            ["certify", "--controller", controller, "--only", "units-planes", "--report", path];
        gaugeblock(&[&call, more].concat()).status.code()
    };
    assert_eq!(run("reference", &[]), Some(0));
    let first = fs::read(&report).expect("a report");
    assert_eq!(run("no-such-controller", &[]), Some(2));
    assert!(report.exists(), "a wrong call changes no file");
    assert_eq!(run("exec:false", &["--baseline", path]), Some(3));
    assert!(report.exists(), "what it is compared with is known as an earlier report");
    assert_eq!(run("exec:false", &[]), Some(3));
    assert_eq!(names(&folder), ["earlier"]);
    assert_eq!(fs::read(folder.join("earlier/report.json")).expect("the earlier report"), first);
}
