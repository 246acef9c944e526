//! `gaugeblock fuzz` and `gaugeblock shrink`: wrong calls, runs that were interrupted, reports.

use std::path::{Path, PathBuf};

use crate::command::gaugeblock;

/// A folder of its own, empty.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _absent = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

#[track_caller]
fn refused(arguments: &[&str], word: &str) {
    let output = gaugeblock(arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(message.contains(word), "{arguments:?}: {word:?} is not in: {message}");
}

const SELF: &[&str] =
    &["fuzz", "--controller", "reference", "--programs", "200", "--format", "json"];

#[test]
fn usage_errors_are_reported() {
    refused(&["fuzz", "--shard", "3/2"], "3/8");
    refused(&["fuzz", "--resume"], "--report");
    refused(&["fuzz", "--options", "all"], "random");
    refused(&["fuzz", "--only", "no.such"], "motion.traverse");
    refused(&["fuzz", "--options", "from:no-such-file"], "no-such-file");
    refused(&["fuzz", "--edition", "rs274-2.9-observed"], "production");
    refused(&["shrink", "no-such-file.ngc"], "no-such-file.ngc");
}

#[test]
fn resumed_run_gives_the_same_report() {
    let here = folder("fuzz-resume");
    let report = here.to_str().expect("UTF-8");
    let whole = gaugeblock(&[SELF, &["--report", report]].concat());
    assert_eq!(whole.status.code(), Some(0), "{}", String::from_utf8_lossy(&whole.stderr));
    let again = gaugeblock(&[SELF, &["--report", report]].concat());
    assert_eq!(again.status.code(), Some(2), "a journal is not overwritten");
    let journal = here.join("journal.jsonl");
    let text = std::fs::read_to_string(&journal).unwrap();
    std::fs::write(&journal, &text[..text.len() * 2 / 3]).unwrap();
    let resumed = gaugeblock(&[SELF, &["--report", report, "--resume"]].concat());
    assert_eq!(resumed.status.code(), Some(0));
    assert_eq!(resumed.stdout, whole.stdout);
    assert!(resumed.stderr.is_empty() || !String::from_utf8_lossy(&resumed.stderr).contains('%'));
}

#[test]
fn journal_of_another_length_is_refused() {
    let here = folder("fuzz-longer");
    let report = here.to_str().expect("UTF-8");
    let of = |programs, more: &[&str]| {
        let call = ["fuzz", "--controller", "reference", "--spliced", "10", "--programs", programs];
        let output = gaugeblock(&[&call, ["--report", report].as_slice(), more].concat());
        output.status.code()
    };
    assert_eq!(of("64", &[]), Some(0));
    assert_eq!(of("128", &["--resume"]), Some(0), "a little further");
    assert_eq!(of("200000", &["--resume"]), Some(2));
}

#[test]
fn nothing_is_shrunk_where_nothing_differs() {
    let program = folder("shrink").join("good.ngc");
    std::fs::write(&program, "g21\ng0 x1\nm2\n").unwrap();
    let program = program.to_str().expect("UTF-8");
    let output = gaugeblock(&["shrink", program, "--controller", "reference"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stdout).contains("do not differ"));
}

#[test]
fn help_has_examples() {
    for command in ["fuzz", "shrink"] {
        let output = gaugeblock(&[command, "--help"]);
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(text.contains("Examples:") && text.contains("Exit status:"), "{text}");
    }
}

#[test]
fn run_that_compares_too_little_is_no_success() {
    // Some programs of any sample end as unsupported.
    let call = ["fuzz", "--programs", "640", "--spliced", "0"];
    assert_eq!(gaugeblock(&call).status.code(), Some(0));
    let output = gaugeblock(&[&call[..], &["--min-compared", "100"]].concat());
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert!(text.contains("too little was compared") && text.contains("at least 100 %"), "{text}");
}
