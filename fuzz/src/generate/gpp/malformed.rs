//! Programs and toolpaths with something wrong in a line.

use crate::generate::Entropy;

/// What does not belong where it is put.
const WORDS: &[&str] = &[
    ";",
    "(",
    ")",
    "[",
    "]",
    "=",
    "==",
    "&&",
    "||",
    "!",
    ":",
    "+",
    "-",
    "\"",
    "\"a\"",
    "\\J",
    "1.2.3",
    "3D",
    "99999999999999999999999999999999999999999",
    "`",
    "\u{e9}",
    ",",
    "A",
    "T",
    "AR",
    "NONE",
    "X_NONE",
    "OUTPUT",
    "FEED",
    "ELSE",
    "END_IF;",
    "REPEAT",
    "UNTIL (1 == 1);",
    "IF (1 == 1)",
    "MODAL A;",
    "RESET A;",
    "ALL_VAR",
    "NON_MODAL A;",
    "IF_SET (A && B)",
    "SIN(1)",
    "VAR_SET(A)",
    "AR[0]",
    "AR[9]",
    "1 / 0",
    "_EQ_",
    "<",
    "//",
    "FORMAT (USER_1) A;",
    "FORMAT (USER_1) X_CURPOS;",
    "IDENTICAL A T;",
    "NEW_LINE_IS ! ;",
    "$",
    "GLOBAL A;",
    "OUTPUT A + 1;",
    "A = \"x\";",
    "IF (A) END_IF;",
    "START:",
    "MOVE:",
    "SET_ON AR[9];",
    "A = AR;",
];

/// Declarations that are not allowed for some variables, or ever.
const DECLARATIONS: &[&str] = &[
    "MODAL AR[1];",
    "MODAL AR;",
    "IDENTICAL A AR;",
    "IDENTICAL A T;",
    "IDENTICAL A;",
    "FORMAT (USER_1) A;",
    "FORMAT (USER_1) OUTPUT;",
    "FORMAT (USER_1) AR[0];",
    "FORMAT (USER_1) Z[25000];",
    "NON_MODAL A T;",
    "MODAL A",
    "FORMAT (CHARACTER) X_CURPOS;",
    "IDENTICAL X_CURPOS Y_CURPOS;",
    "FORMAT (USER_1) MY_OWN;",
    "RESET A;",
];

/// Lines and words of a toolpath that is none.
const TOOLPATH: &[&str] = &[
    "move X=1",
    "format USER_1 width=3",
    "format USER_1 integer=5..4",
    "format CHARACTER integer=1..2",
    "system X_CURPOS change USER_1",
    "system XCURPOS change USER_1",
    "block",
    "block START",
    "block :",
    "block START: X_CURPOS=1 X_CURPOS=2",
    "block START: NO_NAME=1",
    "block START: X_CURPOS=\"a\"",
    "block START: X_CURPOS=1.",
    "format REAL fraction=0..15",
    "system A_B sometimes FEED",
    "block START: :",
    "format FEED modal=perhaps",
    "block START: TOOL_NAME=1",
    "format LENGTH",
    "  ",
    "# x",
];

/// The text with one thing wrong.
pub(super) fn mutated_block(text: &str, is_program: bool, entropy: &mut Entropy<'_>) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let table = if is_program { WORDS } else { TOOLPATH };
    if lines.is_empty() {
        return format!("{}\n", entropy.pick(table));
    }
    let count = u32::try_from(lines.len()).unwrap_or(u32::MAX);
    let place = usize::try_from(entropy.below(count)).unwrap_or_default();
    let other = usize::try_from(entropy.below(count)).unwrap_or_default();
    match entropy.below(8) {
        0 => {
            lines.remove(place);
        }
        1 => lines.swap(place, other),
        2 => {
            let line = lines[other].clone();
            lines.insert(place, line);
        }
        3 if is_program && entropy.chance(30) => {
            let at = usize::try_from(entropy.range(1, 4)).unwrap_or_default().min(lines.len());
            lines.insert(at, (*entropy.pick(DECLARATIONS)).to_owned());
        }
        3 => lines.insert(place, (*entropy.pick(table)).to_owned()),
        4 => {
            let at = usize::try_from(entropy.below(120)).unwrap_or_default();
            let kept = lines[place].chars().enumerate().filter(|(place, _)| *place != at);
            lines[place] = kept.map(|(_, character)| character).collect();
        }
        _ if is_program => {
            let mut words: Vec<&str> = lines[place].split(' ').collect();
            let count = u32::try_from(words.len()).unwrap_or(u32::MAX);
            let at = usize::try_from(entropy.below(count)).unwrap_or_default();
            let word = *entropy.pick(table);
            if entropy.chance(50) {
                words.insert(at, word);
            } else {
                words[at] = word;
            }
            lines[place] = words.join(" ");
        }
        _ => lines[place] = (*entropy.pick(table)).to_owned(),
    }
    lines.join("\n") + "\n"
}
