//! Libraries that read G-code, with adapters of at most 120 lines each. `.ci/run` installs them and runs the adapters
//! with their expectations; here is what needs no library.

use std::path::Path;

use gaugeblock_runner::expectations::Expectations;

/// Adapters of libraries, in `examples/libraries`, and their known divergences, in `conformance/expectations`.
const LIBRARIES: [(&str, &str); 2] = [
    ("pygcode_adapter.py", "pygcode-0.2.1.toml"),
    ("gcode_toolpath_adapter.js", "gcode-toolpath-3.0.0.toml"),
];

fn in_repository(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn adapter_of_a_library_is_short_and_has_no_lexer() {
    for (adapter, _) in LIBRARIES {
        let source = in_repository(&format!("examples/libraries/{adapter}"));
        assert!(source.lines().count() <= 120, "{adapter}");
        for lexer in ["import re\n", "RegExp", ".match(", ".test(", ".replace(", "isdigit"] {
            assert!(!source.contains(lexer), "{adapter}: {lexer:?}");
        }
    }
}

#[test]
fn each_known_divergence_of_a_library_has_a_reason() {
    for (_, file) in LIBRARIES {
        let text = in_repository(&format!("conformance/expectations/{file}"));
        let read = Expectations::read(&text).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert!(!read.known.is_empty(), "{file}");
        for known in &read.known {
            let reason = read.reason(&known.rule, &known.case);
            assert!(reason.is_some(), "{file}: {} / {}", known.rule, known.case);
        }
        // A file is as `--write-expectations` writes it.
        assert_eq!(read.to_text().expect("a text"), text, "{file}");
    }
}

#[test]
fn gate_runs_each_library_from_its_registry() {
    // A command may go over several lines.
    let gate = in_repository(".ci/run").replace("\\\n", " ");
    for (adapter, file) in LIBRARIES {
        let mut calls = gate.lines().filter(|line| line.contains(adapter));
        let expectations = format!("--expectations conformance/expectations/{file}");
        assert!(calls.any(|call| call.contains(&expectations)), "{adapter}");
    }
    assert!(gate.contains("pip install") && gate.contains("npm install"));
}
