//! `rs274` through the adapter protocol gets the same verdict for each case as the built-in adapter: served by this
//! command, and by a Python adapter that is based on the template.

use std::collections::BTreeMap;
use std::io::Write as _;

use gaugeblock_linuxcnc::Rs274;
use serde_json::Value;

use crate::command::gaugeblock;

const ADAPTER: &str = include_str!("../../../linuxcnc/python/rs274.py");
const TEMPLATE: &str = include_str!("../../../adapter/templates/template.py");
const COMMAND: &str =
    concat!("exec:python3 ", env!("CARGO_MANIFEST_DIR"), "/../linuxcnc/python/rs274.py");

/// Chapters that the gate compares; with this variable set, the nightly run compares all.
const SAMPLE: &[&str] = &["tool", "active-comments", "fanuc-subs"];
const ALL: &str = "GAUGEBLOCK_ALL_CHAPTERS";

/// The line that an adapter with the extension `shows` adds to the loop of the template.
const SHOWS: &str = "    answer = {\"shows\": shows(request[\"scenario\"])} if request[\"op\"] == \"shows\" else answer\n";

type Cases = BTreeMap<(String, String), (String, Value)>;

/// For each case its verdict, and the found value or the reason why it was not judged.
fn cases(arguments: &[&str]) -> Cases {
    let output =
        gaugeblock(&[&["certify", "--format", "json", "--controller"], arguments].concat());
    let report: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|error| {
        panic!("{error}: {}", String::from_utf8_lossy(&output.stderr));
    });
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let cases = report["cases"].as_array().expect("cases").iter().map(|case| {
        let why = &case["why"];
        let why = if why["found"].is_null() { &why["reason"] } else { &why["found"] };
        ((word(&case["rule"]), word(&case["case"])), (word(&case["verdict"]), why.clone()))
    });
    cases.collect()
}

#[test]
fn grown_adapter_contains_the_template() {
    let protocol = |text: &'static str| {
        text.find("for request in map").map(|at| &text[at..]).expect("the loop of the protocol")
    };
    assert_eq!(protocol(ADAPTER).replacen(SHOWS, "", 1), protocol(TEMPLATE));
    let part = "class Unsupported(Exception):\n    \"\"\"The controller does not have what the scenario needs.\"\"\"\n";
    assert!(ADAPTER.contains(part) && TEMPLATE.contains(part));
}

/// Whether `rs274` is installed. If it is not, a notice names the skipped test.
fn is_there() -> bool {
    let found = Rs274::find(None);
    if let Err(error) = &found {
        // Written past the test runner, which keeps what passing tests print to itself.
        let notice = format!("left out: rs274 through the protocol ({error})\n");
        std::io::stderr().write_all(notice.as_bytes()).expect("standard error can be written");
    }
    found.is_ok()
}

/// Compares the cases of two controllers, those of the sample or all, and returns them.
fn same(one: &[&str], other: &[&str]) -> Cases {
    let sample = if std::env::var_os(ALL).is_some() { &[] } else { SAMPLE };
    let only: Vec<&str> = sample.iter().flat_map(|chapter| ["--only", chapter]).collect();
    let (one, mut other) = (cases(&[one, &only].concat()), cases(&[other, &only].concat()));
    assert_eq!(one.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>());
    let mut wrong = Vec::new();
    for (case, found) in &one {
        let expected = other.remove(case).expect("a case of both");
        // The reasons of unsupported cases may differ.
        let same = *found == expected || found.0 == expected.0 && found.0 == "unsupported";
        if !same {
            wrong.push(format!("{case:?}: {found:?}, not {expected:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    one
}

/// Compares the verdicts of a controller with those of the built-in adapter for `rs274`.
fn check_verdicts_of(command: &str) {
    if is_there() {
        let found = same(&[command], &["rs274"]);
        let judged = |word: &str| found.values().filter(|(verdict, _)| verdict == word).count();
        assert!(judged("pass") > 700 && judged("diverges") > 90, "it judges too little");
    }
}

#[test]
fn protocol_adapter_gets_the_verdicts_of_the_built_in_one() {
    let served = format!("exec:{} serve --controller rs274", env!("CARGO_BIN_EXE_gaugeblock"));
    check_verdicts_of(&served);
}

#[test]
fn in_python_it_gets_the_verdicts_of_the_adapter_that_is_built_in() {
    check_verdicts_of(COMMAND);
}
