//! GPP: forms of the toolpath and of conditions that no page of the suite has.

use gaugeblock_reference::run;
use gaugeblock_vocabulary::{End, Language, Options, Scenario};

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

fn condition(statement: &str, options: &[(&str, &str)]) -> String {
    let program = format!("FORMAT (USER_1) A B AR[2];\nMODAL A B;\nSTART:\n{statement}\n");
    ending(&program, "", options)
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

/// A variable alone is all that UNTIL tests, and no test that `||` could stand behind.
#[test]
fn nothing_stands_behind_a_variable_alone_in_until() {
    for (tests, wanted) in [
        ("A", "accepted"),
        ("A && B", "statement at 4"),
        ("A || B", "statement at 4"),
        ("A && B || A == 1", "statement at 4"),
        ("A == 1 || B", "open at 4"),
        ("VAR_SET(A) || B", "open at 4"),
    ] {
        let statement = format!("REPEAT UNTIL ({tests});");
        assert_eq!(condition(&statement, &[]), wanted, "{tests}");
    }
}

/// `IF_SET` tests a reference: what would be open in a condition is none of it, and the index of a member is an
/// expression.
#[test]
fn what_is_open_in_a_condition_is_refused_where_there_is_none() {
    for (tested, wanted, in_old) in [
        ("NOPE(1)", "statement at 4", "open at 4"),
        ("A || B", "statement at 4", "open at 4"),
        ("AR[NOPE(1)]", "open at 4", "open at 4"),
    ] {
        let statement = format!("IF_SET ({tested}) END_IF;");
        assert_eq!(condition(&statement, &[]), wanted, "{tested}");
        let old = [("gpp.old-words", "accepted")];
        assert_eq!(condition(&statement, &old), in_old, "{tested}");
    }
}

#[test]
fn a_line_of_a_toolpath_ends_with_a_line_feed_or_with_the_file() {
    for toolpath in ["block START:\r\nblock START:", "# x\r\n", "\n", "# x"] {
        assert_eq!(ending("START:\n", toolpath, &[]), "accepted", "{toolpath:?}");
    }
    for toolpath in ["\n# x\r", "\n# x\r\r", "\nformat REAL plus=\r", "\n\r"] {
        assert_eq!(ending("START:\n", toolpath, &[]), "bad_file at 2", "{toolpath:?}");
    }
}
