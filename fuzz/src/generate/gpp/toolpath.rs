//! Toolpaths: formats, system variables, blocks.

use std::fmt::Write as _;

use super::values;
use super::variable::Variable;
use crate::generate::Entropy;

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

/// Headings, with the qualifier after a colon.
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
pub(super) fn toolpath(entropy: &mut Entropy<'_>) -> (String, Vec<Variable>, Vec<&'static str>) {
    let mut text = String::new();
    if entropy.chance(60) {
        let mut left = FORMATS.to_vec();
        for _ in 0..entropy.range(1, 3) {
            let place = usize::try_from(entropy.below(u32::try_from(left.len()).unwrap_or(1)));
            let format = left.remove(place.unwrap_or_default());
            let _infallible = writeln!(text, "format {format}{}", keys(entropy));
        }
    }
    if entropy.chance(10) {
        text.push_str("format CHARACTER modal=no\n# a comment\n");
    }
    let mut known = Vec::new();
    for (name, class, is_text) in SYSTEMS {
        if entropy.chance(40) {
            let format = if *is_text { "CHARACTER" } else { *entropy.pick(FORMATS) };
            let name = values::spelled(name, entropy);
            let _infallible = writeln!(text, "system {name} {class} {format}");
            let name = name.to_ascii_uppercase();
            known.push(Variable { name, text: *is_text, size: None, system: true });
        }
    }
    let mut headings = vec!["START"];
    for _ in 0..entropy.below(7) {
        headings.push(if entropy.chance(10) { "START" } else { *entropy.pick(HEADINGS) });
    }
    for (place, heading) in headings.iter().enumerate() {
        let named = if place == 0 { 90 } else { 45 };
        let heading = values::spelled(heading, entropy);
        let _infallible = write!(text, "block {heading}:");
        for variable in &known {
            if entropy.chance(named) {
                let value = value(variable.text, entropy);
                let _infallible = write!(text, " {}={value}", variable.name);
            }
        }
        text.push_str(if entropy.chance(5) { " \r\n" } else { "\n" });
    }
    headings.sort_unstable();
    headings.dedup();
    (text, known, headings)
}

fn value(is_text: bool, entropy: &mut Entropy<'_>) -> String {
    if is_text {
        return values::text(entropy);
    }
    let sign = *entropy.pick(&["", "", "", "-", "+"]);
    // Few values, so that a block often repeats one.
    let number = if entropy.chance(60) {
        (*entropy.pick(&["1", "1.0001", "2", "1.4", "0", "0.0004"])).to_owned()
    } else {
        values::number(entropy)
    };
    format!("{sign}{number}")
}

fn keys(entropy: &mut Entropy<'_>) -> String {
    let mut text = String::new();
    let range = |entropy: &mut Entropy<'_>, least: u32, most: u32| {
        let most = entropy.range(least, most);
        format!("{}..{most}", entropy.range(0, most))
    };
    if entropy.chance(45) {
        let least = if entropy.chance(95) { 5 } else { 1 };
        let digits = range(entropy, least, 8);
        let _infallible = write!(text, " integer={digits}");
    }
    if entropy.chance(45) {
        let most = if entropy.chance(90) { 4 } else { 14 };
        let digits = range(entropy, 0, most);
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
        if entropy.chance(18) {
            let _infallible = write!(text, " {key}={}", entropy.pick(values));
        }
    }
    text
}
