//! Scenarios of a post-processor: a program, and the toolpath that drives it.
//!
//! Most of them are accepted: variables are declared before they are used, have the type that belongs there, and
//! mostly a value. Some statements and lines are mutated. There is no ULP perturbation: GPP has no function, and the
//! documents define its rounding exactly.

mod malformed;
mod metamorphic;
mod program;
mod statements;
mod toolpath;
mod values;
mod variable;

use std::collections::BTreeMap;

use gaugeblock_vocabulary::scenario::Budget;
use gaugeblock_vocabulary::{Language, Program, Scenario};

use super::{BUDGET, Entropy, GeneratorConfig};

pub use metamorphic::{Pair, modality};

/// A scenario. Its options are empty: the caller knows which documents apply.
pub(super) fn scenario(entropy: &mut Entropy<'_>, config: &GeneratorConfig) -> Scenario {
    let (toolpath, known, headings) = toolpath::toolpath(entropy);
    let mut main = program::program(entropy, known, &headings, config.old_words);
    let mut toolpath = toolpath;
    if entropy.chance(config.mutated_programs) {
        for _ in 0..entropy.range(1, 2) {
            let spoils_program = entropy.chance(85);
            let text = if spoils_program { &mut main } else { &mut toolpath };
            *text = malformed::mutated_block(text, spoils_program, entropy);
        }
    }
    let mut files = BTreeMap::new();
    if !entropy.chance(2) {
        files.insert("toolpath".to_owned(), toolpath);
    }
    let program = Program { language: Language::Gpp, main, files, ..Program::default() };
    let budget = if entropy.chance(15) {
        Budget { steps: entropy.range(0, 60), effects: entropy.range(0, 30), ..BUDGET }
    } else {
        BUDGET
    };
    Scenario { program, budget, ..Scenario::default() }
}
