//! `gaugeblock explain`, and the single case that it says how to run.

use crate::command::gaugeblock;
use crate::command_line::refused;

#[test]
fn an_id_and_a_code_are_explained() {
    let output = gaugeblock(&["explain", "saved-state.feed"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    for part in ["saved-state.feed\n", "linuxcnc-2.9, 11.6.19", "   2 | m70", "assert "] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let output = gaugeblock(&["explain", "m73"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.starts_with("M73\n\nrules from the sections of this code:\n"), "{text}");
    assert!(text.contains("saved-state.autorestore"), "{text}");
    refused(&["explain", "saved-state.fed"], 2, &["unknown", "saved-state.feed"]);
    refused(&["explain", "saved-state"], 2, &["is a chapter", "gaugeblock rules saved-state"]);
    refused(&["explain", "M998"], 2, &["no document", "M998"]);
    for code in ["M999", "G1000"] {
        let used =
            ["no document of any edition describes", code, "hint: programs of the suite use it"];
        refused(&["explain", code], 2, &used);
    }
    for code in ["G1", "G41"] {
        let output = gaugeblock(&["explain", code]);
        assert!(!String::from_utf8_lossy(&output.stdout).contains("not specified yet"), "{code}");
    }
}

#[test]
fn a_case_is_explained_with_all_that_its_run_depends_on() {
    for (id, parts) in [
        ("pause.mode-kept", ["operator: {", "environment.name = \"whole controller\""]),
        ("subroutines.file-call", ["    file cave.ngc\n", "   1 | o<cave> sub"]),
        ("trajectory.abort", ["motion case \"from 40 mm/s\"", "script: {"]),
        (
            "saved-state.motion-mode",
            ["the rule of the same id depends on it", "    under restored\n"],
        ),
    ] {
        let output = gaugeblock(&["explain", id]);
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        for part in parts {
            assert!(text.contains(part), "{id}: {part}: {text}");
        }
    }
    let output = gaugeblock(&["explain", "pause.mode-kept", "--format", "json"]);
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let case = &document["rule"]["cases"][0];
    assert_eq!(case["environment"]["name"], "whole controller");
    assert_eq!(case["operator"][0]["action"]["mode"], "mdi");
}

#[test]
fn one_case_is_run_by_its_rule_and_name() {
    let call = ["certify", "--controller", "reference", "--only", "saved-state.feed", "--case"];
    let output = gaugeblock(&[&call[..], &["with decimals"]].concat());
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && text.contains("\n1 cases: 1 pass"), "{text}");
    refused(
        &[&call[..], &["with decimal"]].concat(),
        2,
        &["--case", "did you mean `with decimals`"],
    );
    refused(&["certify", "--case", "with decimals"], 2, &["--only"]);
}
