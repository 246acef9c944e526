//! Toolpaths: formats, system variables, blocks.

use std::fmt::Write as _;

use super::{Known, values};
use crate::generate::Dice;

/// Formats of numbers that variables have here.
pub(super) const FORMATS: &[&str] = &[
    "USER_1",
    "USER_2",
    "USER_10",
    "COORDINATES",
    "FEED",
    "SEQUENCING",
    "DWELL",
    "REAL",
    "ANGLES",
];

/// Headings, the qualifier behind a colon.
const HEADINGS: &[&str] = &[
    "MOVE",
    "LINEAR MOTION",
    "TOOL CHANGE",
    "TOOL CHANGE: FIRST",
    "END",
    "3D MOVE",
    "CYCLE: DRILL",
];

/// System variables: name, class, whether it is a text.
const SYSTEMS: &[(&str, &str, bool)] = &[
    ("X_CURPOS", "change", false),
    ("Y_CURPOS", "change", false),
    ("PART_TOL", "presence", false),
    ("FEED_RATE", "presence", false),
    ("TOOL_NAME", "change", true),
    ("TOOL_NOTE", "presence", true),
];

/// A toolpath, its variables, and the headings of its blocks.
pub(super) fn toolpath(dice: &mut Dice<'_>) -> (String, Vec<Known>, Vec<&'static str>) {
    let mut text = String::new();
    if dice.chance(60) {
        let mut left = FORMATS.to_vec();
        for _ in 0..dice.range(1, 3) {
            let place = usize::try_from(dice.below(u32::try_from(left.len()).unwrap_or(1)));
            let format = left.remove(place.unwrap_or_default());
            let _infallible = writeln!(text, "format {format}{}", keys(dice));
        }
    }
    if dice.chance(10) {
        text.push_str("format CHARACTER modal=no\n# a comment\n");
    }
    let mut known = Vec::new();
    for (name, class, is_text) in SYSTEMS {
        if dice.chance(40) {
            let format = if *is_text { "CHARACTER" } else { *dice.pick(FORMATS) };
            let name = values::spelled(name, dice);
            let _infallible = writeln!(text, "system {name} {class} {format}");
            let name = name.to_ascii_uppercase();
            known.push(Known { name, text: *is_text, size: None, system: true });
        }
    }
    let mut headings = vec!["START"];
    for _ in 0..dice.below(7) {
        headings.push(if dice.chance(10) { "START" } else { *dice.pick(HEADINGS) });
    }
    for (place, heading) in headings.iter().enumerate() {
        let named = if place == 0 { 90 } else { 45 };
        let heading = values::spelled(heading, dice);
        let _infallible = write!(text, "block {heading}:");
        for variable in &known {
            if dice.chance(named) {
                let value = value(variable.text, dice);
                let _infallible = write!(text, " {}={value}", variable.name);
            }
        }
        text.push_str(if dice.chance(5) { " \r\n" } else { "\n" });
    }
    headings.sort_unstable();
    headings.dedup();
    (text, known, headings)
}

fn value(is_text: bool, dice: &mut Dice<'_>) -> String {
    if is_text {
        return values::text(dice);
    }
    let sign = *dice.pick(&["", "", "", "-", "+"]);
    // Few values, so that a block often repeats one.
    let number = if dice.chance(60) {
        (*dice.pick(&["1", "1.0001", "2", "1.4", "0", "0.0004"])).to_owned()
    } else {
        values::number(dice)
    };
    format!("{sign}{number}")
}

fn keys(dice: &mut Dice<'_>) -> String {
    let mut text = String::new();
    let range = |dice: &mut Dice<'_>, least: u32, most: u32| {
        let most = dice.range(least, most);
        format!("{}..{most}", dice.range(0, most))
    };
    if dice.chance(45) {
        let least = if dice.chance(95) { 5 } else { 1 };
        let digits = range(dice, least, 8);
        let _infallible = write!(text, " integer={digits}");
    }
    if dice.chance(45) {
        let most = if dice.chance(90) { 4 } else { 14 };
        let digits = range(dice, 0, most);
        let _infallible = write!(text, " fraction={digits}");
    }
    for (key, values) in [
        ("leading", &["yes", "no"][..]),
        ("trailing", &["yes", "no", "NO"]),
        ("plus", &["+", "", "p"]),
        ("minus", &["", "-", "m", "+"]),
        ("point", &[",", ".", "1"]),
        ("whole_point", &["yes", "no"]),
        ("zero", &["nil", "0", "1", ""]),
        ("modal", &["yes", "no"]),
    ] {
        if dice.chance(18) {
            let _infallible = write!(text, " {key}={}", dice.pick(values));
        }
    }
    text
}
