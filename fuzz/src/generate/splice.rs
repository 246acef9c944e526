//! Programs from parts of others, such as the suite's cases.

use gaugeblock_trace::Scenario;

use super::{BUDGET, Dice};

/// One of the scenarios with blocks of others in it, or changed slightly. Options are those of the first.
///
/// # Panics
/// There is no scenario.
pub fn spliced(dice: &mut Dice<'_>, seeds: &[Scenario]) -> Scenario {
    let mut scenario = dice.pick(seeds).clone();
    scenario.budget = BUDGET;
    let mut lines: Vec<String> = scenario.program.main.lines().map(str::to_owned).collect();
    for _ in 0..dice.range(1, 3) {
        let other = dice.pick(seeds);
        let others: Vec<&str> = other.program.main.lines().filter(|line| !ends(line)).collect();
        let place = at(dice, lines.len());
        match dice.below(5) {
            0 if !lines.is_empty() => {
                lines.remove(place.min(lines.len() - 1));
            }
            1 if !lines.is_empty() => {
                let line = lines[place.min(lines.len() - 1)].clone();
                lines.insert(place, line);
            }
            2 if lines.len() > 1 => {
                let one = place.min(lines.len() - 1);
                let two = at(dice, lines.len() - 1);
                lines.swap(one, two);
            }
            _ if !others.is_empty() => {
                let first = at(dice, others.len() - 1);
                let count = at(dice, (others.len() - first).min(6)).max(1);
                let part = others[first..].iter().take(count).map(|line| (*line).to_owned());
                lines.splice(place..place, part.collect::<Vec<_>>());
                for (name, text) in &other.program.files {
                    scenario.program.files.entry(name.clone()).or_insert_with(|| text.clone());
                }
            }
            _ => {}
        }
    }
    scenario.program.main = lines.join("\n") + "\n";
    scenario
}

/// A place from 0 to `count`.
fn at(dice: &mut Dice<'_>, count: usize) -> usize {
    usize::try_from(dice.range(0, u32::try_from(count).unwrap_or(u32::MAX))).unwrap_or_default()
}

/// Whether nothing behind this line would run.
fn ends(line: &str) -> bool {
    matches!(line.trim().to_lowercase().as_str(), "m2" | "m30" | "%")
}
