//! Scenarios of a post-processor: a program, and the toolpath that drives it.
//!
//! Most of them are accepted: variables are declared before they are used, have the type that belongs there, and
//! mostly a value. A dial spoils some statements and lines. Nothing is nudged: GPP has no function, and its rounding
//! is told to the last bit.

mod odd;
mod pairs;
mod program;
mod statements;
mod toolpath;
mod values;

use std::collections::BTreeMap;

use gaugeblock_vocabulary::scenario::Budget;
use gaugeblock_vocabulary::{Language, Program, Scenario};

use super::{BUDGET, Dice, Recipe};

pub use pairs::{Pair, modality};

/// A variable that a program may use.
#[derive(Clone, Debug)]
struct Known {
    name: String,
    /// Whether it is a text.
    text: bool,
    /// How many members it has, where it is an array.
    size: Option<u32>,
    /// Whether the toolpath declares it.
    system: bool,
}

/// A scenario. Its options are empty: which documents apply is the caller's to say.
pub(super) fn scenario(dice: &mut Dice<'_>, recipe: &Recipe) -> Scenario {
    let (toolpath, known, headings) = toolpath::toolpath(dice);
    let mut main = program::program(dice, known, &headings, recipe.old_words);
    let mut toolpath = toolpath;
    if dice.chance(recipe.wrong_programs) {
        for _ in 0..dice.range(1, 2) {
            let spoils_program = dice.chance(85);
            let text = if spoils_program { &mut main } else { &mut toolpath };
            *text = odd::spoilt(text, spoils_program, dice);
        }
    }
    let mut files = BTreeMap::new();
    if !dice.chance(2) {
        files.insert("toolpath".to_owned(), toolpath);
    }
    let program = Program { language: Language::Gpp, main, files, ..Program::default() };
    let budget = if dice.chance(15) {
        Budget { steps: dice.range(0, 60), effects: dice.range(0, 30), ..BUDGET }
    } else {
        BUDGET
    };
    Scenario { program, budget, ..Scenario::default() }
}
