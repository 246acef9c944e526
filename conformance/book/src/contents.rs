//! What a book is made from, and what it consists of.

use gaugeblock_report::comparison::Comparison;
use gaugeblock_suite::Suite;
use gaugeblock_suite::ledger::Ledger;

/// What a book is made from.
#[derive(Debug)]
pub struct Book<'a> {
    /// The rules, choices, quirks, editions and profiles.
    pub suite: &'a Suite,
    /// What became of each document.
    pub ledgers: &'a [Ledger],
    /// Reports of controllers; the page of a rule lists which of them keep it.
    pub comparison: Option<&'a Comparison>,
    /// Pages of the guide, such as those of [`GUIDE`](crate::GUIDE).
    pub guide: &'a [Guide],
    /// Beginning of the addresses at which files of the repository can be read.
    pub repository: Option<&'a str>,
}

/// A page of the guide in Markdown.
#[derive(Clone, Debug)]
pub struct Guide {
    /// Path of its source within the repository, such as `docs/tutorial.md`.
    pub path: &'static str,
    /// The text.
    pub text: &'static str,
}

/// A file of the site.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// Its path within the site, such as `rules/saved-state.feed.html`.
    pub path: String,
    /// Its text.
    pub text: String,
}
