//! What is generated.

use gaugeblock_vocabulary::Language;
use gaugeblock_vocabulary::scenario::Budget;

use super::setup::Setups;

/// Budget of a generated scenario: loops in loops end soon enough.
pub const BUDGET: Budget = Budget { steps: 400, effects: 400, time: 10_000.0 };

/// What is generated.
#[derive(Clone, Debug)]
pub struct GeneratorConfig {
    /// The language. The fields below apply to RS-274, except for the mutated programs.
    pub language: Language,
    /// Whether programs of a post-processor have words of the old GPP.
    pub old_words: bool,
    /// Fewest and most blocks of the main program.
    pub blocks: (u32, u32),
    /// Percentage of programs with mutated blocks.
    pub mutated_programs: u32,
    /// Percentage of blocks that are mutated in such a program.
    pub mutated_blocks: u32,
    /// Percentage of programs that consist of one kind of statement.
    pub single_kind_programs: u32,
    /// Percentage of programs that may use rare statements.
    pub rare_programs: u32,
    /// Only statements whose name begins with one of these; all when empty.
    pub only: Vec<String>,
    /// Which machines, environments and operators.
    pub setups: Setups,
}

impl Default for GeneratorConfig {
    fn default() -> Self {
        Self {
            language: Language::Rs274,
            old_words: false,
            blocks: (4, 62),
            mutated_programs: 10,
            mutated_blocks: 5,
            single_kind_programs: 12,
            rare_programs: 8,
            only: Vec::new(),
            setups: Setups::Any,
        }
    }
}
