//! Scenarios from [entropy](Entropy): a program and its subroutine files, a machine, an environment, an operator.
//!
//! A program is written from a [table](TABLE) of statements. Each statement knows where it is allowed, so that most
//! programs are accepted; a share of them is mutated. [`malformed`] writes programs that are mostly refused, [`gpp`]
//! post-processors, [`nct`] custom macros; [`splice`] joins parts of the suite's cases; [`metamorphic`] writes pairs of
//! programs with equal effects.

mod config;
mod entropy;
pub mod gpp;
mod kind;
pub mod malformed;
pub mod metamorphic;
mod mutate;
pub mod nct;
mod setup;
pub mod splice;
mod state;
mod statements;
mod table;
mod ulp_perturbation;
mod values;
mod writer;

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_vocabulary::scenario::Start;
use gaugeblock_vocabulary::{Language, Program, Scenario};

pub use config::{BUDGET, GeneratorConfig};
pub use entropy::Entropy;
pub use kind::StatementKind;
pub use setup::Setups;
pub use table::TABLE;
pub use ulp_perturbation::ulp_perturbed;
pub use writer::Statement;

use state::{State, Sub};
use writer::Writer;

/// A scenario. Its options are empty: the caller knows which documents apply.
pub fn scenario(entropy: &mut Entropy<'_>, config: &GeneratorConfig) -> Scenario {
    match config.language {
        Language::Rs274 => scenario_and_kinds(entropy, config).0,
        Language::Gpp => gpp::scenario(entropy, config),
        Language::Nct => nct::scenario(entropy, config),
    }
}

/// A scenario in RS-274, and the kinds of statements in its main program.
pub fn scenario_and_kinds(
    entropy: &mut Entropy<'_>,
    config: &GeneratorConfig,
) -> (Scenario, BTreeSet<StatementKind>) {
    let mut scenario = setup::scenario(entropy, config.setups);
    let mut state = State::of(&scenario);
    let mut files = BTreeMap::new();
    if config.only.is_empty() && entropy.chance(15) {
        let name = *entropy.pick(&["cave", "drill_row", "x1"]);
        let blocks = entropy.range(1, 6);
        let text = Writer::new(entropy, config, TABLE, state.clone()).sub_file(name, blocks);
        files.insert(format!("{name}.ngc"), text);
        state.subs.push(Sub { label: format!("<{name}>"), numbered: false });
    }
    let block_delete = entropy.chance(30);
    let mut writer = Writer::new(entropy, config, TABLE, state);
    let main = writer.main();
    let kinds = writer.into_kinds();
    let by_hand = matches!(config.setups, Setups::Any | Setups::Operated)
        && scenario.operator.is_empty()
        && entropy.chance(4);
    let start = if by_hand { Start::Mdi } else { Start::Program };
    scenario.program = Program { main, files, block_delete, start, ..scenario.program };
    scenario.budget = BUDGET;
    (scenario, kinds)
}

/// A scenario from the bytes of a fuzzing engine.
pub fn from_bytes(bytes: &[u8]) -> Scenario {
    scenario(&mut Entropy::from_bytes(bytes), &GeneratorConfig::default())
}

/// The scenario of a number under a seed.
pub fn from_seed(seed: u64, number: u64, config: &GeneratorConfig) -> Scenario {
    scenario(&mut Entropy::from_seed(seed, number), config)
}

/// A scenario whose program is these bytes, with U+FFFD for NUL and for what is not UTF-8.
pub fn raw(bytes: &[u8]) -> Scenario {
    let text = String::from_utf8_lossy(bytes).replace('\0', "\u{fffd}");
    Scenario { budget: BUDGET, ..Scenario::of(text) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_under_a_seed_gives_one_scenario() {
        let config = GeneratorConfig::default();
        assert_eq!(from_seed(1, 2, &config), from_seed(1, 2, &config));
        assert_ne!(from_seed(1, 2, &config).program, from_seed(1, 3, &config).program);
    }

    #[test]
    fn names_of_statements_are_unique_and_every_kind_has_one() {
        let statements: Vec<_> = TABLE.iter().copied().flatten().collect();
        let names: BTreeSet<_> = statements.iter().map(|statement| statement.name).collect();
        assert_eq!(names.len(), statements.len());
        let kinds: BTreeSet<_> = statements.iter().map(|statement| statement.kind).collect();
        assert_eq!(kinds, StatementKind::ALL.iter().copied().collect());
    }

    #[test]
    fn single_rule_can_be_selected() {
        let config = GeneratorConfig {
            only: vec!["dwell".to_owned()],
            mutated_programs: 0,
            ..GeneratorConfig::default()
        };
        let text = from_seed(1, 1, &config).program.main.to_lowercase();
        assert!(text.contains("g4"), "{text}");
        assert!(!text.contains("g0"), "{text}");
    }
}
