//! Programs that are spliced from parts of others, such as the suite's cases.

use gaugeblock_vocabulary::Scenario;

use super::{BUDGET, Entropy};

/// What splices are made of.
#[derive(Clone, Debug, Default)]
pub struct Seeds {
    /// The scenarios.
    pub all: Vec<Scenario>,
    /// What other programs do too rarely.
    pub rare: Vec<Rare>,
    /// Indices into `rare`, in the order in which they take turns. Rarer things have more turns.
    pub turns: Vec<usize>,
    /// Scenarios that may run before any other: they need nothing but their program, and go to its end.
    pub before: Vec<usize>,
}

/// Something that other programs do too rarely.
#[derive(Clone, Debug)]
pub struct Rare {
    /// Indices of the scenarios that do it.
    pub does: Vec<usize>,
    /// How many others run before one of them at most: the more, the less often it is reached.
    pub others: u32,
}

/// One splice in so many does nothing rare.
const ONE_IN: u64 = 20;

/// How many of so many splices do something rare.
pub fn rare_among(splices: u64) -> u64 {
    splices - splices / ONE_IN
}

/// One of the scenarios with blocks of others inserted or with a mutation, or one that does something rare after some
/// others. The options are those of the first. Rare things take turns: the number of the splice selects one.
///
/// # Panics
/// There is no scenario, or a turn is out of range.
pub fn spliced(entropy: &mut Entropy<'_>, seeds: &Seeds, splice: u64) -> Scenario {
    let turn = usize::try_from(rare_among(splice)).unwrap_or_default();
    match turn.checked_rem(seeds.turns.len()) {
        Some(turn) if splice % ONE_IN != ONE_IN - 1 => {
            rare(entropy, seeds, &seeds.rare[seeds.turns[turn]])
        }
        _ => {
            let mut scenario = Scenario { budget: BUDGET, ..entropy.pick(&seeds.all).clone() };
            change(entropy, seeds, &mut scenario);
            scenario
        }
    }
}

/// One of the scenarios that do something rare, after some others.
///
/// # Panics
/// None does it, or one that is not there.
pub fn rare(entropy: &mut Entropy<'_>, seeds: &Seeds, rare: &Rare) -> Scenario {
    let mut scenario = Scenario { budget: BUDGET, ..seeds.all[*entropy.pick(&rare.does)].clone() };
    let others = entropy.range(0, rare.others);
    let before = before(entropy, seeds, others);
    scenario.program.main.insert_str(0, &before);
    scenario
}

/// The blocks of so many scenarios that may run before others.
fn before(entropy: &mut Entropy<'_>, seeds: &Seeds, count: u32) -> String {
    let mut text = String::new();
    if !seeds.before.is_empty() {
        for _ in 0..count {
            let other = &seeds.all[*entropy.pick(&seeds.before)];
            let lines = other.program.main.lines().filter(|line| !ends(line));
            lines.for_each(|line| text.extend([line, "\n"]));
        }
    }
    text
}

/// Changes a scenario slightly.
fn change(entropy: &mut Entropy<'_>, seeds: &Seeds, scenario: &mut Scenario) {
    let mut lines: Vec<String> = scenario.program.main.lines().map(str::to_owned).collect();
    for _ in 0..entropy.range(1, 3) {
        let other = entropy.pick(&seeds.all);
        let others: Vec<&str> = other.program.main.lines().filter(|line| !ends(line)).collect();
        let place = at(entropy, lines.len());
        match entropy.below(5) {
            0 if !lines.is_empty() => {
                lines.remove(place.min(lines.len() - 1));
            }
            1 if !lines.is_empty() => {
                let line = lines[place.min(lines.len() - 1)].clone();
                lines.insert(place, line);
            }
            2 if lines.len() > 1 => {
                let one = place.min(lines.len() - 1);
                let two = at(entropy, lines.len() - 1);
                lines.swap(one, two);
            }
            _ if !others.is_empty() => {
                let first = at(entropy, others.len() - 1);
                let count = at(entropy, (others.len() - first).min(6)).max(1);
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
}

/// A place from 0 to `count`.
fn at(entropy: &mut Entropy<'_>, count: usize) -> usize {
    usize::try_from(entropy.range(0, u32::try_from(count).unwrap_or(u32::MAX))).unwrap_or_default()
}

/// Whether nothing after this line would run.
fn ends(line: &str) -> bool {
    matches!(line.trim().to_lowercase().as_str(), "m2" | "m30" | "%")
}
