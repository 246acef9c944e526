//! Statements of a post-processor.

use gaugeblock_vocabulary::{Language, Program};
use proptest::prelude::*;

use super::line;

const DECLARATIONS: &[&str] = &[
    "MODAL A;",
    "MODAL A B T;",
    "MODAL X_CURPOS;",
    "MODAL AR;",
    "MODAL ALL_VAR;",
    "NON_MODAL A;",
    "NON_MODAL X_CURPOS;",
    "IDENTICAL A B;",
    "IDENTICAL A X_CURPOS;",
    "IDENTICAL B X_CURPOS C;",
    "IDENTICAL T U;",
    "FORMAT (USER_2) A;",
    "FORMAT (FEED) X_CURPOS;",
    "RESET A;",
];
const STATEMENTS: &[&str] = &[
    "A = 1;",
    "A = 1;",
    "A = 2;",
    "A = A + 0.4;",
    "A = B;",
    "B = A;",
    "B = 1.04;",
    "B = X_CURPOS;",
    "C = 1 / 3;",
    "C = A * B - C;",
    "AR[1] = 1;",
    "AR[A] = 2;",
    "AR[2] = AR[1];",
    "T = \"x\";",
    "T = U;",
    "U = \"y\";",
    "U = \"\";",
    "OUTPUT A;",
    "OUTPUT A B;",
    "OUTPUT A ! B;",
    "OUTPUT \"N\" A;",
    "OUTPUT T U;",
    "OUTPUT AR[1] AR[2];",
    "OUTPUT X_CURPOS;",
    "OUTPUT \\J A;",
    "OUTPUT ! A \\J;",
    "OUTPUT ;",
    "SET_ON A;",
    "SET_ON X_CURPOS;",
    "SET_ON AR[1];",
    "SET_ON ALL_VAR;",
    "SET_OFF A;",
    "SET_OFF B T;",
    "SET_OFF AR[2];",
    "SET_OFF X_CURPOS;",
    "MODAL A;",
    "NON_MODAL A;",
    "RESET A;",
    "IF_SET (A)",
    "IF_SET (X_CURPOS)",
    "IF_SET (AR[1])",
    "IF_SET (A && B)",
    "IF_SET (A > 1)",
    "IF (A == 1)",
    "IF (A == B || C < 2)",
    "IF (T == U)",
    "IF (A != AR[1])",
    "ELSE",
    "END_IF;",
    "END_IF;",
    "END_IF;",
    "REPEAT",
    "UNTIL (A >= 3);",
    "UNTIL (1 == 1);",
    "UNTIL (B == 2);",
    "A = A + 1;",
    "B = B + 1;",
];
const BROKEN: &[&str] = &[
    " ;",
    " A",
    " (",
    " )",
    " \"",
    " = 1;",
    " END_IF;",
    " ELSE",
    " + 1;",
    " MOVE:",
    " `",
    " T",
    " OUTPUT A;",
    " A = \"x\";",
    " AR;",
];
const TOOLPATH: &str = "\
format USER_1 fraction=0..1
format USER_2 integer=2..4 modal=no
system X_CURPOS change USER_1
block START: X_CURPOS=1
block MOVE: X_CURPOS=1.04
block MOVE: X_CURPOS=2
";

const TOOLPATH_LINES: &[&str] = &[
    "format USER_1 fraction=0..1",
    "format USER_1 fraction=1..3 trailing=yes",
    "format USER_1 integer=2..3 leading=yes",
    "format USER_1 whole_point=no",
    "format USER_1 leading=no trailing=no",
    "format USER_1 positive=yes",
    "format USER_1 modal=yes",
    "format USER_1 width=3",
    "format CHARACTER modal=no",
    "format FEED fraction=0..0",
    "system X_CURPOS change USER_1",
    "system X_CURPOS presence FEED",
    "system TOOL_NAME change CHARACTER",
    "block START:",
    "block START: X_CURPOS=1",
    "block START: X_CURPOS=-0.04 TOOL_NAME=\"a\"",
    "block MOVE: X_CURPOS=12.345",
    "block MOVE: X_CURPOS=0.5 X_CURPOS=1",
    "block MOVE:",
    "block MOVE: FIRST: X_CURPOS=0",
    "block OTHER:",
    "block move:",
    "move X=1",
    "# a comment",
    "",
];

/// A line of a toolpath.
pub(super) fn toolpath_line() -> impl Strategy<Value = String> {
    line(TOOLPATH_LINES, &[" ", " X=1", "=", "\"", ":", " FEED", " #", "0", "-1"])
}

pub(super) fn declaration() -> impl Strategy<Value = String> {
    line(DECLARATIONS, BROKEN)
}

pub(super) fn statement() -> impl Strategy<Value = String> {
    line(STATEMENTS, BROKEN)
}

/// The declarations, the statements of a new line, those of the first block, and those of the others.
pub(super) fn program(
    [declared, newline, first, then]: [&Vec<String>; 4],
    toolpath: &[String],
) -> Program {
    let [declared, first, then] = [declared, first, then].map(|lines| lines.join("\n"));
    let newline = if newline.is_empty() {
        String::new()
    } else {
        format!("NEW_LINE_IS ! ;\n{}\n", newline.join("\n"))
    };
    let main = format!(
        "FORMAT (USER_1) A B C AR[2];\nFORMAT (CHARACTER) T U;\n{declared}\n{newline}START:\nA = 1;\nB = 2;\nT = \"x\";\n{first}\nMOVE:\n{then}\n"
    );
    let toolpath =
        if toolpath.is_empty() { TOOLPATH.to_owned() } else { toolpath.join("\n") + "\n" };
    let files = [("toolpath".to_owned(), toolpath)].into();
    Program { language: Language::Gpp, main, files, ..Program::default() }
}
