//! LinuxCNC's stand-alone interpreter, where it is installed; where not, each test says what it left out.

use std::io::Write as _;
use std::process::{Command, Output};

use gaugeblock_linuxcnc::Rs274;
use gaugeblock_suite::Suite;

const EXPECTATIONS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../expectations/rs274-2.9.toml");

/// Runs the command, unless the controller is not installed.
fn gaugeblock(left_out: &str, arguments: &[&str]) -> Option<Output> {
    if let Err(error) = Rs274::find(None) {
        // Written past the test runner, which keeps what passing tests print to itself.
        let notice = format!("left out: {left_out} ({error})\n");
        std::io::stderr().write_all(notice.as_bytes()).expect("standard error can be written");
        return None;
    }
    let output = Command::new(env!("CARGO_BIN_EXE_gaugeblock"))
        .args(arguments)
        .env("NO_COLOR", "1")
        .output();
    Some(output.expect("the command runs"))
}

#[track_caller]
fn ends_with(output: &Output, status: i32) -> String {
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{text}{errors}");
    text
}

/// Chapters of every kind; `.ci/run` takes the whole suite, since each case starts a process of its own.
const SAMPLE: [&str; 6] =
    ["--only", "saved-state", "--only", "cycles", "--only", "active-comments"];

#[test]
fn it_does_what_is_known_of_it() {
    let edition = ["certify", "--controller", "rs274", "--edition", "rs274-2.9-observed"];
    let arguments = [&edition[..], &["--check-observation"], &SAMPLE].concat();
    if let Some(output) = gaugeblock("chapters under rs274-2.9-observed", &arguments) {
        ends_with(&output, 0);
    }
}

#[test]
fn divergences_are_exactly_the_expected_ones() {
    let against = ["certify", "--controller", "rs274", "--expectations", EXPECTATIONS];
    let arguments = [&against[..], &SAMPLE].concat();
    if let Some(output) = gaugeblock("chapters under linuxcnc-2.9", &arguments) {
        ends_with(&output, 0);
    }
}

#[test]
fn without_expectations_divergences_are_reported_with_document_and_program() {
    let arguments = ["certify", "--controller", "rs274", "--only", "saved-state.feed"];
    if let Some(output) = gaugeblock("departures from the 2.9 manual", &arguments) {
        let text = ends_with(&output, 1);
        for words in ["linuxcnc-2.9", "m72", "expected", "found", "rs274.feed-speed-rounded"] {
            assert!(text.contains(words), "{words} is not in:\n{text}");
        }
    }
}

#[test]
fn one_entry_less_or_one_too_many_is_named() {
    let text = std::fs::read_to_string(EXPECTATIONS).expect("the file of expectations");
    let suite =
        Suite::read(&gaugeblock_embedded_suite::files().expect("the suite")).expect("the suite");
    let mut listed: gaugeblock_runner::expectations::Expectations =
        gaugeblock_runner::expectations::Expectations::read(&text).expect("readable");
    let place =
        listed.known.iter().position(|known| known.rule.starts_with("saved-state.")).expect("one");
    let taken = listed.known.remove(place);
    let rule = suite
        .rules
        .iter()
        .find(|rule| rule.id == "coolant.mist")
        .or(suite.rules.first())
        .expect("a rule");
    listed.known.push(gaugeblock_runner::expectations::KnownDivergence {
        reason: None,
        rule: rule.id.clone(),
        case: rule.cases[0].name.clone(),
        found: "nothing of the kind".to_owned(),
        explanation: None,
    });
    let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("wrong-expectations.toml");
    std::fs::write(&file, listed.to_text().expect("TOML")).expect("written");
    let path = file.to_str().expect("UTF-8");
    let rules = ["--only", &taken.rule, "--only", &rule.id];
    let call = ["certify", "--controller", "rs274", "--expectations", path];
    let arguments = [call.as_slice(), &rules].concat();
    if let Some(output) = gaugeblock("strict expectations", &arguments) {
        let text = ends_with(&output, 1);
        assert!(text.contains(&format!("new: {} / {}", taken.rule, taken.case)), "{text}");
        assert!(text.contains(&format!("stale: {}", rule.id)), "{text}");
    }
}

#[test]
fn its_options_are_recovered_from_behaviour() {
    let arguments = ["fingerprint", "--controller", "rs274", "--format", "json"];
    if let Some(output) = gaugeblock("the fingerprint", &arguments) {
        let text = ends_with(&output, 0);
        let shown: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(shown["nearest"][0]["edition"], "rs274-2.9-observed");
        assert_eq!(
            shown["nearest"][0]["agree"], shown["shown"],
            "every shown option is the edition's"
        );
    }
}

#[test]
fn each_finding_has_the_one_option_that_breaks_its_assertion() {
    let arguments = [
        "certify",
        "--controller",
        "rs274",
        "--only",
        "cycles.peck",
        "--only",
        "cycles.chip-breaking",
    ];
    if let Some(output) = gaugeblock("three causes in one run of the 2.9 manual", &arguments) {
        let text = ends_with(&output, 1);
        // Each of these cases differs in the path mode and in the feed at the program end, too.
        for finding in [
            "explained by rs274.cycle-exact-path (0 cases, ",
            "explained by rs274.peck-rounding (2 cases, 2 cases of 1 other rule)",
            "explained by rs274.unused-q-minus-one (1 case)",
        ] {
            assert!(text.contains(finding), "{finding} is not in: {text}");
        }
    }
}
