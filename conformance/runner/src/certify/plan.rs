//! What is run, and how.

use std::num::NonZero;

use gaugeblock_suite::{Edition, Suite};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What is run, and how.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// The suite.
    pub suite: &'a Suite,
    /// The edition that the controller is compared with.
    pub edition: &'a Edition,
    /// Only the rules and cases that one of these selects, each as a [`Selector`](gaugeblock_suite::Selector) reads
    /// it; all when empty.
    pub only: &'a [String],
    /// How many cases run at once.
    pub jobs: NonZero<usize>,
    /// What the verdicts look at.
    pub scope: Scope,
}

/// What the verdict on a case looks at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Scope {
    /// Its assertions, and the whole outcome compared with the model's.
    #[default]
    Full,
    /// Its assertions only, which people wrote. The model does not run the case.
    AssertionsOnly,
}

impl Scope {
    /// What a report prints of a scope that is not the full one.
    pub fn note(self) -> Option<&'static str> {
        match self {
            Self::Full => None,
            Self::AssertionsOnly => Some("assertions only"),
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        self.note().unwrap_or("full")
    }
}
