//! The text of a run for people: an outcome with the text of each block, and with every axis of the machine.

use std::fmt::Write as _;

use gaugeblock_vocabulary::{Axis, Entry, Event, Outcome, Position, Scenario, Value};

/// Writes an outcome. It has the lines of [`Outcome::to_text`]; the text of a block follows it after a hash sign.
/// `names` is the outcome with the names under which its blocks are written.
pub(crate) fn run_text(outcome: &Outcome, names: &Outcome, scenario: &Scenario) -> String {
    let axes = &scenario.machine.axes;
    let whole = Outcome { steps: Vec::new(), ..names.clone() }.to_text();
    let (head, tail) = whole.split_at(whole.find("\nend ").map_or(whole.len(), |at| at + 1));
    // The settings at the start have positions, too.
    let mut text: String = head.lines().take(2).map(|line| format!("{line}\n")).collect();
    record(&mut text, "start", &outcome.start.entries(), axes);
    let lines = scenario.program.lines();
    for (step, named) in outcome.steps.iter().zip(&names.steps) {
        let source = lines.line(&step.block).unwrap_or_default().trim();
        let comment = if source.is_empty() { String::new() } else { format!("  # {source}") };
        let _infallible = writeln!(text, "block {}{comment}", named.block);
        for event in &step.events {
            match event {
                Event::Set(settings) => record(&mut text, "  set", &settings.entries(), axes),
                Event::Unknown(fields) => {
                    let _infallible = writeln!(text, "  unknown {}", fields.join(" "));
                }
                Event::Do(effect) => {
                    let _infallible = write!(text, "  do {}", effect.name());
                    for (name, value) in effect.arguments() {
                        let _infallible = write!(text, " {name}={}", in_full(&value, axes));
                    }
                    text.push('\n');
                }
            }
        }
        if let Some(state) = &step.state {
            record(&mut text, "  state", &state.entries(), axes);
        }
    }
    text + tail
}

fn record(text: &mut String, name: &str, entries: &[Entry], axes: &[Axis]) {
    text.push_str(name);
    for entry in entries {
        let _infallible = write!(text, " {}={}", entry.name(), in_full(&entry.value, axes));
    }
    text.push('\n');
}

/// A value; a position with each axis that the machine has, at zero or not.
fn in_full(value: &Value, axes: &[Axis]) -> String {
    let Value::Position(position) = value else { return value.to_string() };
    format!("({})", coordinates(position, axes).join(" "))
}

fn coordinates(position: &Position, axes: &[Axis]) -> Vec<String> {
    let is_shown = |axis: &&Axis| axes.contains(axis) || position.get(**axis).to_bits() != 0;
    let shown = Axis::ALL.iter().filter(is_shown);
    shown.map(|axis| format!("{axis}{}", position.get(*axis))).collect()
}
