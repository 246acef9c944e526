//! What a check comes to.

use std::collections::BTreeSet;

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::Outcome;

/// What a check came to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Came {
    /// As it should be.
    Fine(String),
    /// Not as it should be: the adapter has to be mended before a verdict means anything.
    Wrong(String),
    /// It could not be looked at, and why.
    LeftOut(String),
}

/// A check and what it came to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Check {
    /// What is looked at.
    pub what: &'static str,
    /// What came of it.
    pub came: Came,
}

/// A program that changes what a reset has to set back, and one that shows whether it was.
pub(super) const CHANGES: &str =
    "g20 g91 g18 f77 s500 m3 m8\n#31=5\n#<_kept>=6\ng92 x3\ng0 x1 y1 z1\nm2\n";

pub(super) fn same(
    first: &Outcome,
    again: &Result<Outcome, HarnessError>,
    otherwise: &str,
) -> Came {
    match again {
        Ok(again) if again == first => Came::Fine("the same outcome".to_owned()),
        Ok(again) => Came::Wrong(format!("{otherwise}: {}", difference(first, again))),
        Err(error) => Came::Wrong(error.to_string()),
    }
}

/// The first line in which the texts of two outcomes differ.
fn difference(a: &Outcome, b: &Outcome) -> String {
    let (a, b) = (a.to_text(), b.to_text());
    let (first, second): (BTreeSet<_>, BTreeSet<_>) = (a.lines().collect(), b.lines().collect());
    let gone = a.lines().find(|line| !second.contains(line)).unwrap_or("nothing").trim();
    let new = b.lines().find(|line| !first.contains(line)).unwrap_or("nothing").trim();
    format!("{gone:?} before, {new:?} now")
}
