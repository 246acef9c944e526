//! Numbers, variables, expressions and conditions, and how a block may be spelled.

use crate::generate::Entropy;

const NUMBERS: &[&str] =
    &["0", "1", "2", "3", "7", "10", "12", "100", "0.5", ".25", "1.5", "2.", "3.75", "0.001"];

/// A number without a sign.
pub(super) fn number(entropy: &mut Entropy<'_>) -> String {
    (*entropy.pick(NUMBERS)).to_owned()
}

/// The number of a variable that may be read or set. Counters of loops are not among them.
fn place(entropy: &mut Entropy<'_>) -> u32 {
    match entropy.below(10) {
        0..=5 => entropy.range(1, 12),
        6 => entropy.range(24, 33),
        7 | 8 => entropy.range(100, 103),
        _ => *entropy.pick(&[13, 17, 18, 199, 500, 599]),
    }
}

/// A variable that may be set.
pub(super) fn target(entropy: &mut Entropy<'_>) -> String {
    let place = place(entropy);
    match entropy.below(12) {
        0 => format!("#[{place}]"),
        1 => format!("#[{} + {}]", place - 1, entropy.pick(&["1", "1.", "ABS[-1]"])),
        _ => format!("#{place}"),
    }
}

/// A variable that may be read.
pub(super) fn variable(entropy: &mut Entropy<'_>) -> String {
    if entropy.chance(6) { "#0".to_owned() } else { target(entropy) }
}

/// The value of a word: functions and operators are in brackets.
pub(super) fn value(entropy: &mut Entropy<'_>) -> String {
    match entropy.below(10) {
        0..=5 => format!("{}{}", sign(entropy), number(entropy)),
        6 | 7 => format!("{}{}", sign(entropy), variable(entropy)),
        _ => format!("{}[{}]", sign(entropy), expression(entropy, 2)),
    }
}

fn sign(entropy: &mut Entropy<'_>) -> &'static str {
    match entropy.below(12) {
        0 | 1 => "-",
        2 => "+",
        _ => "",
    }
}

/// An expression with brackets up to so many deep.
pub(super) fn expression(entropy: &mut Entropy<'_>, depth: u32) -> String {
    let mut text = operand(entropy, depth);
    for _ in 0..entropy.below(3) {
        let (operator, right) = match entropy.below(12) {
            0..=3 => (*entropy.pick(&["+", "-"]), operand(entropy, depth)),
            4..=6 => ("*", operand(entropy, depth)),
            7 => {
                (*entropy.pick(&["/", "MOD"]), (*entropy.pick(&["3", "7", "0.5", "-4"])).to_owned())
            }
            8..=10 => (*entropy.pick(&["AND", "OR", "XOR"]), entropy.range(0, 15).to_string()),
            _ if entropy.chance(15) => ("/", operand(entropy, depth)),
            _ => ("-", operand(entropy, depth)),
        };
        text = format!("{text} {operator} {right}");
    }
    text
}

fn operand(entropy: &mut Entropy<'_>, depth: u32) -> String {
    let sign = sign(entropy);
    match entropy.below(12) {
        0..=3 => format!("{sign}{}", number(entropy)),
        4..=7 => format!("{sign}{}", variable(entropy)),
        8 | 9 if depth > 0 => format!("{sign}[{}]", expression(entropy, depth - 1)),
        10 if depth > 0 => format!("{sign}{}", function(entropy, depth - 1)),
        _ => format!(
            "{sign}{}",
            entropy.pick(&["COS60", "NOT 5", "SQRT9", "ROUND#1", "ABS-3"]).replace('-', "")
        ),
    }
}

/// A function of something that it has a value for, most of the time.
fn function(entropy: &mut Entropy<'_>, depth: u32) -> String {
    let name = *entropy.pick(&[
        "COS", "SIN", "ATAN", "ABS", "ROUND", "FIX", "FUP", "FIX", "FUP", "NOT", "TAN", "EXP",
        "SQRT", "LN", "ASIN", "ACOS",
    ]);
    let inner = expression(entropy, depth);
    match name {
        "EXP" => format!("EXP[[{inner}] MOD 5]"),
        "SQRT" => format!("SQRT[ABS[{inner}]]"),
        "LN" => format!("LN[ABS[{inner}] + 1]"),
        "ASIN" | "ACOS" => format!("{name}[[{inner}] MOD 1]"),
        "NOT" => format!("NOT[[{inner}] MOD 100]"),
        _ => format!("{name}[{inner}]"),
    }
}

/// A condition, without its brackets. The operands have values, or are those of the table of vacant variables.
pub(super) fn condition(entropy: &mut Entropy<'_>) -> String {
    if entropy.chance(25) {
        let compare = *entropy.pick(&["EQ", "NE", "EQ", "NE", "GE", "GT"]);
        let vacant = *entropy.pick(&["#0", "#14", "#15"]);
        return match entropy.below(3) {
            0 => format!("{vacant} {compare} {}", entropy.pick(&["0", "#0", "#16"])),
            1 => format!("{} {compare} {vacant}", entropy.pick(&["0", "#0", "#16"])),
            _ => format!("{} {compare} #0", variable(entropy)),
        };
    }
    let compare = *entropy.pick(&["EQ", "NE", "GT", "LT", "GE", "LE"]);
    let left = format!("{} + {}", variable(entropy), number(entropy));
    let right =
        if entropy.chance(60) { number(entropy) } else { format!("{} * 2", variable(entropy)) };
    format!("{left} {compare} {right}")
}

/// The block as it may be written: blanks mean nothing, and small letters are capitals.
pub(super) fn spelled(block: &str, entropy: &mut Entropy<'_>) -> String {
    match entropy.below(24) {
        0 => block.to_lowercase(),
        1 => block.replace(' ', ""),
        2 => {
            let at = usize::try_from(entropy.below(40)).unwrap_or_default().min(block.len());
            format!("{} \t{}", &block[..at], &block[at..])
        }
        3 => format!("{block} (WHAT IT IS FOR: #1 = [)"),
        4 => format!(" {}\r", block.replace(' ', "  ")),
        _ => block.to_owned(),
    }
}
