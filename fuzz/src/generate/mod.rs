//! Scenarios from [entropy](Entropy): a program and its subroutine files, a machine, an environment, an operator.
//!
//! A program is written from a [table](TABLE) of statements. Each statement knows where it is allowed, so that most
//! programs are accepted; a share of them is mutated. [`readable`] omits statements that a controller does not support.
//! [`malformed`] writes programs that are mostly refused, [`gpp`] post-processors, [`nct`] custom macros; [`splice`]
//! joins parts of the suite's cases; [`metamorphic`] writes pairs of programs with equal effects.

mod config;
mod entropy;
pub mod gpp;
mod kind;
pub mod malformed;
pub mod metamorphic;
mod mutate;
pub mod nct;
pub mod readable;
mod setup;
pub mod splice;
mod state;
mod statements;
mod table;
mod ulp_perturbation;
mod values;
mod writer;

use std::collections::BTreeSet;

use gaugeblock_vocabulary::scenario::Start;
use gaugeblock_vocabulary::{Language, Program, Scenario};

pub use config::{BUDGET, GeneratorConfig};
pub use entropy::Entropy;
pub use kind::StatementKind;
pub use setup::Setups;
pub use table::TABLE;
pub use ulp_perturbation::ulp_perturbed;
pub use writer::Statement;

use readable::Readable;
use state::{State, Sub};
use writer::Writer;

/// Number of programs with one statement that are tried before the statement counts as unreadable.
const TRIES: u64 = 8;
/// Fewest and most blocks of these programs.
const BLOCKS: (u32, u32) = (1, 2);
/// Number of machines that are drawn until the controllers support one; after them the default machine is used.
const MACHINES: usize = 8;

/// A scenario. Its options are empty: the caller knows which documents apply.
pub fn scenario(entropy: &mut Entropy<'_>, config: &GeneratorConfig) -> Scenario {
    scenario_within(entropy, config, None)
}

/// A scenario that is mostly `readable`, if its language is RS-274.
pub fn scenario_within(
    entropy: &mut Entropy<'_>,
    config: &GeneratorConfig,
    readable: Option<Readable<'_>>,
) -> Scenario {
    match config.language {
        Language::Rs274 => scenario_and_kinds(entropy, config, readable).0,
        Language::Gpp => gpp::scenario(entropy, config),
        Language::Nct => nct::scenario(entropy, config),
    }
}

/// A scenario in RS-274, and the kinds of statements in its main program.
pub fn scenario_and_kinds(
    entropy: &mut Entropy<'_>,
    config: &GeneratorConfig,
    readable: Option<Readable<'_>>,
) -> (Scenario, BTreeSet<StatementKind>) {
    let mut scenario = setup(entropy, config, readable);
    let supports = |scenario: &Scenario, change: &dyn Fn(&mut Program)| {
        let Some(readable) = readable else { return true };
        let mut changed = scenario.clone();
        changed.program.main.push_str("m2\n");
        change(&mut changed.program);
        (readable.supports)(&changed)
    };
    let mut state = State::of(&scenario);
    state.no_arcs_at_distance = config.setups == Setups::StandAlone;
    if config.only.is_empty() && entropy.chance(15) {
        let name = *entropy.pick(&["cave", "drill_row", "x1"]);
        let blocks = entropy.range(1, 6);
        let mut writer = Writer::new(entropy, config, TABLE, state.clone(), (&scenario, readable));
        let file = (format!("{name}.ngc"), writer.sub_file(name, blocks));
        if supports(&scenario, &|program| program.files.extend([file.clone()])) {
            scenario.program.files.extend([file]);
            state.subs.push(Sub { label: format!("<{name}>"), numbered: false });
        }
    }
    let block_delete =
        entropy.chance(30) && supports(&scenario, &|program| program.block_delete = true);
    let mut writer = Writer::new(entropy, config, TABLE, state, (&scenario, readable));
    let main = writer.main();
    let kinds = writer.into_kinds();
    let by_hand = matches!(config.setups, Setups::Any | Setups::Operated)
        && scenario.operator.is_empty()
        && entropy.chance(4)
        && supports(&scenario, &|program| program.start = Start::Mdi);
    let start = if by_hand { Start::Mdi } else { Start::Program };
    scenario.program = Program { main, block_delete, start, ..scenario.program };
    scenario.budget = BUDGET;
    (scenario, kinds)
}

/// Names of unreadable statements: the controllers support none of the tried programs with them.
pub fn unreadable(
    config: &GeneratorConfig,
    supports: &dyn Fn(&Scenario) -> bool,
) -> BTreeSet<&'static str> {
    let none = BTreeSet::new();
    let readable = Readable { supports, unreadable: &none };
    let is_readable = |name: &str| {
        let config = GeneratorConfig {
            only: vec![name.to_owned()],
            blocks: BLOCKS,
            mutated_programs: 0,
            ..config.clone()
        };
        let written = |number| {
            let mut entropy = Entropy::from_seed(0, number);
            !scenario_and_kinds(&mut entropy, &config, Some(readable)).1.is_empty()
        };
        (0..TRIES).any(written)
    };
    let names = TABLE.iter().copied().flatten().map(|statement| statement.name);
    names.filter(|name| !is_readable(name)).collect()
}

/// A machine, an environment and an operator, that the controllers support.
fn setup(
    entropy: &mut Entropy<'_>,
    config: &GeneratorConfig,
    readable: Option<Readable<'_>>,
) -> Scenario {
    for _ in 0..MACHINES {
        let scenario = setup::scenario(entropy, config.setups);
        if readable.is_none_or(|readable| readable.has(&scenario, "m2\n".to_owned())) {
            return scenario;
        }
    }
    Scenario::default()
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
