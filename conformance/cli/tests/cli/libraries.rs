//! Libraries that read G-code, with adapters of a hundred lines each. Each divergence of pygcode from the manual is an
//! expectation with its reason. If pygcode is not installed, the test reports that it is left out.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::command::gaugeblock;
use crate::template::text;

/// Adapters of libraries, in `examples/libraries`.
const ADAPTERS: [&str; 2] = ["pygcode_adapter.py", "gcode_toolpath_adapter.js"];

/// The known divergences of pygcode, in `conformance/expectations`.
const PYGCODE: &str = "pygcode-0.2.1.toml";

fn in_repository(folder: &str, file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder).join(file)
}

#[test]
fn pygcode_differs_from_the_manual_where_its_expectations_say() {
    let mut probe = Command::new("python3");
    let probe = probe.args(["-c", "import pygcode"]).stderr(Stdio::null()).status();
    if !probe.is_ok_and(|status| status.success()) {
        // Written past the test runner, which keeps what passing tests print to itself.
        let notice = b"left out: pygcode (pip install pygcode==0.2.1)\n";
        std::io::stderr().write_all(notice).expect("standard error can be written");
        return;
    }
    let adapter = in_repository("examples/libraries", ADAPTERS[0]);
    let controller = format!("exec:python3 {}", adapter.display());
    let expectations = in_repository("conformance/expectations", PYGCODE);
    let expectations = expectations.to_str().expect("a path in UTF-8");
    let call = ["certify", "--controller", &controller, "--expectations", expectations];
    let output = gaugeblock(&call);
    let said = format!("{}{}", text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{said}");
}

#[test]
fn adapter_of_a_library_is_short_and_has_no_lexer() {
    for adapter in ADAPTERS {
        let source = in_repository("examples/libraries", adapter);
        let source = std::fs::read_to_string(source).expect("the adapter");
        assert!(source.lines().count() <= 120, "{adapter}");
        for lexer in ["import re\n", "RegExp", ".match(", ".test(", ".replace(", "isdigit"] {
            assert!(!source.contains(lexer), "{adapter}: {lexer:?}");
        }
    }
}

#[test]
fn each_known_divergence_of_pygcode_has_a_reason() {
    let file = in_repository("conformance/expectations", PYGCODE);
    let text = std::fs::read_to_string(file).expect("the expectations");
    // A reason is a comment before the first divergence that it explains.
    let first = text.find("\n# ").expect("a reason");
    assert!(first < text.find("[[known]]").expect("a divergence"));
}
