//! A comparison as a person reads it on a terminal.

use std::fmt::Write as _;

use super::document::{Column, Comparison, ProfileRow};
use crate::{escape_line, escape_text};

/// Most rules of a list that are printed.
const LISTED: usize = 8;

macro_rules! line {
    ($text:expr) => { line!($text, "") };
    ($text:expr, $($words:tt)*) => {{
        let _infallible = writeln!($text, $($words)*);
    }};
}

/// The comparison: a line for each controller, what only one does, the trends.
pub fn terminal(comparison: &Comparison) -> String {
    let mut text = String::new();
    for note in &comparison.notes {
        line!(text, "note {}", escape_text(note));
    }
    controllers(&mut text, comparison);
    profiles(&mut text, comparison);
    alone(&mut text, comparison);
    trends(&mut text, comparison);
    text
}

fn controllers(text: &mut String, comparison: &Comparison) {
    line!(
        text,
        "{:>2}  {:<30}{:<22}{:<12}{:>6}{:>6}{:>10}{:>13}{:>12}{:>6}",
        "",
        "controller",
        "edition",
        "date",
        "rules",
        "pass",
        "diverges",
        "unsupported",
        "not judged",
        "void"
    );
    for (place, it) in comparison.controllers.iter().enumerate() {
        let Column { edition, date, counts, .. } = it;
        let name = escape_line(&format!("{} {}", it.name, it.version));
        line!(
            text,
            "{:>2}  {name:<30}{edition:<22}{date:<12}{:>6}{:>6}{:>10}{:>13}{:>12}{:>6}",
            place + 1,
            counts.rules,
            counts.pass,
            counts.diverges,
            counts.unsupported,
            counts.not_judged,
            counts.void
        );
    }
    line!(text);
}

fn profiles(text: &mut String, comparison: &Comparison) {
    if comparison.profiles.is_empty() {
        return;
    }
    let numbers = (1..=comparison.controllers.len()).map(|number| format!("{number:>12}"));
    line!(text, "{:<18}{}", "profile", numbers.collect::<String>());
    for ProfileRow { profile, distances, .. } in &comparison.profiles {
        let cells = distances.iter().map(|distance| {
            let share = distance.as_ref().map(|it| format!("{} of {}", it.pass, it.rules));
            format!("{:>12}", share.unwrap_or_else(|| "·".to_owned()))
        });
        line!(text, "{profile:<18}{}", cells.collect::<String>());
    }
    line!(text);
}

fn alone(text: &mut String, comparison: &Comparison) {
    for (column, alone) in comparison.controllers.iter().zip(&comparison.alone) {
        let name = escape_line(&format!("{} against {}", column.name, column.edition));
        if !alone.passes.is_empty() {
            line!(text, "{name} passes alone: {}", listed(&alone.passes));
        }
        if !alone.fails.is_empty() {
            let rules: Vec<_> = alone.fails.iter().map(|it| it.rule.clone()).collect();
            line!(text, "{name} is the only one that does not pass: {}", listed(&rules));
        }
    }
}

fn trends(text: &mut String, comparison: &Comparison) {
    for trend in &comparison.trends {
        line!(text, "\n{} against {}", escape_line(&trend.name), trend.edition);
        for run in &trend.runs {
            let version = escape_line(&run.version);
            let counts = run.counts;
            line!(
                text,
                "  {}  {version}: {} of {} rules pass",
                run.date,
                counts.pass,
                counts.rules
            );
            if !run.gained.is_empty() {
                line!(text, "    passes now: {}", listed(&run.gained));
            }
            if !run.lost.is_empty() {
                let rules: Vec<_> = run.lost.iter().map(|it| it.rule.clone()).collect();
                line!(text, "    does not pass any more: {}", listed(&rules));
            }
        }
    }
}

/// The number of rules and the first of them.
fn listed(rules: &[String]) -> String {
    let named = rules.iter().take(LISTED).map(String::as_str).collect::<Vec<_>>().join(", ");
    match rules.len().saturating_sub(LISTED) {
        0 => format!("{} ({named})", rules.len()),
        more => format!("{} ({named} and {more} more)", rules.len()),
    }
}
