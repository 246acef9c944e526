//! A controller that declares a part of the language: the referee leaves out programs that need more, and says what.

use std::path::Path;

use crate::command::gaugeblock;
use crate::template::{changed, text};

/// The toy of the template, with G0 along X and nothing else that it has.
fn controller() -> String {
    let language = "\"clock\": \"virtual\", \"language\": {\"g\": [\"0\", \"21\"], \"m\": [\"2\"], \"words\": {\"G0\": \"X\"}}";
    format!("exec:{}", changed("language.py", &[("\"clock\": \"virtual\"", language)]))
}

/// What a call prints.
fn said(call: &[&str]) -> String {
    let output = gaugeblock(call);
    format!("{}{}", text(&output.stdout), text(&output.stderr))
}

#[test]
fn program_outside_of_the_declared_language_is_left_out_by_each_command() {
    let controller = controller();
    // In a folder of its own, so that no other file belongs to the program.
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("language");
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    let program = folder.join("beyond.ngc");
    std::fs::write(&program, "g0 y1\nm2\n").expect("a file for the test");
    let program = program.to_str().expect("a path in UTF-8");
    let against = ["--controller", controller.as_str()];
    for (call, reason) in [
        (vec!["certify", "--only", "splines"], "G0 with Y: not in the declared language"),
        (vec!["certify", "--only", "arcs"], "G17: not in the declared language"),
        (
            vec!["fuzz", "--against", "reference", "--programs", "30"],
            "not in the declared language",
        ),
        (vec!["fingerprint"], "not run: G17: not in the declared language"),
        (vec!["compare", program], "G0 with Y: not in the declared language"),
    ] {
        let said = said(&[&call[..], &against[..]].concat());
        assert!(said.contains(reason), "{call:?}: {said}");
    }
}

#[test]
fn program_in_the_declared_language_is_judged() {
    let controller = controller();
    let only = ["--only", "modal-groups.g-code-out-of-range", "--controller", &controller];
    let said = said(&[&["certify"], &only[..]].concat());
    assert!(said.contains(" 0 diverge, ") && !said.contains(": 0 pass"), "{said}");
}

#[test]
fn misspelt_language_is_refused_before_any_run() {
    let language = "\"clock\": \"virtual\", \"language\": {\"g\": [\"G0\"]}";
    let controller = format!(
        "exec:{}",
        changed("misspelt-language.py", &[("\"clock\": \"virtual\"", language)])
    );
    let output = gaugeblock(&["certify", "--controller", &controller]);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stdout));
    let message = text(&output.stderr);
    assert!(
        message.contains("invalid code \"G0\" in `language.g`: expected a number"),
        "{message}"
    );
}
