//! Numbers, variables, expressions and conditions, and how a block may be spelled.

use crate::generate::Dice;

const NUMBERS: &[&str] =
    &["0", "1", "2", "3", "7", "10", "12", "100", "0.5", ".25", "1.5", "2.", "3.75", "0.001"];

/// A number without a sign.
pub(super) fn number(dice: &mut Dice<'_>) -> String {
    (*dice.pick(NUMBERS)).to_owned()
}

/// The number of a variable that may be read or set. Counters of loops are not among them.
fn place(dice: &mut Dice<'_>) -> u32 {
    match dice.below(10) {
        0..=5 => dice.range(1, 12),
        6 => dice.range(24, 33),
        7 | 8 => dice.range(100, 103),
        _ => *dice.pick(&[13, 17, 18, 199, 500, 599]),
    }
}

/// A variable that may be set.
pub(super) fn target(dice: &mut Dice<'_>) -> String {
    let place = place(dice);
    match dice.below(12) {
        0 => format!("#[{place}]"),
        1 => format!("#[{} + {}]", place - 1, dice.pick(&["1", "1.", "ABS[-1]"])),
        _ => format!("#{place}"),
    }
}

/// A variable that may be read.
pub(super) fn variable(dice: &mut Dice<'_>) -> String {
    if dice.chance(6) { "#0".to_owned() } else { target(dice) }
}

/// The value of a word: no function and no operator stands there without a bracket.
pub(super) fn value(dice: &mut Dice<'_>) -> String {
    match dice.below(10) {
        0..=5 => format!("{}{}", sign(dice), number(dice)),
        6 | 7 => format!("{}{}", sign(dice), variable(dice)),
        _ => format!("{}[{}]", sign(dice), expression(dice, 2)),
    }
}

fn sign(dice: &mut Dice<'_>) -> &'static str {
    match dice.below(12) {
        0 | 1 => "-",
        2 => "+",
        _ => "",
    }
}

/// An expression with brackets up to so many deep.
pub(super) fn expression(dice: &mut Dice<'_>, depth: u32) -> String {
    let mut text = operand(dice, depth);
    for _ in 0..dice.below(3) {
        let (operator, right) = match dice.below(12) {
            0..=3 => (*dice.pick(&["+", "-"]), operand(dice, depth)),
            4..=6 => ("*", operand(dice, depth)),
            7 => (*dice.pick(&["/", "MOD"]), (*dice.pick(&["3", "7", "0.5", "-4"])).to_owned()),
            8..=10 => (*dice.pick(&["AND", "OR", "XOR"]), dice.range(0, 15).to_string()),
            _ if dice.chance(15) => ("/", operand(dice, depth)),
            _ => ("-", operand(dice, depth)),
        };
        text = format!("{text} {operator} {right}");
    }
    text
}

fn operand(dice: &mut Dice<'_>, depth: u32) -> String {
    let sign = sign(dice);
    match dice.below(12) {
        0..=3 => format!("{sign}{}", number(dice)),
        4..=7 => format!("{sign}{}", variable(dice)),
        8 | 9 if depth > 0 => format!("{sign}[{}]", expression(dice, depth - 1)),
        10 if depth > 0 => format!("{sign}{}", function(dice, depth - 1)),
        _ => format!(
            "{sign}{}",
            dice.pick(&["COS60", "NOT 5", "SQRT9", "ROUND#1", "ABS-3"]).replace('-', "")
        ),
    }
}

/// A function of something that it has a value for, most of the time.
fn function(dice: &mut Dice<'_>, depth: u32) -> String {
    let name = *dice.pick(&[
        "COS", "SIN", "ATAN", "ABS", "ROUND", "FIX", "FUP", "FIX", "FUP", "NOT", "TAN", "EXP",
        "SQRT", "LN", "ASIN", "ACOS",
    ]);
    let inner = expression(dice, depth);
    match name {
        "EXP" => format!("EXP[[{inner}] MOD 5]"),
        "SQRT" => format!("SQRT[ABS[{inner}]]"),
        "LN" => format!("LN[ABS[{inner}] + 1]"),
        "ASIN" | "ACOS" => format!("{name}[[{inner}] MOD 1]"),
        "NOT" => format!("NOT[[{inner}] MOD 100]"),
        _ => format!("{name}[{inner}]"),
    }
}

/// A condition, without its brackets. What is compared has a value, or stands in the table of vacant ones.
pub(super) fn condition(dice: &mut Dice<'_>) -> String {
    if dice.chance(25) {
        let compare = *dice.pick(&["EQ", "NE", "EQ", "NE", "GE", "GT"]);
        let vacant = *dice.pick(&["#0", "#14", "#15"]);
        return match dice.below(3) {
            0 => format!("{vacant} {compare} {}", dice.pick(&["0", "#0", "#16"])),
            1 => format!("{} {compare} {vacant}", dice.pick(&["0", "#0", "#16"])),
            _ => format!("{} {compare} #0", variable(dice)),
        };
    }
    let compare = *dice.pick(&["EQ", "NE", "GT", "LT", "GE", "LE"]);
    let left = format!("{} + {}", variable(dice), number(dice));
    let right = if dice.chance(60) { number(dice) } else { format!("{} * 2", variable(dice)) };
    format!("{left} {compare} {right}")
}

/// The block as it may be written: blanks mean nothing, and small letters are capitals.
pub(super) fn spelled(block: &str, dice: &mut Dice<'_>) -> String {
    match dice.below(24) {
        0 => block.to_lowercase(),
        1 => block.replace(' ', ""),
        2 => {
            let at = usize::try_from(dice.below(40)).unwrap_or_default().min(block.len());
            format!("{} \t{}", &block[..at], &block[at..])
        }
        3 => format!("{block} (WHAT IT IS FOR: #1 = [)"),
        4 => format!(" {}\r", block.replace(' ', "  ")),
        _ => block.to_owned(),
    }
}
