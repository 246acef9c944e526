//! The ids of the suite's pages, as the compiler knows them: rules, and choices with their options. A dialect adds its
//! own.
//!
//! `cargo run -p gaugeblock-suite --bin model-ids` writes the chapters below from the pages; a test compares them. So
//! an id that no page has cannot be written, and a page that the model has not heard of is missed at once.

use std::fmt;
use std::sync::LazyLock;

#[macro_use]
pub(crate) mod chapter;

pub mod choice;
mod page;
pub mod rule;

pub use page::{Choice, Page, Rule};

use crate::dialects;

impl Rule {
    /// How many there are.
    pub const COUNT: usize = (Self::OF_DOCUMENTS + dialects::ID_COUNT) as usize;

    /// How many are those of the documents: the numbers of a dialect's begin here.
    pub(crate) const OF_DOCUMENTS: u16 = rule::COUNT + choice::COUNT;

    /// The id of its page.
    pub fn id(self) -> &'static str {
        IDS[usize::from(self.0)]
    }

    /// The chapter of its page: the part of the id before the point.
    pub fn chapter(self) -> &'static str {
        self.id().split('.').next().unwrap_or_default()
    }

    /// The rule with an id, if there is one.
    pub fn of(id: &str) -> Option<Self> {
        let place = BY_ID.binary_search_by_key(&id, |rule| rule.id()).ok()?;
        BY_ID.get(place).copied()
    }

    /// A choice, where an option of it refuses a block and no rule has its id.
    pub(crate) const fn of_choice<C: Choice>() -> Self {
        Self(rule::COUNT + C::NUMBER)
    }

    /// Its number among all, from 0.
    #[inline]
    pub(crate) const fn number(self) -> usize {
        self.0 as usize
    }

    /// The rule of a number.
    pub(crate) fn numbered(number: u32) -> Self {
        Self(u16::try_from(number).expect("coverage: a set holds rules alone"))
    }

    /// All of them, in the order of their numbers.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        (0..Self::OF_DOCUMENTS + dialects::ID_COUNT).map(Self)
    }
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

impl fmt::Debug for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

/// The id of each [`Rule`], by its number.
static IDS: LazyLock<Vec<&'static str>> = LazyLock::new(|| {
    let rules = rule::CHAPTERS.iter().flat_map(|chapter| chapter.iter().copied());
    let choices = choice::CHAPTERS.iter().flat_map(|chapter| chapter.iter().map(|page| page.id));
    let of_dialects = dialects::ID_CHAPTERS.iter().flat_map(|chapter| chapter.iter().copied());
    rules.chain(choices).chain(of_dialects).collect()
});

/// Each [`Rule`] by its id. Where a choice has the id of a rule, the id is the rule's.
static BY_ID: LazyLock<Vec<Rule>> = LazyLock::new(|| {
    let mut all: Vec<Rule> = Rule::all().collect();
    all.sort_by_key(|rule| rule.id());
    all.dedup_by_key(|rule| rule.id());
    all
});

/// The pages of all choices, in the order of their numbers.
pub fn pages() -> impl Iterator<Item = &'static Page> {
    choice::CHAPTERS.iter().flat_map(|chapter| chapter.iter())
}
