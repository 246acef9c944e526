//! rs274 behind an adapter in Python that has grown from the template: it reads what the program prints, and gets the verdicts that the adapter
//! that is built in gets, where that one is held to no more than the other declares.

mod common;

use std::collections::BTreeMap;
use std::io::Write as _;

use common::gaugeblock;
use gaugeblock::adapters::rs274::Rs274;
use serde_json::Value;

const ADAPTER: &str = include_str!("../adapters/rs274.py");
const TEMPLATE: &str = include_str!("../adapters/template.py");
const COMMAND: &str = concat!("exec:python3 ", env!("CARGO_MANIFEST_DIR"), "/adapters/rs274.py");

/// Chapters that the gate compares; with this variable set, the nightly run compares all.
const SAMPLE: &[&str] =
    &["saved-state", "arcs", "tool", "active-comments", "fanuc-subs", "program-end"];
const ALL: &str = "GAUGEBLOCK_ALL_CHAPTERS";

/// Why the adapter in Python leaves out what the other one runs: without blocks it cannot tell what happened, and a mode that no call
/// switches it does not see, where the other one asks for it.
const LEFT_OUT: &[&str] = &[
    "a program that does not end",
    "M99 in the main program ends it",
    "HAL is asked for, which is shared by the whole machine",
    "nothing was shown of what its assertions are about",
];

type Cases = BTreeMap<(String, String), (String, Value)>;

/// What came of each case: the verdict, and what was found, or why it was not judged.
fn cases(arguments: &[&str]) -> Cases {
    let output = gaugeblock(&[&["certify", "--format", "json"], arguments].concat());
    let report: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|error| {
        panic!("{error}: {}", String::from_utf8_lossy(&output.stderr));
    });
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let told = report["cases"].as_array().expect("cases").iter().map(|case| {
        let why = &case["why"];
        let why = if why["found"].is_null() { &why["reason"] } else { &why["found"] };
        ((word(&case["rule"]), word(&case["case"])), (word(&case["verdict"]), why.clone()))
    });
    told.collect()
}

#[test]
fn it_stands_on_the_protocol_part_of_the_template() {
    let protocol = |text: &'static str| {
        text.find("for request in map").map(|at| &text[at..]).expect("the loop of the protocol")
    };
    assert_eq!(protocol(ADAPTER), protocol(TEMPLATE));
    let part = "class Unsupported(Exception):\n    \"\"\"The controller does not have what the scenario needs.\"\"\"\n";
    assert!(ADAPTER.contains(part) && TEMPLATE.contains(part));
}

#[test]
fn it_gets_the_verdicts_of_the_adapter_that_is_built_in() {
    if let Err(error) = Rs274::find(None) {
        // Written past the test runner, which keeps what passing tests print to itself.
        let notice = format!("left out: rs274 behind an adapter in Python ({error})\n");
        std::io::stderr().write_all(notice.as_bytes()).expect("standard error can be written");
        return;
    }
    let sample = if std::env::var_os(ALL).is_some() { &[] } else { SAMPLE };
    let only: Vec<&str> = sample.iter().flat_map(|chapter| ["--only", chapter]).collect();
    let python = cases(&[&[COMMAND], only.as_slice()].concat());
    let built_in = cases(&[&["rs274", "--as", COMMAND], only.as_slice()].concat());
    assert_eq!(python.keys().collect::<Vec<_>>(), built_in.keys().collect::<Vec<_>>());
    let mut left_out = 0;
    let mut wrong = Vec::new();
    for (case, theirs) in &python {
        let ours = &built_in[case];
        // Reasons of what is not run are for people.
        let same = theirs == ours || theirs.0 == ours.0 && theirs.0 == "unsupported";
        let is_left_out =
            theirs.0 == "unsupported" && LEFT_OUT.iter().any(|why| theirs.1.as_str() == Some(*why));
        left_out += usize::from(!same && is_left_out);
        if !same && !is_left_out {
            wrong.push(format!("{case:?}: in Python {theirs:?}, built in {ours:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let judged = |word: &str| python.values().filter(|(verdict, _)| verdict == word).count();
    assert!(judged("pass") > 100 && judged("diverges") > 5, "it judges too little");
    assert!(left_out * 20 < python.len(), "{left_out} of {} are left out", python.len());
}
