//! Counts over a run of generated programs: they show whether the run tested anything.

use std::collections::BTreeMap;

use gaugeblock_reference::{RuleCoverage, RuleOutcome, Tally};
use gaugeblock_vocabulary::{End, Outcome, Scenario};
use serde::{Deserialize, Serialize};

/// Counts by name.
pub type Counts = BTreeMap<String, u64>;

/// Counts over generated programs.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Statistics {
    /// Programs that were generated.
    pub programs: u64,
    /// Those that both controllers ran, so that they were compared.
    pub compared: u64,
    /// Of the compared ones, those that ended without a fault.
    pub accepted: u64,
    /// Those that differ.
    pub diverging: u64,
    /// Those that differ, where the specification's own answer changes with the last bit of a transcendental function.
    pub fragile: u64,
    /// Those that a controller does not support, by reason.
    pub unsupported: Counts,
    /// Those that the documents leave open, by reason.
    pub unspecified: Counts,
    /// Those that could not be judged: crash, time-out, unreadable output, by reason.
    pub not_judged: Counts,
    /// Blocks that were executed on the side that is compared with.
    pub blocks: u64,
    /// Those of them in programs that were compared.
    pub blocks_compared: u64,
    /// Ends of compared programs.
    pub ends: Counts,
    /// Kinds of faults of compared programs.
    pub faults: Counts,
    /// Compared programs in which the model reached each outcome of a rule; where the model is one of the two.
    pub rules: Counts,
    /// Compared programs in which each code stands.
    pub codes: Counts,
    /// What the model reached in programs that are not in [`Self::rules`] yet.
    #[serde(skip)]
    reached: Tally,
    /// Short codes that stand in programs that are not in [`Self::codes`] yet.
    #[serde(skip)]
    short_codes: BTreeMap<ShortCode, u64>,
}

/// A code of a letter and few digits, as one number: its characters in order, zeros behind them.
type ShortCode = u64;

impl Statistics {
    /// Adds other counts.
    pub fn add(&mut self, other: &Self) {
        self.programs += other.programs;
        self.compared += other.compared;
        self.accepted += other.accepted;
        self.diverging += other.diverging;
        self.fragile += other.fragile;
        self.blocks += other.blocks;
        self.blocks_compared += other.blocks_compared;
        for (mine, its) in [
            (&mut self.unsupported, &other.unsupported),
            (&mut self.unspecified, &other.unspecified),
            (&mut self.not_judged, &other.not_judged),
            (&mut self.ends, &other.ends),
            (&mut self.faults, &other.faults),
            (&mut self.rules, &other.rules),
            (&mut self.codes, &other.codes),
        ] {
            its.iter().for_each(|(name, more)| count_more(mine, name, *more));
        }
        self.reached.merge(&other.reached);
        for (code, more) in &other.short_codes {
            *self.short_codes.entry(*code).or_default() += more;
        }
    }

    /// Counts a program that was compared.
    pub fn count(&mut self, scenario: &Scenario, outcome: &Outcome) {
        self.compared += 1;
        self.blocks_compared += u64::try_from(outcome.steps.len()).unwrap_or_default();
        count(&mut self.ends, outcome.end.name());
        if let End::Fault(fault) = &outcome.end {
            if let Some(kind) = fault.kind {
                count(&mut self.faults, &kind.to_string());
            }
        } else {
            self.accepted += 1;
        }
        let (mut short, mut long) = (Vec::with_capacity(64), Vec::new());
        codes_of(&scenario.program.main, &mut short, &mut long);
        let files = scenario.program.files.values();
        files.for_each(|text| codes_of(text, &mut short, &mut long));
        short.sort_unstable();
        short.dedup();
        for code in short {
            *self.short_codes.entry(code).or_default() += 1;
        }
        long.sort_unstable();
        long.dedup();
        long.iter().for_each(|code| count(&mut self.codes, code));
    }

    /// Counts the rules that the model reached.
    pub fn reached(&mut self, coverage: &RuleCoverage) {
        self.reached.add(coverage);
    }

    /// Puts down under their names what was counted so far: rules and codes.
    pub fn settle(&mut self) {
        for (code, programs) in std::mem::take(&mut self.short_codes) {
            let characters = code.to_be_bytes().into_iter().filter(|byte| *byte != 0);
            let name: String = characters.map(char::from).collect();
            count_more(&mut self.codes, &name, programs);
        }
        let mut name = String::new();
        for (rule, outcome, programs) in std::mem::take(&mut self.reached).iter() {
            name.clear();
            push_outcome(&mut name, rule, outcome);
            count_more(&mut self.rules, &name, programs);
        }
    }

    /// Those outcomes of some rules that fewer programs reached than [`ENOUGH`], none too, and by how many; those of
    /// the fewest first. Nothing at all where the model is neither of the two controllers.
    pub fn rarely_reached<'a>(
        &self,
        outcomes: impl IntoIterator<Item = (&'a str, RuleOutcome)>,
    ) -> Vec<(String, u64)> {
        if self.rules.is_empty() {
            return Vec::new();
        }
        let counts = outcomes.into_iter().map(|(rule, outcome)| {
            let name = name_of(rule, outcome);
            let programs = self.rules.get(&name).copied().unwrap_or_default();
            (name, programs)
        });
        let mut rare: Vec<_> = counts.filter(|(_, programs)| *programs < ENOUGH).collect();
        rare.sort_by(|a, b| a.1.cmp(&b.1).then_with(|| a.0.cmp(&b.0)));
        rare
    }
}

/// So many programs reach an outcome of a rule in a run that says something of that rule.
pub const ENOUGH: u64 = 20;

/// The name under which an outcome of a rule is counted.
pub fn name_of(rule: &str, outcome: RuleOutcome) -> String {
    let mut name = String::new();
    push_outcome(&mut name, rule, outcome);
    name
}

/// Adds the name under which an outcome of a rule is counted.
fn push_outcome(name: &mut String, rule: &str, outcome: RuleOutcome) {
    name.push_str(rule);
    name.push_str(match outcome {
        RuleOutcome::Accepted => "",
        RuleOutcome::Refused => REFUSED,
    });
}

/// What stands behind a rule's id where the rule refused a block.
const REFUSED: &str = " refused";

/// Counts one of a name.
pub fn count(counts: &mut Counts, name: &str) {
    count_more(counts, name, 1);
}

/// Counts so many of a name.
fn count_more(counts: &mut Counts, name: &str, more: u64) {
    match counts.get_mut(name) {
        Some(count) => *count += more,
        None => {
            counts.insert(name.to_owned(), more);
        }
    }
}

/// Plain G and M codes of a text, each with its number as it is written; those that are no short ones as texts.
fn codes_of(text: &str, short: &mut Vec<ShortCode>, long: &mut Vec<String>) {
    let bytes = text.as_bytes();
    for (at, byte) in bytes.iter().enumerate() {
        let letter = match byte {
            b'g' | b'G' => b'g',
            b'm' | b'M' => b'm',
            _ => continue,
        };
        if at > 0 && (bytes[at - 1].is_ascii_alphabetic() || bytes[at - 1] == b'_') {
            continue;
        }
        let behind = &bytes[at + 1..];
        let is_digit = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
        let digits = behind.iter().position(|byte| !is_digit(byte)).unwrap_or(behind.len());
        if digits == 0 {
            continue;
        }
        let mut code = [0; 8];
        code[0] = letter;
        match code.get_mut(1..=digits) {
            Some(place) => {
                place.copy_from_slice(&behind[..digits]);
                short.push(ShortCode::from_be_bytes(code));
            }
            None => {
                let number = behind[..digits].iter().copied().map(char::from);
                long.push([char::from(letter)].into_iter().chain(number).collect());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use gaugeblock_reference::run;

    use super::*;

    #[test]
    fn codes_are_counted_as_they_are_written() {
        let main = "g1 x1 G01 m2\n(msg5) g1 M2 g38.2 g000000000001 m\n#<_g5>=1 g.";
        let (mut statistics, outcome) = (Statistics::default(), run(&Scenario::of("m2")).0);
        for _ in 0..2 {
            statistics.count(&Scenario::of(main), &outcome);
        }
        let mut all = Statistics::default();
        all.add(&statistics);
        all.settle();
        let codes = ["g.", "g000000000001", "g01", "g1", "g38.2", "m2"];
        assert_eq!(all.codes, codes.map(|code| (code.to_owned(), 2)).into());
    }

    #[test]
    fn outcomes_that_few_programs_reach_are_named_the_fewest_first() {
        let rules = [("a", ENOUGH), ("a refused", 3), ("b", ENOUGH - 1)];
        let rules = rules.map(|(name, programs)| (name.to_owned(), programs)).into();
        let statistics = Statistics { rules, ..Statistics::default() };
        let outcomes = ["a", "b", "c"]
            .into_iter()
            .flat_map(|rule| [(rule, RuleOutcome::Accepted), (rule, RuleOutcome::Refused)]);
        let rare = statistics.rarely_reached(outcomes.clone());
        let names: Vec<_> = rare.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["b refused", "c", "c refused", "a refused", "b"]);
        assert!(Statistics::default().rarely_reached(outcomes).is_empty());
    }
}
