//! Limits generated programs to the codes, words and machines that the controllers support.

use std::collections::BTreeSet;
use std::fmt;

use gaugeblock_vocabulary::{Program, Scenario};

/// The programs that the controllers support. Without it each program is written.
#[derive(Clone, Copy)]
pub struct Readable<'a> {
    /// Whether the controllers can run a scenario.
    pub supports: &'a dyn Fn(&Scenario) -> bool,
    /// Names of statements that no supported program has.
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
