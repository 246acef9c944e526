//! Controllers of the Grbl family on the command line; `gaugeblock-grbl` tests them at a simulator.

use crate::command_line::refused;

#[test]
fn machine_does_not_move_unless_a_person_or_the_name_confirms_it() {
    refused(
        &["certify", "--controller", "grbl:/dev/null?motion=real"],
        2,
        &["motion is not confirmed", "motion=real&yes"],
    );
}

#[test]
fn wrong_name_is_refused_with_what_was_expected() {
    for (name, words) in [
        ("grbl:", "missing address"),
        ("grbl:no-such-device", "expected DEVICE"),
        ("grbl:/dev/null?fast", "expected one of motion=real"),
    ] {
        refused(&["certify", "--controller", name], 2, &[words, "for example"]);
    }
}

#[test]
fn controller_that_is_not_there_is_a_failure_with_a_hint() {
    refused(&["certify", "--controller", "grbl:/nowhere/tty"], 3, &["/nowhere/tty", "hint: check"]);
}
