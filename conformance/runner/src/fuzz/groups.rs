//! Divergences by signature, and the smallest program of each.

use std::collections::BTreeMap;

use gaugeblock_compare::Divergence;
use gaugeblock_fuzz::shrink::{shape, shrink};
use gaugeblock_vocabulary::Scenario;
use serde::{Deserialize, Serialize};

use super::judge::{Difference, FuzzResult};
use super::plan::Plan;
use super::signature::{Signature, rules};
use super::statistics::Statistics;

/// A program on which two controllers differ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The program's number under the seed.
    pub number: u64,
    /// What differs.
    pub signature: Signature,
    /// What kind of block it shows at: codes, letters, keywords.
    pub shape: String,
    /// In how many programs.
    pub count: u64,
    /// The smallest of them so far.
    pub scenario: Scenario,
    /// The difference in words.
    pub divergence: String,
    /// The rules that the block reaches, once the program is shrunk; in a report, before that none.
    #[serde(default)]
    pub rules: Vec<String>,
    /// Options that are not those of the edition, once the program is shrunk.
    #[serde(default)]
    pub options: Vec<String>,
    /// Whether nothing smaller was left to try.
    #[serde(default)]
    pub shrunk: bool,
    /// Quirks and options that each explain it ([`Plan::causes`]).
    #[serde(default)]
    pub causes: Vec<String>,
}

impl Finding {
    /// A finding of one program.
    pub fn of(number: u64, scenario: Scenario, difference: Difference) -> Self {
        let Difference { divergence, signature } = difference;
        let shape = source(&scenario, &divergence).map(shape).unwrap_or_default();
        let divergence = divergence.to_string();
        Self {
            number,
            signature,
            shape,
            count: 1,
            scenario,
            divergence,
            rules: Vec::new(),
            options: Vec::new(),
            shrunk: false,
            causes: Vec::new(),
        }
    }

    /// Whether another finding differs in the same way at the same rules, or at the same kind of block.
    pub fn is_as(&self, other: &Self) -> bool {
        self.signature == other.signature
            && (self.rules == other.rules || self.shape == other.shape)
    }

    fn size(&self) -> (usize, u64) {
        let program = &self.scenario.program;
        (program.main.len() + program.files.values().map(String::len).sum::<usize>(), self.number)
    }
}

/// The line of the program at which two runs differ.
pub fn source<'a>(scenario: &'a Scenario, divergence: &Divergence) -> Option<&'a str> {
    scenario.program.line(divergence.block.as_ref()?)
}

type Key = (Signature, String);

/// Finds by signature and kind of block, each with its smallest program.
#[derive(Clone, Debug, Default)]
pub struct Groups(BTreeMap<Key, Finding>);

impl Groups {
    /// Adds a finding to its group.
    pub fn add(&mut self, finding: Finding) {
        let key = (finding.signature.clone(), finding.shape.clone());
        match self.0.get_mut(&key) {
            None => {
                self.0.insert(key, finding);
            }
            Some(known) => {
                let count = known.count + finding.count;
                if finding.size() < known.size() {
                    *known = finding;
                }
                known.count = count;
            }
        }
    }

    /// The smallest finding of each group.
    pub fn findings(self) -> Vec<Finding> {
        self.0.into_values().collect()
    }

    /// How many groups there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether nothing was found.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// Whether a block of this shape can be what is left of one of that shape: nothing stands in it that did not stand
/// there. So a smaller program shows its difference where the larger one does, and is not another one that happens to
/// look alike.
fn is_left_of(shape: &str, larger: &str) -> bool {
    shape.split(' ').all(|word| larger.split(' ').any(|known| known == word))
}

/// Shrinks a finding to the smallest program that still differs in the same way and at the same block, and names the
/// rules of that. Ends early when `stop` is true.
pub fn shrunk(
    plan: &Plan<'_>,
    finding: &Finding,
    attempts: u32,
    stop: &dyn Fn() -> bool,
) -> Finding {
    let mut unused = Statistics::default();
    let mut differs = |scenario: &Scenario| {
        let FuzzResult::Differs(difference) = plan.judge(scenario, &mut unused) else {
            return None;
        };
        let same = difference.signature == finding.signature && {
            let block = source(scenario, &difference.divergence).map(shape).unwrap_or_default();
            finding.shape.is_empty() || is_left_of(&block, &finding.shape)
        };
        same.then_some(*difference)
    };
    let mut holds = |scenario: &Scenario| !stop() && differs(scenario).is_some();
    let smallest = shrink(&finding.scenario, &plan.options, attempts, &mut holds);
    let Some(difference) = differs(&smallest.scenario) else { return finding.clone() };
    let rules = rules(&smallest.scenario, &difference.divergence);
    let chosen = smallest.scenario.options.0.iter();
    let chosen = chosen.filter(|(id, option)| !plan.options.is(id, option));
    let options = chosen.map(|(id, option)| format!("{id} = {option}")).collect();
    let found = Finding::of(finding.number, smallest.scenario, difference);
    Finding { count: finding.count, rules, options, shrunk: smallest.finished && !stop(), ..found }
}

/// Merges groups with one cause: the same quirk or option, the same signature and rules, or the same program.
pub fn merged(findings: Vec<Finding>) -> Vec<Finding> {
    let mut merged: Vec<Finding> = Vec::new();
    for finding in findings {
        let same = |known: &&mut Finding| {
            let same_rules = !finding.rules.is_empty() && known.rules == finding.rules;
            let same_shape = finding.rules.is_empty() && known.shape == finding.shape;
            let same_cause = !finding.causes.is_empty() && known.causes == finding.causes;
            same_cause
                || known.signature == finding.signature
                    && known.causes == finding.causes
                    && (same_rules
                        || same_shape
                        || known.scenario.program == finding.scenario.program)
        };
        match merged.iter_mut().find(same) {
            Some(known) => {
                let count = known.count + finding.count;
                if finding.size() < known.size() {
                    *known = finding;
                }
                known.count = count;
            }
            None => merged.push(finding),
        }
    }
    merged.sort_by(|a, b| b.count.cmp(&a.count).then_with(|| a.number.cmp(&b.number)));
    merged
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smaller_program_has_it_in_the_rest_of_the_block() {
        let of = |small: &str, large: &str| is_left_of(&shape(small), &shape(large));
        assert!(of("f1", "n10 g1 x1.5 f12"));
        assert!(of("m72", "f2 m72"));
        assert!(!of("m2", "m72"));
        assert!(!of("g0 x1", "g1 x1"));
    }
}
