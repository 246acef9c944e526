//! LinuxCNC's whole controller, where it is installed and may have name spaces; where not, each test says what it
//! left out.

use std::fs;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use gaugeblock_adapter::Adapter;
use gaugeblock_linuxcnc::LinuxCnc;
use gaugeblock_runner::certify::{Plan, Scope, Verdict, certify};
use gaugeblock_suite::Suite;

/// The command, unless the controller cannot be used here.
fn gaugeblock(left_out: &str, arguments: &[&str]) -> Option<Command> {
    if let Err(error) = LinuxCnc::find() {
        // Written past the test runner, which keeps what passing tests print to itself.
        let notice = format!("left out: {left_out} ({error})\n");
        std::io::stderr().write_all(notice.as_bytes()).expect("standard error can be written");
        return None;
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_gaugeblock"));
    command.args(arguments).env("NO_COLOR", "1").stdout(Stdio::piped()).stderr(Stdio::piped());
    Some(command)
}

#[track_caller]
fn ends_with(output: &Output, status: i32) -> String {
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{text}{errors}");
    text + &errors
}

/// A program file that waits for seconds.
fn waiting(name: &str) -> PathBuf {
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&file, "g0 x1\nm66 p0 l3 q20\nm2\n").expect("written");
    file
}

/// Process numbers of all that a process started, with their names.
fn descendants(of: u32) -> Vec<(u32, String)> {
    let mut processes = Vec::new();
    for entry in fs::read_dir("/proc").expect("/proc").flatten() {
        let Ok(number) = entry.file_name().to_string_lossy().parse::<u32>() else { continue };
        let Ok(stat) = fs::read_to_string(entry.path().join("stat")) else { continue };
        let Some((head, tail)) = stat.rsplit_once(')') else { continue };
        let name = head.split_once('(').map_or("", |(_, name)| name).to_owned();
        let mut words = tail.split_whitespace();
        let (state, parent) = (words.next().unwrap_or_default(), words.next());
        let parent: u32 = parent.and_then(|word| word.parse().ok()).unwrap_or_default();
        if state != "Z" {
            processes.push((number, parent, name));
        }
    }
    let mut family = vec![of];
    let mut found = Vec::new();
    while let Some(next) = family.pop() {
        for (number, _, name) in processes.iter().filter(|(_, parent, _)| *parent == next) {
            family.push(*number);
            found.push((*number, name.clone()));
        }
    }
    found
}

/// Waits until the task controller of a command runs, and a little longer; all that runs then.
fn when_running(child: &Child) -> Vec<(u32, String)> {
    for _ in 0..300 {
        let family = descendants(child.id());
        if family.iter().any(|(_, name)| name == "milltask") {
            sleep(Duration::from_secs(3));
            return descendants(child.id());
        }
        sleep(Duration::from_millis(100));
    }
    panic!("no task controller runs");
}

fn kill(process: u32) {
    let status = Command::new("kill").args(["-9", &process.to_string()]).status();
    assert!(status.expect("kill runs").success());
}

fn assert_all_gone(family: &[(u32, String)]) {
    let lives = |(number, name): &(u32, String)| {
        let stat = fs::read_to_string(format!("/proc/{number}/stat")).unwrap_or_default();
        stat.contains(&format!("({name})")) && !stat.contains(") Z ")
    };
    for _ in 0..100 {
        if !family.iter().any(lives) {
            return;
        }
        sleep(Duration::from_millis(100));
    }
    let left: Vec<_> = family.iter().filter(|process| lives(process)).collect();
    panic!("left behind: {left:?}");
}

#[test]
fn dead_task_controller_is_reported_and_leaves_no_processes() {
    let file = waiting("dies.ngc");
    let arguments = ["run", file.to_str().expect("UTF-8"), "--controller", "linuxcnc"];
    let Some(mut command) = gaugeblock("a controller that dies", &arguments) else { return };
    let child = command.spawn().expect("the command runs");
    let family = when_running(&child);
    let task = family.iter().find(|(_, name)| name == "milltask").expect("found before");
    kill(task.0);
    let output = child.wait_with_output().expect("an end");
    let text = ends_with(&output, 3);
    assert!(text.contains("ended without an answer"), "{text}");
    assert_all_gone(&family);
}

#[test]
fn killed_referee_leaves_no_processes() {
    let file = waiting("killed.ngc");
    let arguments = ["run", file.to_str().expect("UTF-8"), "--controller", "linuxcnc"];
    let Some(mut command) = gaugeblock("a referee that dies", &arguments) else { return };
    let mut child = command.spawn().expect("the command runs");
    let family = when_running(&child);
    kill(child.id());
    let _status = child.wait();
    assert_all_gone(&family);
}

#[test]
fn it_does_what_is_known_of_it() {
    let edition = ["certify", "--controller", "linuxcnc", "--edition", "linuxcnc-2.9-observed"];
    let sample = ["--only", "outputs", "--only", "dwell"];
    let arguments = [&edition[..], &sample[..]].concat();
    let Some(mut command) = gaugeblock("a sample under linuxcnc-2.9-observed", &arguments) else {
        return;
    };
    ends_with(&command.output().expect("the command runs"), 0);
}

/// The cases that `hostile.txt` names, and none else.
fn hostile() -> Suite {
    let mut suite = Suite::read(&gaugeblock_embedded_suite::files().expect("the suite"))
        .expect("the suite that is built in");
    let text = include_str!("hostile.txt");
    let listed = text.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    let mut listed: Vec<(&str, &str)> =
        listed.map(|line| line.split_once(" / ").expect("a rule and its case")).collect();
    assert!(listed.len() >= 40, "forty hostile scenarios at least");
    for rule in &mut suite.rules {
        rule.motion.clear();
        rule.cases.retain(|case| {
            let place = listed.iter().position(|(id, name)| *id == rule.id && *name == case.name);
            place.map(|place| listed.swap_remove(place)).is_some()
        });
    }
    assert!(listed.is_empty(), "no such cases: {listed:?}");
    suite
}

#[test]
fn the_model_and_the_controller_agree_on_hostile_scenarios() {
    let suite = hostile();
    let controller = match LinuxCnc::find() {
        Ok(controller) => controller,
        Err(error) => {
            let notice = format!("left out: hostile scenarios ({error})\n");
            std::io::stderr().write_all(notice.as_bytes()).expect("standard error can be written");
            return;
        }
    };
    let edition = suite.edition("linuxcnc-2.9-observed").expect("an edition of the suite");
    let jobs = controller.best_jobs().expect("several at once");
    let plan = Plan { suite: &suite, edition, only: &[], jobs, scope: Scope::Full };
    let run = certify(plan, &controller, &|| {});
    let others = run.cases.iter().filter(|result| result.verdict != Verdict::Pass);
    let others: Vec<_> = others.map(|one| (&one.rule.id, one.name, &one.verdict)).collect();
    assert!(others.is_empty(), "{others:#?}");
}

#[test]
fn its_servo_samples_are_recorded_and_judged() {
    let recorded = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../recorded");
    let Some(mut command) = gaugeblock("recording of samples", &["plan", "line.ngc"]) else {
        return;
    };
    let samples = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("line.csv");
    command.current_dir(recorded).args(["--machine", "mill.toml", "--controller", "linuxcnc"]);
    let output = command.arg("--samples").arg(&samples).output().expect("gaugeblock runs");
    let text = ends_with(&output, 0);
    assert!(text.contains("holds       trajectory.acceleration (at most 50.00 % of it)"), "{text}");
    let samples = fs::read_to_string(samples).expect("samples");
    let last = samples.lines().last().expect("a sample");
    assert!(last.starts_with("100,0,0,"), "{last}");
}

#[test]
fn what_waits_and_says_at_the_ends_of_a_program_accuses_nobody() {
    let machine = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../recorded/mill.toml");
    let programs = [
        ("first.ngc", "g21 g64\ng4 p0.4\ng0 x3\n(debug,there)\nm2\n"),
        ("last.ngc", "g21 g64\n(msg,it goes on)\ng0 x3\ng4 p0.4\nm2\n"),
    ];
    for (name, text) in programs {
        let program = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
        fs::write(&program, text).expect("written");
        let Some(mut command) = gaugeblock("dwells at the ends of a recording", &["plan"]) else {
            return;
        };
        command.arg(program).arg("--machine").arg(&machine).args(["--controller", "linuxcnc"]);
        let text = ends_with(&command.output().expect("gaugeblock runs"), 0);
        assert!(text.contains("holds       trajectory.dwell"), "{name}: {text}");
    }
}

#[test]
fn a_program_that_it_refuses_leaves_no_samples() {
    let program = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("refused.ngc");
    fs::write(&program, "g21 g1 f100 x1\ng1 x\nm2\n").expect("written");
    let machine = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../recorded/mill.toml");
    let Some(mut command) = gaugeblock("a refused program", &["plan"]) else { return };
    let samples = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("refused.csv");
    command.arg(program).arg("--machine").arg(machine).args([
        "--controller",
        "linuxcnc",
        "--samples",
    ]);
    let output = command.arg(&samples).output().expect("gaugeblock runs");
    let text = ends_with(&output, 2);
    assert!(text.contains("does not reach its end"), "{text}");
    assert!(!samples.exists());
}
