//! Scenarios of custom macros: a main program, macros and subprograms behind it, and how blocks are deleted.
//!
//! Most of them are accepted: programs that are called exist, loops are closed, labels stand once and ahead of their
//! jumps, and a feed is set before anything moves. What documents leave open is written seldom. A dial spoils some
//! blocks.

mod odd;
mod pairs;
mod program;
mod statements;
mod values;

use gaugeblock_vocabulary::scenario::Budget;
use gaugeblock_vocabulary::{Language, Program, Scenario};

use super::{BUDGET, Dice, Recipe};

pub use pairs::{Counted, Pair, count, locals};

/// A scenario. Its options are empty: which documents apply is the caller's to say.
pub(super) fn scenario(dice: &mut Dice<'_>, recipe: &Recipe) -> Scenario {
    let mut main = program::programs(dice);
    if dice.chance(recipe.wrong_programs) {
        for _ in 0..dice.range(1, 2) {
            main = odd::spoilt(&main, dice);
        }
    }
    let block_delete = dice.chance(30);
    let program = Program { language: Language::Nct, main, block_delete, ..Program::default() };
    let budget = if dice.chance(15) {
        let time = f64::from(dice.range(0, 20));
        Budget { steps: dice.range(0, 80), effects: dice.range(0, 30), time }
    } else {
        BUDGET
    };
    Scenario { program, budget, ..Scenario::default() }
}
