//! What the laws say of samples that LinuxCNC's whole controller commanded (`conformance/recorded`).

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../recorded")
}

fn recordings() -> Vec<String> {
    let files = fs::read_dir(folder()).expect("the recordings");
    let names = files.filter_map(|file| {
        let name = file.expect("a file").file_name().into_string().expect("a name");
        name.strip_suffix(".ngc").map(str::to_owned)
    });
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

/// What `gaugeblock motion check` prints of a recording.
fn judged(name: &str) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_gaugeblock"))
        .current_dir(folder())
        .args(["motion", "check", &format!("{name}.csv"), "--program", &format!("{name}.ngc")])
        .args(["--machine", "mill.toml"])
        .output()
        .expect("gaugeblock runs");
    String::from_utf8(output.stdout).expect("text")
}

/// Seconds from the first to the last moving sample.
fn time(name: &str) -> f64 {
    let text = judged(name);
    let seconds = text.split_once(" s;").map(|(seconds, _)| seconds).expect("a time");
    seconds.parse().expect("a number")
}

#[test]
fn recordings_are_judged_as_they_were() {
    let names = recordings();
    assert!(names.len() >= 9, "{names:?}");
    for name in names {
        let told = fs::read_to_string(folder().join(format!("{name}.txt"))).expect("what was said");
        assert_eq!(judged(&name), told, "{name}");
    }
}

#[test]
fn linuxcnc_rounds_corners_more_slowly_than_it_stops_at_them() {
    assert!(time("square-within") > time("square-stops"));
    assert!(time("teeth-within") > time("teeth-stops"));
}

/// Runs a call in the folder of the recordings. Returns the exit status, standard output and standard error.
fn called(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_gaugeblock"))
        .current_dir(folder())
        .args(arguments)
        .output()
        .expect("gaugeblock runs");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// A program in a folder of the tests.
fn program(name: &str, text: &str) -> String {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&file, text).expect("it is written");
    file.to_str().expect("a path in text").to_owned()
}

#[test]
fn time_of_a_program_counts_its_dwells_wherever_they_are() {
    for (name, text) in [
        ("dwell-last.ngc", "g21 f600\ng1 x10\ng4 p0.5\nm2\n"),
        ("dwell-first.ngc", "g21 f600\ng4 p0.5\ng1 x10\nm2\n"),
    ] {
        let (status, printed, _) =
            called(&["plan", &program(name, text), "--machine", "mill.toml"]);
        assert_eq!(status, Some(0), "{printed}");
        let line = printed.lines().next().unwrap_or_default();
        let (time, rest) = line.split_once(" s; at best 1.505 s (").expect("a time and a bound");
        let time: f64 = time.parse().expect("a number");
        assert!((1.505..1.51).contains(&time), "{time} s; at best 1.505 s ({rest}");
    }
}

#[test]
fn where_nothing_moves_no_motion_rule_passes() {
    let file = program("rest.ngc", "g21\nm2\n");
    let (status, printed, _) = called(&["plan", &file, "--machine", "mill.toml"]);
    assert_eq!(status, Some(3), "{printed}");
    assert!(printed.starts_with("0.000 s: nothing moves\n"), "{printed}");
}

#[test]
fn samples_of_another_period_are_of_another_machine() {
    let file = program("line.ngc", "g21 f600\ng1 x1\nm2\n");
    let samples =
        program("line.csv", "# gaugeblock samples 0 period=0.002 resolution=0\nx\n0\n1\n");
    let (status, _, errors) =
        called(&["motion", "check", &samples, "--program", &file, "--machine", "mill.toml"]);
    assert_eq!(status, Some(2));
    assert!(errors.contains("a period of 0.002 s, the machine has one of 0.001 s"), "{errors}");
}

#[test]
fn device_without_an_end_is_refused() {
    let file = program("line-2.ngc", "g21 f600\ng1 x1\nm2\n");
    for arguments in [
        &["run", "/dev/zero"] as &[&str],
        &["plan", &file, "--machine", "/dev/zero"],
        &["motion", "check", "/dev/zero", "--program", &file, "--machine", "mill.toml"],
    ] {
        let (status, _, errors) = called(arguments);
        assert_eq!(status, Some(2), "{arguments:?}");
        assert!(errors.contains("/dev/zero: no end after 67108864 bytes"), "{errors}");
    }
}
