//! What the executor itself decides: costs, refusals in bounded memory, and that no text makes it panic.

extern crate std;

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use gaugeblock_vocabulary::{Effect, Options, Settings};
use proptest::prelude::*;

use super::*;
use crate::canon::Reply;

#[derive(Debug, Default)]
struct Recorder {
    output: String,
    costs: Vec<u64>,
    told: Vec<String>,
}

impl Sink for Recorder {
    fn set(&mut self, _line: u32, _changed: &Settings) {}

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        if let Effect::Message { text, .. } = effect {
            self.output.push_str(text);
        }
        Reply::Done
    }

    fn end_statement(&mut self, done: &StatementEnd<'_>) {
        for change in done.changes() {
            self.told.push(alloc::format!("{} {:?} {:?}", change.name, change.text, change.on));
        }
    }
}

/// What a run prints and costs, and how it ends after so many steps.
fn run(program: &str, toolpath: &str, options: &Options, most: u32) -> (Recorder, String) {
    let mut recorder = Recorder::default();
    let mut post = match PostProcessor::new(program, Some(toolpath), options) {
        Ok(post) => post,
        Err(NotCompiled::Ended(end)) => {
            return (recorder, alloc::format!("{end:?}"));
        }
        Err(NotCompiled::Configuration(error)) => return (recorder, error.to_string()),
    };
    for _ in 0..most {
        if !post.has_next() {
            return (recorder, "program_end".into());
        }
        match post.step(&mut recorder) {
            Ok(cost) => recorder.costs.push(cost),
            Err(fault) => return (recorder, alloc::format!("{:?}", fault.kind)),
        }
    }
    (recorder, "more".into())
}

#[test]
fn a_step_costs_its_items_and_what_it_sets() {
    let program = "\
FORMAT (USER_1) A B AR[9];
IDENTICAL A B;
MODAL A;
START:
A = 1;
OUTPUT A \"x\" B;
SET_ON AR A AR;
IF (A == 1) END_IF;
";
    let (recorder, end) = run(program, "block START:\n", &Options::default(), 100);
    assert_eq!(end, "program_end");
    assert_eq!(recorder.costs, [1, 3, 6, 12, 1]);
    assert_eq!(recorder.output, "1x1");
}

#[test]
fn oversized_program_is_refused_at_once() {
    let named = |program: &str, toolpath: &str, kind: &str| {
        let (_, end) = run(program, toolpath, &Options::default(), 100);
        assert!(end.contains(kind), "{program}\n{toolpath}\n{end}");
    };
    let start = "block START:\n";
    named("FORMAT (USER_1) A[1000000000];\nSTART:\n", start, "TooManyVariables");
    named("FORMAT (USER_1) A[99999999999999999999999];\nSTART:\n", start, "TooManyVariables");
    named("START:\n", "format USER_1 fraction=0..1000000000\n", "BadFile");
    named("START:\n", "format USER_1 integer=1..99999999999999999999\n", "BadFile");
    let deep = |open: &str, close: &str| {
        let (open, close) = (open.repeat(100_000), close.repeat(100_000));
        alloc::format!("FORMAT (USER_1) A;\nSTART:\nA = {open}1{close};\n")
    };
    named(&deep("(", ")"), start, "TooManyLevels");
    named(&deep("-", ""), start, "TooManyLevels");
    named(&alloc::format!("START:\n{}", "IF (1 == 1)\n".repeat(100_000)), start, "TooManyLevels");
    named(&alloc::format!("START:\nOUTPUT \"{}\";\n", "a".repeat(1 << 20)), start, "TextTooLong");
    let number = "9".repeat(1 << 20);
    named(&alloc::format!("FORMAT (USER_1) A;\nSTART:\nA = {number};\n"), start, "BadNumber");
}

#[test]
fn identical_variables_in_a_ring_are_one() {
    let mut program = String::from("FORMAT (USER_1)");
    for number in 0..5000 {
        program.push_str(&alloc::format!(" V{number}"));
    }
    program.push_str(";\n");
    for number in 0..5000 {
        program.push_str(&alloc::format!("IDENTICAL V{number} V{};\n", (number + 1) % 5000));
    }
    program.push_str("START:\nV17 = 1;\nOUTPUT V4999;\n");
    let (recorder, end) = run(&program, "block START:\n", &Options::default(), 100);
    assert_eq!((end.as_str(), recorder.output.as_str()), ("program_end", "1"));
    assert_eq!(recorder.costs, [1, 5001, 2]);
}

#[test]
fn a_toolpath_has_room_for_so_many_system_variables() {
    let systems = |number: u32| {
        let lines = (0..number).map(|place| alloc::format!("system S_{place} change REAL\n"));
        lines.collect::<String>()
    };
    let end = |program: &str, number| run(program, &systems(number), &Options::default(), 1).1;
    assert_eq!(end("START:\n", 25_000), "program_end");
    let full = end("START:\n", 25_001);
    assert!(full.contains("BadFile") && full.contains("line: 25001"), "{full}");
    let full = end("FORMAT (REAL) A;\nSTART:\n", 25_000);
    assert!(full.contains("TooManyVariables"), "{full}");
}

#[test]
fn a_line_of_a_toolpath_ends_with_a_line_feed_or_nothing() {
    let end = |toolpath: &str| run("START:\n", toolpath, &Options::default(), 100).1;
    for toolpath in ["block START:\r\nblock START:\r\n", "\r\nblock START:", "# x\n\n", ""] {
        assert_eq!(end(toolpath), "program_end", "{toolpath:?}");
    }
    for toolpath in [
        "block START:\r\nblock START:\r",
        "\n\r",
        "\n# x\r",
        "\nformat REAL plus=\r",
        "\nblock START:\r\r\n",
    ] {
        let end = end(toolpath);
        assert!(end.contains("BadFile") && end.contains("line: 2"), "{toolpath:?}: {end}");
    }
}

#[test]
fn what_if_set_and_until_test_is_a_variable() {
    let head = "FORMAT (USER_1) A AR[2];\nFORMAT (CHARACTER) T;\nMODAL A AR T;\nSTART:\nREPEAT\n";
    let end = |statement: &str, options: &Options| {
        let program = alloc::format!("{head}{statement} END_IF;\nUNTIL (1 == 1);\n");
        run(&program, "block START:\n", options, 100).1
    };
    let new = |statement: &str| end(statement, &Options::default());
    for statement in ["IF_SET (A)", "IF_SET ((A))", "IF_SET (AR[1 + 1])", "IF_SET (((T)))"] {
        assert_eq!(new(statement), "program_end", "{statement}");
    }
    for (statement, kind) in [
        ("IF_SET (NOPE(1))", "NoSuchVariable"),
        ("IF_SET (A(1))", "Statement"),
        ("IF_SET (A && NOPE(1))", "Statement"),
        ("IF_SET (A || A)", "Statement"),
        ("IF_SET (A > 1)", "Statement"),
        ("IF_SET ((A > 1))", "Statement"),
        ("IF_SET (-A)", "Statement"),
        ("IF_SET (!A)", "Statement"),
        ("IF_SET (VAR_SET(A))", "Statement"),
        ("IF_SET (\"x\")", "Statement"),
        ("IF_SET ()", "Statement"),
        ("UNTIL (A || A);", "Statement"),
    ] {
        let end = new(statement);
        assert!(end.contains(kind) && end.contains("line: 6"), "{statement}: {end}");
    }
    let old = Options([("gpp.old-words".into(), "accepted".into())].into_iter().collect());
    for (statement, options) in [
        ("IF_SET (NOPE(1))", &old),
        ("IF_SET (A || A)", &old),
        ("IF_SET (AR[NOPE(1)])", &Options::default()),
        ("UNTIL (VAR_SET(A) || A > 1);", &Options::default()),
    ] {
        assert!(end(statement, options).contains("Unspecified"), "{statement}");
    }
}

#[test]
fn unknown_option_is_refused() {
    let options = Options([("gpp.tie".into(), "up".into())].into_iter().collect());
    let end = run("", "", &options, 1).1;
    assert!(end.contains("no such option"), "{end}");
}

/// Parts that programs are made of.
const PARTS: &[&str] = &[
    "FORMAT (USER_1) A B;\n",
    "FORMAT (CHARACTER) T;\n",
    "FORMAT (REAL) AR[3];\n",
    "MODAL A;\n",
    "IDENTICAL A B;\n",
    "NEW_LINE_IS ! ;\n",
    "START:\n",
    "START: Q:\n",
    "A = ",
    "B = 1;\n",
    "T = \"x\";\n",
    "AR[A] = 1e9;\n",
    "A = A * 99999999999;\n",
    "OUTPUT ",
    "PRINT A ! T;\n",
    "SET_ON AR;\n",
    "SET_OFF ALL_VAR;\n",
    "RESET A;\n",
    "IF (A == 1)\n",
    "IF_SET (A)\n",
    "ELSE\n",
    "END_IF;\n",
    "REPEAT\n",
    "UNTIL (A > 3);\n",
    "A = A + 1;\n",
    "(",
    ")",
    "[",
    "]",
    ";",
    "-",
    "/",
    "0",
    "1.5",
    ".",
    "\"",
    "\\J",
    "!",
    "&&",
    "||",
    "VAR_SET(A)",
    "\n*",
    "//",
    "\u{e9}",
    "\r",
    "\0",
];

/// Parts that toolpaths are made of.
const LINES: &[&str] = &[
    "block START:\n",
    "block START: Q: X_CURPOS=1.5\n",
    "block START: X_CURPOS=-1e5\n",
    "system X_CURPOS change USER_1\n",
    "system P_T presence CHARACTER\n",
    "block START: P_T=\"a:b\"\n",
    "format USER_1 integer=0..14 fraction=14..14 point=, zero=\n",
    "format REAL plus=\u{e9}\n",
    "block",
    ":",
    "=",
    "\"",
    "\r\n",
    "# x\n",
    "X_CURPOS=99999999999999\n",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_parts_never_panic(
        parts in proptest::collection::vec(0..PARTS.len(), 0..60),
        lines in proptest::collection::vec(0..LINES.len(), 0..12),
        classic in any::<bool>(),
    ) {
        let program: String = parts.iter().map(|part| PARTS[*part]).collect();
        let toolpath: String = lines.iter().map(|line| LINES[*line]).collect();
        let lazy = [("gpp.newline", "lazy"), ("gpp.old-words", "accepted"), ("gpp.without-value", "zero")];
        let options = lazy.into_iter().filter(|_| classic);
        let options = Options(options.map(|(id, option)| (id.into(), option.into())).collect());
        let _end = run(&program, &toolpath, &options, 300);
    }

    #[test]
    fn any_text_never_panics(program in any::<String>(), toolpath in any::<String>()) {
        let _end = run(&program, &toolpath, &Options::default(), 300);
    }

    /// A number is rounded as its exact decimal expansion says.
    #[test]
    fn numbers_are_rounded_exactly(value in -1e13_f64..1e13, places in 0_u32..=14, even in any::<bool>()) {
        let mut format = formats::defaults()[18].clone();
        format.integer = (1, 14);
        format.fraction = (places, places);
        let decimal = format.rounded(value, even).unwrap();
        let mut text = String::new();
        format.print(decimal, &mut text);
        let width = usize::try_from(places).unwrap();
        let exact = alloc::format!("{value:.1100}");
        let cut = exact.find('.').unwrap() + 1 + width;
        // A tie has no digit but a five behind the cut.
        let is_tie = exact[cut..].trim_end_matches('0') == "5";
        if !is_tie {
            let expected = alloc::format!("{value:.width$}");
            let expected = expected.trim_start_matches('-');
            prop_assert_eq!(text.trim_start_matches('-'), expected);
            prop_assert_eq!(decimal.nearest().abs().to_bits(), expected.parse::<f64>().unwrap().to_bits());
        }
    }
}
