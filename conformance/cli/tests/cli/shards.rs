//! A run in parts, or one that is killed and gone on with, comes to the same report as one that is not.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::command::gaugeblock;

const REFERENCE: &[&str] =
    &["certify", "--controller", "reference", "--only", "saved-state", "--only", "units-planes"];

/// An empty folder.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("shards").join(name);
    let _absent = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a path in UTF-8")
}

fn report(folder: &Path) -> String {
    std::fs::read_to_string(folder.join("report.json")).expect("a report")
}

/// Runs parts of `of`, each into a folder of its own.
fn parts(name: &str, call: &[&str], of: usize) -> Vec<PathBuf> {
    let part = |index: usize| {
        let here = folder(&format!("{name}-{index}"));
        let shard = format!("{index}/{of}");
        let output = gaugeblock(&[call, &["--shard", &shard, "--report", text(&here)]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        here
    };
    (1..=of).map(part).collect()
}

#[test]
fn sixteen_parts_merged_are_the_whole_byte_for_byte() {
    let whole = folder("whole");
    gaugeblock(&[REFERENCE, &["--report", text(&whole)]].concat());
    let parts = parts("sixteenth", REFERENCE, 16);
    let merged = folder("merged");
    let names: Vec<&str> = parts.iter().rev().map(|part| text(part)).collect();
    let output = gaugeblock(
        &[&["report", "merge"], names.as_slice(), &["--report", text(&merged)]].concat(),
    );
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(report(&merged), report(&whole));
    for file in ["junit.xml", "report.txt", "summary.md"] {
        let read = |folder: &Path| std::fs::read_to_string(folder.join(file)).expect("a report");
        assert_eq!(read(&merged), read(&whole), "{file}");
    }
}

#[test]
fn parts_that_are_missing_there_twice_or_of_another_run_are_refused() {
    let call = ["certify", "--controller", "reference", "--only", "saved-state.feed"];
    let parts = parts("third", &call, 3);
    let other = folder("other");
    let edition = ["--edition", "linuxcnc-2.9", "--shard", "3/3", "--report", text(&other)];
    gaugeblock(&[&call[..], &edition].concat());
    let torn = folder("torn");
    let whole = report(&parts[0]);
    std::fs::write(torn.join("report.json"), &whole[..whole.len() / 2]).expect("a file");
    let [one, two, three] = [&parts[0], &parts[1], &parts[2]].map(|part| text(part));
    for (reports, words) in [
        (vec![one, three], "shards are missing: 2/3"),
        (vec![one, two, three, two], "are both shard 2/3"),
        (vec![one, two, text(&other)], "edition \"linuxcnc-2.8\" and \"linuxcnc-2.9\""),
        (vec![one, two, text(&torn)], "EOF"),
        (vec![one, two, "no-such-folder"], "no-such-folder"),
    ] {
        let into = folder("refused");
        let output = gaugeblock(
            &[&["report", "merge"], reports.as_slice(), &["--report", text(&into)]].concat(),
        );
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(
            message.contains(words) && message.contains("hint:"),
            "{words:?} is not in: {message}"
        );
        assert!(!into.join("report.json").exists(), "nothing half written");
    }
}

#[test]
fn repeatedly_killed_run_gives_the_same_report() {
    let whole = folder("uninterrupted");
    let call = ["certify", "--controller", "reference", "--jobs", "2"];
    gaugeblock(&[&call[..], &["--report", text(&whole)]].concat());
    let here = folder("killed");
    let resumed = [&call[..], &["--report", text(&here), "--resume"]].concat();
    for kill in 0..50 {
        let mut run = Command::new(env!("CARGO_BIN_EXE_gaugeblock"))
            .args(&resumed)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the command runs");
        // Some while it starts, most while it works.
        std::thread::sleep(Duration::from_millis(kill * 37 % 1000));
        run.kill().expect("it can be killed");
        run.wait().expect("it ends");
    }
    let output = gaugeblock(&resumed);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(report(&here), report(&whole));
}

/// A call that certifies the model by one rule, with a report in this folder.
fn certify_feed(folder: &Path) -> [&str; 7] {
    let rule = "saved-state.feed";
    ["certify", "--controller", "reference", "--only", rule, "--report", text(folder)]
}

#[test]
fn a_run_that_was_broken_off_is_neither_lost_nor_mixed_up() {
    let here = folder("broken-off");
    let journal = here.join("journal.jsonl");
    let call = certify_feed(&here);
    gaugeblock(&call);
    assert!(!journal.exists(), "all of it is in the report");
    std::fs::write(&journal, "{\"controller\":\"another\"}\n").expect("a journal");
    for more in [vec![], vec!["--resume"]] {
        let output = gaugeblock(&[&call[..], &more].concat());
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains("journal.jsonl") && message.contains("hint:"), "{message}");
    }
}

#[test]
fn report_whose_counts_are_not_those_of_its_cases_is_not_merged() {
    let here = folder("edited");
    let call = certify_feed(&here);
    gaugeblock(&call);
    let whole = report(&here);
    for (old, new, words) in [
        (
            "\"verdict\": \"pass\"",
            "\"verdict\": \"unsupported\", \"why\": { \"reason\": \"no\" }",
            "`pass` of its counts",
        ),
        (
            "\"exit_status\": 0",
            "\"exit_status\": 3",
            "its exit status is 3, and its cases result in 0",
        ),
    ] {
        // Rules have verdicts, too: the first one after this is of a case.
        let cases = whole.find("\"cases\": [").filter(|_| old.contains("verdict")).unwrap_or(0);
        let at = cases + whole[cases..].find(old).expect("it is in the report");
        let edited = format!("{}{new}{}", &whole[..at], &whole[at + old.len()..]);
        std::fs::write(here.join("report.json"), edited).expect("a file");
        let output = gaugeblock(&["report", "merge", text(&here)]);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains("contradicts itself") && message.contains(words), "{message}");
    }
    std::fs::write(here.join("report.json"), whole).expect("a file");
    assert_eq!(gaugeblock(&["report", "merge", text(&here)]).status.code(), Some(0));
}

#[test]
fn journal_with_two_results_of_a_case_is_refused() {
    let here = folder("journal-twice");
    let call = [
        "certify",
        "--controller",
        "reference",
        "--jobs",
        "1",
        "--report",
        text(&here),
        "--resume",
    ];
    let mut run = Command::new(env!("CARGO_BIN_EXE_gaugeblock"))
        .args(call)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the command runs");
    let journal = here.join("journal.jsonl");
    let written = || std::fs::read_to_string(&journal).unwrap_or_default();
    while written().lines().count() < 4 {
        std::thread::sleep(Duration::from_millis(10));
    }
    run.kill().expect("it can be killed");
    run.wait().expect("it ends");
    let lines = written();
    let line = lines.lines().nth(1).expect("a case");
    let other =
        line.replace("\"verdict\":\"pass\"", "\"verdict\":\"crash\",\"why\":{\"reason\":\"x\"}");
    assert_ne!(line, other);
    let edited = format!("{}{other}\n", &lines[..=lines.rfind('\n').expect("a line")]);
    std::fs::write(&journal, edited).expect("the journal");
    let output = gaugeblock(&call);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(message.contains("is there twice, with different results"), "{message}");
}
