//! What a verdict rests on: how many values of each kind were compared.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A kind of thing that is compared.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum ComparedKind {
    /// Assertions made by hand from the sentence.
    Assertions,
    /// How the run ended: whether it was accepted, where it was refused.
    Acceptance,
    /// Effects and their arguments.
    Effects,
    /// Settings in force at an effect or after a block.
    Settings,
    /// What else a state holds after a block.
    State,
    /// Numbered parameters at the end.
    Parameters,
    /// Values that pins took.
    Pins,
    /// Laws of motion over servo samples.
    Laws,
    /// Assertions that could not be judged: they were not compared.
    UnjudgedAssertions,
}

impl ComparedKind {
    /// All kinds that are compared, in the order in which they are told.
    pub const ALL: [Self; 8] = [
        Self::Assertions,
        Self::Acceptance,
        Self::Effects,
        Self::Settings,
        Self::State,
        Self::Parameters,
        Self::Pins,
        Self::Laws,
    ];

    /// One letter, for tables.
    pub fn letter(self) -> char {
        match self {
            Self::Assertions => 'h',
            Self::Acceptance => 'a',
            Self::Effects => 'e',
            Self::Settings => 's',
            Self::State => 't',
            Self::Parameters => 'p',
            Self::Pins => 'i',
            Self::Laws => 'm',
            Self::UnjudgedAssertions => 'u',
        }
    }

    /// The meaning of the letter.
    pub fn words(self) -> &'static str {
        match self {
            Self::Assertions => "assertions by hand",
            Self::Acceptance => "acceptance",
            Self::Effects => "effects",
            Self::Settings => "settings",
            Self::State => "state",
            Self::Parameters => "parameters at the end",
            Self::Pins => "pins",
            Self::Laws => "laws of motion",
            Self::UnjudgedAssertions => "assertions that could not be judged",
        }
    }
}

/// How many values of each kind were compared; a kind that is not listed was not compared at all.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Tally(BTreeMap<ComparedKind, usize>);

impl Tally {
    /// Counts values of a kind.
    pub fn add(&mut self, basis: ComparedKind, count: usize) {
        if count > 0 {
            *self.0.entry(basis).or_default() += count;
        }
    }

    /// Counts what another tally counted.
    pub fn extend(&mut self, other: &Self) {
        for (basis, count) in &other.0 {
            self.add(*basis, *count);
        }
    }

    /// All compared values together.
    pub fn total(&self) -> usize {
        ComparedKind::ALL.into_iter().map(|basis| self.of(basis)).sum()
    }

    /// How many assertions could not be judged.
    pub fn unjudged(&self) -> usize {
        self.of(ComparedKind::UnjudgedAssertions)
    }

    /// How many of one kind.
    pub fn of(&self, basis: ComparedKind) -> usize {
        self.0.get(&basis).copied().unwrap_or_default()
    }

    /// The letters of the kinds that were compared.
    pub fn letters(&self) -> String {
        ComparedKind::ALL
            .into_iter()
            .filter(|basis| self.of(*basis) > 0)
            .map(ComparedKind::letter)
            .collect()
    }
}
