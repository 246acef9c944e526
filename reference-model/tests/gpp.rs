//! GPP: forms of the toolpath and of conditions that no page of the suite has.

use gaugeblock_reference::run;
use gaugeblock_trace::{End, Language, Options, Scenario};

/// How a program with a toolpath ends, in a word or two.
fn ending(program: &str, toolpath: &str, options: &[(&str, &str)]) -> String {
    let options =
        options.iter().map(|(id, option)| ((*id).to_owned(), (*option).to_owned())).collect();
    let mut scenario = Scenario { options: Options(options), ..Scenario::of(program) };
    scenario.program.language = Language::Gpp;
    scenario.program.files.insert("toolpath".to_owned(), toolpath.to_owned());
    let end = run(&scenario).0.end;
    if let End::Fault(fault) = &end {
        let line = fault.block.as_ref().expect("a fault of this language has a block").line;
        let kind = fault.kind.expect("a fault of the model has a kind");
        return format!("{kind} at {line}");
    }
    if let End::Unspecified { block, .. } = &end {
        return format!("open at {}", block.line);
    }
    if end == End::ProgramEnd { "accepted".to_owned() } else { format!("{end:?}") }
}

#[test]
fn numbers_of_digits_are_digits_alone() {
    for (bound, wanted) in [
        ("1..14", "accepted"),
        ("1..014", "accepted"),
        ("0001..00000000000000000000014", "accepted"),
        ("1..015", "bad_file at 1"),
        ("1..+14", "bad_file at 1"),
        ("1..", "bad_file at 1"),
        ("1..99999999999999999999999", "bad_file at 1"),
    ] {
        let toolpath = format!("format REAL fraction={bound}");
        assert_eq!(ending("START:", &toolpath, &[]), wanted, "{bound}");
    }
}
