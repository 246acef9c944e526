//! Against the real binary. Where it is not installed these tests say so and pass.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::thread;
use std::time::Duration;

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_suite::{Suite, scenario_of};
use gaugeblock_vocabulary::Scenario;
use rustix::process::kill_process;
use sha2::{Digest as _, Sha256};

use super::*;
use crate::instrumentation::instrument::{Ends, Plan};
use crate::instrumentation::source::Source;
use crate::rs274::process::{Limits, Output, Process, Run};
use crate::rs274::session::{From, MANUAL_INPUT, Session, Uninstrumented};
use crate::rs274::streams::Stop;
use crate::rs274::{LIMITS, Rs274};

/// Every so many cases of the suite one is run both ways.
const SAMPLE: usize = 64;

const SHORT: Limits = Limits { time: Duration::from_millis(300), bytes: 10_000 };

/// Writes without end.
const FLOOD: &str = "o1 do\n(print,flood)\no1 while [1]\nm2\n";

/// Runs without end, and writes nothing.
const HANG: &str = "o1 do\n#31=1\no1 while [1]\nm2\n";

/// The controller, or a notice that it is absent.
fn controller() -> Option<Rs274> {
    match Rs274::find(None) {
        Ok(controller) => Some(controller),
        Err(error) => {
            eprintln!("skipped: {error}");
            None
        }
    }
}

fn start() -> Start {
    let arguments = ["-g", "-t", "tools.tbl", "main.ngc"].map(OsString::from);
    Start { arguments: arguments.to_vec(), tools: "\n".to_owned() }
}

/// Begins a program on a fork.
fn begin<'a>(controller: &'a Rs274, folder: &Workspace, program: &str) -> Fork<'a> {
    folder.write("main.ngc", program).unwrap();
    folder.write("tools.tbl", "\n").unwrap();
    let run = controller.servers.run(controller.program(), &start(), folder.path());
    run.expect("it can be forked").0
}

/// Runs a program on a fork.
fn run(controller: &Rs274, program: &str) -> Result<Output, HarnessError> {
    let folder = Workspace::in_memory("rs274")?;
    folder.write("main.ngc", program)?;
    folder.write("tools.tbl", "\n")?;
    let run = controller.servers.run(controller.program(), &start(), folder.path());
    let (fork, streams) = run.expect("it can be forked");
    Run { process: Process::Forked(fork), streams }.watch("", SHORT)
}

/// Waits until nothing runs in a process group. A zombie does not run: whether anybody waits for one depends on the
/// first process of the machine.
fn is_gone(group: Pid) -> bool {
    let group = group.as_raw_nonzero().to_string();
    let runs = || {
        let processes = fs::read_dir("/proc").unwrap().filter_map(Result::ok);
        let stats =
            processes.filter_map(|entry| fs::read_to_string(entry.path().join("stat")).ok());
        stats.into_iter().any(|stat| {
            let mut fields = stat.rsplit(") ").next().unwrap_or_default().split_whitespace();
            fields.next() != Some("Z") && fields.nth(1) == Some(&group)
        })
    };
    (0..200).any(|_| {
        !runs() || {
            thread::sleep(Duration::from_millis(10));
            false
        }
    })
}

/// Its files, and digests of what is in them. Those of the tool table in memory differ from start to start: gaps in
/// its entries are never written.
fn digests(folder: &Path) -> BTreeMap<OsString, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let entries = entries.filter(|entry| entry.file_name() != ".tool.mmap");
    let mut all = BTreeMap::new();
    for entry in entries {
        if entry.path().is_dir() {
            let inner = digests(&entry.path()).into_iter();
            let place = |name| Path::new(&entry.file_name()).join(name).into_os_string();
            all.extend(inner.map(|(name, digest)| (place(name), digest)));
        } else {
            let digest = Sha256::digest(fs::read(entry.path()).unwrap()).to_vec();
            all.insert(entry.file_name(), digest);
        }
    }
    all
}

/// Scenarios of the suite that the controller runs: a sample, a larger one of those with a tool table, and all with
/// deleted blocks.
fn scenarios(controller: &Rs274) -> Vec<Scenario> {
    let suite = Suite::read(&gaugeblock_embedded_suite::files().expect("the suite")).unwrap();
    let edition = suite.edition("rs274-2.9-observed").unwrap();
    let options = suite.options(edition);
    let spoken = suite.rules.iter().filter(|rule| rule.language == edition.language);
    let cases = spoken.flat_map(|rule| &rule.cases);
    let all = cases.map(|case| scenario_of(case, &options, edition)).enumerate();
    let every = |it: &Scenario| match (it.program.block_delete, it.machine.tools.is_empty()) {
        (true, _) => 1,
        (false, false) => SAMPLE / 8,
        (false, true) => SAMPLE,
    };
    let chosen = all.filter(|(place, it)| place.is_multiple_of(every(it)));
    chosen.map(|(_, it)| it).filter(|it| controller.supports(it).is_ok()).collect()
}

#[test]
fn forked_run_equals_started_run() {
    let Some(controller) = controller() else { return };
    let scenarios = scenarios(&controller);
    assert!(scenarios.len() > 200, "{}", scenarios.len());
    for scenario in &scenarios {
        let source = Source::new(&scenario.program);
        let session = Session {
            program: controller.program(),
            servers: &controller.servers,
            limits: LIMITS,
            uninstrumented: Uninstrumented::Sample,
            scenario,
            machine: &scenario.machine,
            source: &source,
        };
        let ends = Ends::new(&source, scenario.program.block_delete);
        let plan = Plan::new(&source, &BTreeSet::new());
        let run = |from: From| {
            let text = |file: usize, lines: &[String]| plan.with_checkpoints(file, lines, &ends);
            session.run(from, MANUAL_INPUT, &plan.mdi_checkpoint(&ends), text)
        };
        match (run(From::Fork), run(From::Start)) {
            (Ok((forked, its_folder)), Ok((started, folder))) => {
                assert_eq!(forked, started, "{:?}", scenario.program);
                assert_eq!(
                    digests(its_folder.path()),
                    digests(folder.path()),
                    "{:?}",
                    scenario.program
                );
            }
            (forked, started) => {
                assert_eq!(forked.err(), started.err(), "{:?}", scenario.program);
            }
        }
    }
    assert_eq!(controller.servers.trouble(), None);
}

#[test]
fn hang_flood_and_crash_are_distinguished() {
    let Some(controller) = controller() else { return };
    assert_eq!(run(&controller, HANG).unwrap().stop, Stop::TimedOut);
    assert_eq!(run(&controller, FLOOD).unwrap().stop, Stop::Flooded);
    assert_eq!(run(&controller, "m2\n").unwrap().stop, Stop::Exited(0));
    let crash = run(&controller, "o<a(b)c> call\nm2\n");
    assert!(matches!(crash, Err(HarnessError::Crashed { .. })), "{crash:?}");
    let folder = Workspace::in_memory("rs274").unwrap();
    let fork = begin(&controller, &folder, HANG);
    kill_process(fork.group, Signal::SEGV).unwrap();
    assert_eq!(ended(fork).signal(), Some(Signal::SEGV.as_raw()));
    assert_eq!(lock(&controller.servers.at_rest).len(), 1, "one server served them all");
}

/// How a fork ends by itself.
fn ended(mut fork: Fork<'_>) -> ExitStatus {
    assert!(fork.exits(now() + PATIENCE));
    fork.end().unwrap()
}

#[test]
fn a_server_that_died_is_replaced() {
    let Some(controller) = controller() else { return };
    let first = run(&controller, "m2\n").unwrap();
    for (_, server) in lock(&controller.servers.at_rest).iter_mut() {
        server.kill();
    }
    assert_eq!(run(&controller, "m2\n").unwrap(), first);
    assert_eq!(controller.servers.trouble(), None);
}

#[test]
fn run_without_its_server_has_no_outcome() {
    let Some(controller) = controller() else { return };
    let folder = Workspace::in_memory("rs274").unwrap();
    let mut fork = begin(&controller, &folder, HANG);
    let group = fork.group;
    fork.server.kill();
    assert!(is_gone(group), "a fork ends with its server");
    assert!(!fork.exits(now() + PATIENCE) && fork.end().is_err());
}

#[test]
fn run_ends_when_the_reader_is_gone() {
    let Some(controller) = controller() else { return };
    let folder = Workspace::in_memory("rs274").unwrap();
    let fork = begin(&controller, &folder, HANG);
    // As the end of this process would.
    fork.server.hang_up();
    assert!(is_gone(fork.group), "nothing of its group runs on");
}

#[test]
fn without_fork_support_runs_are_started_and_noted() {
    let servers = Servers::new();
    let shell = Started { binary: Path::new("/bin/sh"), python: None };
    let arguments = ["-c", "exit 0"].map(OsString::from).to_vec();
    let start = Start { arguments, tools: String::new() };
    let folder = Workspace::in_memory("rs274").unwrap();
    assert!(servers.run(shell, &start, folder.path()).is_none());
    let trouble = servers.trouble().expect("a sentence");
    assert!(trouble.contains("ended before"), "{trouble}");
}
