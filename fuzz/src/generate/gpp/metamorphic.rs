//! Programs that differ in what is modal and in nothing else.

use gaugeblock_vocabulary::{End, GppState, Outcome, Scenario, State};

use super::super::{Entropy, GeneratorConfig};
use super::scenario;

/// Two programs that print nothing, the other one with other modal variables.
#[derive(Clone, Debug)]
pub struct Pair {
    /// One.
    pub one: Scenario,
    /// The other one.
    pub other: Scenario,
}

/// A pair that must do the same: modal and non-modal variables differ only in what OUTPUT and PRINT do to them.
pub fn modality(entropy: &mut Entropy<'_>) -> Pair {
    let config = GeneratorConfig { mutated_programs: 0, ..GeneratorConfig::default() };
    let mut one = scenario(entropy, &config);
    let prints = |line: &&str| {
        let line = line.to_ascii_uppercase();
        !line.contains("OUTPUT") && !line.contains("PRINT")
    };
    let silent = one.program.main.lines().filter(prints).flat_map(|line| [line, "\n"]).collect();
    one.program.main = silent;
    let mut other = one.clone();
    let declared = |line: &&str| !line.starts_with("MODAL");
    let lines = one.program.main.lines().filter(declared);
    other.program.main = lines.flat_map(|line| [line, "\n"]).collect();
    Pair { one, other }
}

impl Pair {
    /// Whether two outcomes are the same but for what says which variables are modal: also where a budget ended one
    /// of them earlier, since warnings cost something.
    pub fn agrees(one: &Outcome, other: &Outcome) -> bool {
        let (mut first, mut second) = (seen(one), seen(other));
        let exhausted = [one, other].iter().any(|o| matches!(o.end, End::BudgetExhausted { .. }));
        if exhausted {
            let length = first.len().min(second.len());
            first.truncate(length);
            second.truncate(length);
        }
        first == second && (exhausted || one.end.name() == other.end.name())
    }
}

/// What each step makes of the variables.
fn seen(outcome: &Outcome) -> Vec<GppState> {
    let states = outcome.steps.iter().filter_map(|step| match &step.state {
        Some(State::Gpp(state)) => Some(GppState { modal: None, ..state.clone() }),
        _ => None,
    });
    states.collect()
}
