//! Programs with something wrong in a block.

use crate::generate::Entropy;

/// What does not belong where it is put.
const WORDS: &[&str] = &[
    "[",
    "]",
    "=",
    "#",
    "##1",
    "+",
    "-",
    "*",
    "X",
    "X1",
    "I1",
    "P1",
    "L2",
    "U1",
    "Q5",
    "N5",
    "O2",
    "N#1",
    "O#2",
    "1.2.3",
    ".",
    "&",
    "(",
    "(a",
    "(a(b))",
    ")",
    "%",
    "EQ",
    "AND",
    "SIN[1]",
    "SINH[1]",
    "SQRT[-1]",
    "LN[0]",
    "ASIN[2]",
    "EXP[1000]",
    "NOT 5000000000",
    "1 OR 5000000000",
    "[[[[[[1]]]]]]",
    "#34",
    "#200",
    "#600",
    "#[-1]",
    "#[1.5]",
    "#[#0]",
    "#99999999999999999999",
    "99999999999999999999999999999999999999999",
    "G17",
    "G91",
    "G0",
    "G1",
    "G65",
    "G66",
    "G66.1",
    "G67",
    "G65 P2",
    "G67 G67",
    "G33",
    "G100",
    "G-1",
    "M1",
    "M-1",
    "M1000",
    "M3 M4",
    "M7 M8",
    "M2 M30",
    "M98",
    "M99",
    "M98 M99",
    "T-1",
    "S-1",
    "F-1",
    "F0",
    "L0",
    "L10000",
    "L2 L3",
    "P312345678901234567890",
    "G4",
    "G4 G4 P1",
    "G4 P-1",
    "T99999999999",
    "R0",
    "R1 I1",
    "K5",
    "é",
];

/// Blocks that are refused, or that the documents leave open.
const BLOCKS: &[&str] = &[
    "G65",
    "G65 A1",
    "G65 P99",
    "G65 P-1",
    "G65 P2 P3",
    "G65 P2 L0",
    "G65 P2 L2 L3",
    "G65 P2 G1",
    "X1 G65 P2",
    "G65 P2 I1 I2 I3 I4 I5 I6 I7 I8 I9 I10 I11",
    "G65 P2 A1 A2",
    "G66 P99",
    "G66 P-1",
    "G66 P312345678901234567890",
    "G65 P312345678901234567890 L0",
    "G66 A1",
    "G66.1 P2 X1",
    "G67",
    "G67 X1",
    "G65 G66 P2",
    "M98 P99",
    "M98",
    "M98 P2 L0",
    "M98 G4 P2",
    "M99 P5",
    "M99 P312345678901234567890",
    "M99",
    "GOTO99",
    "GOTO-1",
    "GOTO#0",
    "GOTO",
    "GOTO5 X1",
    "IF [1 EQ 1] GOTO",
    "IF [1 EQ 1]",
    "IF [1] GOTO77",
    "IF [1 EQ 1 EQ 1] GOTO77",
    "IF [1 EQ 1] THEN #1 = 2",
    "IF [#0 LT 0] GOTO77",
    "IF [#0 EQ 5] GOTO77",
    "WHILE [1 EQ 2] DO1",
    "END1",
    "/END1",
    "/WHILE [1 EQ 2] DO1",
    "END4",
    "DO1",
    "WHILE [1 EQ 1] DO4",
    "WHILE [1 EQ 1]",
    "#0 = 1",
    "#0 = #0",
    "#34 = 1 / 0",
    "#1 = 1 / 0",
    "#1 = 5 MOD 0",
    "#1 =",
    "#1 2",
    "#1 = A",
    "= 1",
    "N1 N2",
    "N",
    "N5. X1",
    "N123456789",
    "N+5",
    "O",
    "O7",
    "O1",
    "O1 G0 X1",
    "/N5 G0 X",
    "//1",
    "/#1",
    "/5",
    "/O9",
    "N77",
    "G0 G1 X1",
    "G17 G33 G18",
    "G2 X1",
    "G2 X9 R1",
    "G2 X2 I1 K1",
    "G17 G2 X1 R5 K1",
    "G2 I1 R1",
    "G1 X1 I1",
    "G18 G2 X5 I1",
    "M6 M6",
    "M0",
    "%X1",
    "M30",
    "G65 P1",
    "M98 P1",
    "G91 G20 X1E",
    "G0 U5",
    "G90 X1 X2",
    "G66 P2\nG66.1 P2",
    "#1 = COS SIN 30",
    "#1 = 2 * + * 3",
    "#1 = --1",
];

/// The text with one thing wrong.
pub(super) fn mutated_block(text: &str, entropy: &mut Entropy<'_>) -> String {
    let mut lines: Vec<String> = text.split('\n').map(str::to_owned).collect();
    let count = u32::try_from(lines.len()).unwrap_or(u32::MAX);
    let place = usize::try_from(entropy.below(count)).unwrap_or_default();
    let other = usize::try_from(entropy.below(count)).unwrap_or_default();
    match entropy.below(10) {
        0 => {
            lines.remove(place);
        }
        1 => lines.swap(place, other),
        2 => {
            let line = lines[other].clone();
            lines.insert(place, line);
        }
        3..=5 => lines.insert(place, (*entropy.pick(BLOCKS)).to_owned()),
        6 => {
            let at = usize::try_from(entropy.below(40)).unwrap_or_default();
            let kept = lines[place].chars().enumerate().filter(|(place, _)| *place != at);
            lines[place] = kept.map(|(_, character)| character).collect();
        }
        _ => {
            let mut words: Vec<&str> = lines[place].split(' ').collect();
            let count = u32::try_from(words.len()).unwrap_or(u32::MAX);
            let at = usize::try_from(entropy.below(count)).unwrap_or_default();
            let word = *entropy.pick(WORDS);
            if entropy.chance(50) {
                words.insert(at, word);
            } else {
                words[at] = word;
            }
            lines[place] = words.join(" ");
        }
    }
    lines.join("\n")
}
