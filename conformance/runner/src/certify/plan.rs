//! What is run, and how.

use std::num::NonZero;

use gaugeblock_suite::{Edition, Suite};

/// What is run, and how.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// The suite.
    pub suite: &'a Suite,
    /// The edition that the controller is compared with.
    pub edition: &'a Edition,
    /// Only rules whose id begins with one of these, or single cases as verdicts name them (`RULE / CASE`); all when
    /// empty.
    pub only: &'a [String],
    /// How many cases run at once.
    pub jobs: NonZero<usize>,
}
