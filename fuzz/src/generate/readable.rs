//! Programs that controllers can read: a controller may know only some codes, words and machines.

use std::collections::BTreeSet;
use std::fmt;

use gaugeblock_vocabulary::{Program, Scenario};

use super::{Entropy, GeneratorConfig, TABLE, scenario_and_kinds};

/// Programs of one statement that are tried before it counts as one that is never readable.
const TRIES: u64 = 8;

/// Their fewest and most blocks.
const BLOCKS: (u32, u32) = (1, 2);

/// What controllers can read. Without it everything is readable.
#[derive(Clone, Copy)]
pub struct Readable<'a> {
    /// Whether the controllers can run a scenario.
    pub supports: &'a dyn Fn(&Scenario) -> bool,
    /// Names of statements that are never readable.
    pub unreadable: &'a BTreeSet<&'static str>,
}

impl fmt::Debug for Readable<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Readable").field("unreadable", self.unreadable).finish()
    }
}

impl Readable<'_> {
    /// Whether the controllers can run these blocks on the machine of a scenario.
    pub(super) fn has(&self, base: &Scenario, blocks: String) -> bool {
        let program = Program { main: blocks, ..base.program.clone() };
        (self.supports)(&Scenario { program, ..base.clone() })
    }
}

/// Names of the statements that controllers never can read: they support no program of any.
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
