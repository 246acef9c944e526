//! Scenarios from choices: a program and its subroutine files, a machine, an environment, an operator.
//!
//! Choices come from [bytes or a seed](Dice). A program is written from the rows of a [table](TABLE), each of which
//! knows where it is possible, so that most programs are accepted; a dial makes some of them slightly wrong. [`odd`]
//! writes programs that are refused more often than not, [`gpp`] those of a post-processor, [`nct`] custom macros,
//! [`splice`] mixes what others wrote, [`pairs`] writes what must do the same as something else.

mod dice;
pub mod gpp;
pub mod nct;
mod nudge;
pub mod odd;
pub mod pairs;
mod rows;
mod setup;
pub mod splice;
mod state;
mod table;
mod values;
mod writer;
mod wrong;

use gaugeblock_vocabulary::scenario::{Budget, Start};
use gaugeblock_vocabulary::{Language, Program, Scenario};

pub use dice::Dice;
pub use nudge::nudged;
pub use setup::Setups;
pub use table::{Kind, Row, TABLE};

use state::{State, Sub};
use writer::Writer;

/// Budget of a generated scenario: loops in loops end soon enough.
pub const BUDGET: Budget = Budget { steps: 400, effects: 400, time: 10_000.0 };

/// What is generated.
#[derive(Clone, Debug)]
pub struct Recipe {
    /// In which language. What stands below but the programs that are wrong is of RS-274.
    pub language: Language,
    /// Whether programs of a post-processor have words of the old GPP.
    pub old_words: bool,
    /// Fewest and most blocks of the main program.
    pub blocks: (u32, u32),
    /// In how many of a hundred programs something is slightly wrong.
    pub wrong_programs: u32,
    /// How many of a hundred blocks are wrong in such a program.
    pub wrong_blocks: u32,
    /// How many of a hundred programs consist of one kind of statement.
    pub single_kind_programs: u32,
    /// How many of a hundred programs may use what not every controller does yet.
    pub later_programs: u32,
    /// Only rows whose name begins with one of these; all when empty. Single-rule programs are made so.
    pub only: Vec<String>,
    /// Which machines, environments and operators.
    pub setups: Setups,
}

impl Default for Recipe {
    fn default() -> Self {
        Self {
            language: Language::Rs274,
            old_words: false,
            blocks: (4, 62),
            wrong_programs: 10,
            wrong_blocks: 5,
            single_kind_programs: 12,
            later_programs: 8,
            only: Vec::new(),
            setups: Setups::Any,
        }
    }
}

/// A scenario. Its options are empty: which documents apply is the caller's to say.
pub fn scenario(dice: &mut Dice<'_>, recipe: &Recipe) -> Scenario {
    match recipe.language {
        Language::Rs274 => {}
        Language::Gpp => return gpp::scenario(dice, recipe),
        Language::Nct => return nct::scenario(dice, recipe),
    }
    let mut scenario = setup::scenario(dice, recipe.setups);
    let mut state = State::of(&scenario);
    let mut files = std::collections::BTreeMap::new();
    if recipe.only.is_empty() && dice.chance(15) {
        let name = *dice.pick(&["cave", "drill_row", "x1"]);
        let blocks = dice.range(1, 6);
        let text = Writer::new(dice, recipe, state.clone()).sub_file(name, blocks);
        files.insert(format!("{name}.ngc"), text);
        state.subs.push(Sub { label: format!("<{name}>"), numbered: false });
    }
    let block_delete = dice.chance(30);
    let main = Writer::new(dice, recipe, state).main();
    let by_hand = matches!(recipe.setups, Setups::Any | Setups::Operated)
        && scenario.operator.is_empty()
        && dice.chance(4);
    let start = if by_hand { Start::Mdi } else { Start::Program };
    scenario.program = Program { main, files, block_delete, start, ..scenario.program };
    scenario.budget = BUDGET;
    scenario
}

/// A scenario from the bytes of a fuzzing engine.
pub fn from_bytes(bytes: &[u8]) -> Scenario {
    scenario(&mut Dice::of_bytes(bytes), &Recipe::default())
}

/// The scenario of a number under a seed.
pub fn from_seed(seed: u64, number: u64, recipe: &Recipe) -> Scenario {
    scenario(&mut Dice::of_seed(seed, number), recipe)
}

/// A scenario whose program is these bytes, as far as they are text. A NUL is none.
pub fn raw(bytes: &[u8]) -> Scenario {
    let text = String::from_utf8_lossy(bytes).replace('\0', "\u{fffd}");
    Scenario { budget: BUDGET, ..Scenario::of(text) }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn a_number_under_a_seed_gives_one_scenario() {
        let recipe = Recipe::default();
        assert_eq!(from_seed(1, 2, &recipe), from_seed(1, 2, &recipe));
        assert_ne!(from_seed(1, 2, &recipe).program, from_seed(1, 3, &recipe).program);
    }

    #[test]
    fn rows_have_names_of_their_own_and_every_kind_has_one() {
        let rows: Vec<_> = TABLE.iter().copied().flatten().collect();
        let names: BTreeSet<_> = rows.iter().map(|row| row.name).collect();
        assert_eq!(names.len(), rows.len());
        let kinds: BTreeSet<_> = rows.iter().map(|row| row.kind).collect();
        assert_eq!(kinds, Kind::ALL.iter().copied().collect());
    }

    #[test]
    fn a_single_rule_can_be_asked_for() {
        let recipe =
            Recipe { only: vec!["dwell".to_owned()], wrong_programs: 0, ..Recipe::default() };
        let text = from_seed(1, 1, &recipe).program.main.to_lowercase();
        assert!(text.contains("g4"), "{text}");
        assert!(!text.contains("g0"), "{text}");
    }
}
