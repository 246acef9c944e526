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
