//! `--format json`: each document has the form of its schema, and the exit status of its call.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::command::gaugeblock;

/// The folder of recorded samples.
fn recorded() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../recorded")
}

fn path(file: &Path) -> String {
    file.to_str().expect("a path in UTF-8").to_owned()
}

/// The document that a call prints. It has the form that `schema` prints for this name.
fn document(schema: &str, call: &[&str]) -> Value {
    let printed = gaugeblock(&["schema", schema]).stdout;
    let printed: Value = serde_json::from_slice(&printed).expect("a schema");
    let validator = jsonschema::validator_for(&printed).expect("a valid schema");
    let output = gaugeblock(&[call, &["--format", "json"]].concat());
    let errors = String::from_utf8_lossy(&output.stderr);
    let document: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{call:?}: {error}: {errors}"));
    let wrong: Vec<String> = validator.iter_errors(&document).map(|it| it.to_string()).collect();
    assert_eq!(wrong, Vec::<String>::new(), "{call:?}: {document:#}");
    assert!(!validator.is_valid(&serde_json::json!({})), "{schema} admits everything");
    assert_eq!(document["gaugeblock"], schema, "{call:?}");
    assert_eq!(document["exit_status"].as_i64(), output.status.code().map(i64::from), "{call:?}");
    document
}

#[test]
fn motion_document_has_the_verdict_of_each_rule() {
    let folder = recorded();
    let file = |name: &str| path(&folder.join(name));
    let (program, machine) = (file("square-stops.ngc"), file("mill.toml"));
    let planned = document("motion", &["plan", &program, "--machine", &machine]);
    let call = [
        "motion",
        "check",
        &file("square-stops.csv"),
        "--program",
        &program,
        "--machine",
        &machine,
    ];
    let checked = document("motion", &call);
    for judged in [planned, checked] {
        let rules = judged["rules"].as_array().expect("rules");
        let holds =
            |rule: &&Value| rule["rule"] == "trajectory.velocity" && rule["verdict"] == "holds";
        assert!(rules.iter().any(|rule| holds(&rule)), "{judged:#}");
        assert!(judged["seconds"].as_f64().expect("seconds") > 0.0);
    }
    let other = file("square-within.csv");
    let call = ["motion", "check", &other, "--program", &program, "--machine", &machine];
    let broken = document("motion", &call);
    assert_eq!(broken["exit_status"], 1, "{broken:#}");
    let rules = broken["rules"].as_array().expect("rules").iter();
    let violations =
        rules.filter(|rule| rule["verdict"] == "broken").map(|rule| &rule["violations"]);
    assert!(violations.flat_map(|all| all.as_array().expect("a list")).count() > 0, "{broken:#}");
}

#[test]
fn no_motion_rule_holds_where_nothing_moves() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let program = folder.join("formats-still.ngc");
    fs::write(&program, "g21\nm2\n").expect("it is written");
    let (program, machine) = (path(&program), path(&recorded().join("mill.toml")));
    let call = ["plan", &program, "--machine", &machine];
    let document = document("motion", &call);
    let holds =
        document["rules"].as_array().expect("rules").iter().any(|rule| rule["verdict"] == "holds");
    assert!(!holds && document["exit_status"] == 3, "{document:#}");
    let text = String::from_utf8_lossy(&gaugeblock(&call).stdout).into_owned();
    assert!(text.contains("nothing moves") && !text.contains("  holds "), "{text}");
}

#[test]
fn documents_of_checks_and_of_motion_fuzz_have_the_form_of_their_schemas() {
    let fuzzed = document("motion-fuzz", &["motion", "fuzz", "--programs", "4"]);
    assert_eq!(fuzzed["programs"], 4);
    let adapter = format!("{} serve --controller production", env!("CARGO_BIN_EXE_gaugeblock"));
    let checked = document("adapter-check", &["adapter", "check", &adapter]);
    assert!(checked["checks"].as_array().expect("checks").len() > 5, "{checked:#}");
    let suite = document("suite-check", &["suite", "check"]);
    assert!(suite["rules"].as_u64() > Some(100) && suite["errors"] == serde_json::json!([]));
}

#[test]
fn adapter_that_says_nothing_gets_a_hint() {
    let output = gaugeblock(&["certify", "--controller", "exec:sleep 60"]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{message}");
    assert!(message.contains("no answer to `hello` within 10 s"), "{message}");
    assert!(message.contains("hint: run the command by hand"), "{message}");
}
