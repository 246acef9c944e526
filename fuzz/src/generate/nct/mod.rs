//! Scenarios of custom macros: a main program, macros and subprograms after it, and how blocks are deleted.
//!
//! Most of them are accepted: programs that are called exist, loops are closed, each label is defined once, and a feed
//! is set before a move. What the documents leave open is rarely written. Some blocks are mutated.

mod malformed;
mod metamorphic;
mod program;
mod statements;
mod values;

use gaugeblock_vocabulary::scenario::Budget;
use gaugeblock_vocabulary::{Language, Program, Scenario};

use super::{BUDGET, Entropy, GeneratorConfig};

pub use metamorphic::{Counted, Pair, count, locals};

/// A scenario. Its options are empty: the caller knows which documents apply.
pub(super) fn scenario(entropy: &mut Entropy<'_>, config: &GeneratorConfig) -> Scenario {
    let mut main = program::programs(entropy);
    if entropy.chance(config.mutated_programs) {
        for _ in 0..entropy.range(1, 2) {
            main = malformed::mutated_block(&main, entropy);
        }
    }
    let block_delete = entropy.chance(30);
    let program = Program { language: Language::Nct, main, block_delete, ..Program::default() };
    let budget = if entropy.chance(15) {
        let time = f64::from(entropy.range(0, 20));
        Budget { steps: entropy.range(0, 80), effects: entropy.range(0, 30), time }
    } else {
        BUDGET
    };
    Scenario { program, budget, ..Scenario::default() }
}
