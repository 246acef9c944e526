//! The suite as a static site: what a rule, a code, a section of a document or a choice means, with programs and what
//! the documents demand of them.
//!
//! [`Book::render`] makes all pages. It reads nothing but its arguments and writes nothing. The address of a page
//! depends on the id that it is about, so that a link to a rule stays valid as long as the rule exists.

mod address;
mod case;
mod choice_page;
mod code;
mod code_page;
mod document_page;
mod edition_page;
mod guide;
mod home;
mod rule_page;
mod search;
mod settings;
mod site;

use gaugeblock_report::comparison::Comparison;
use gaugeblock_suite::Suite;
use gaugeblock_suite::ledger::Ledger;

pub use address::{anchor, choice as choice_address, code as code_address, rule as rule_address};
pub use code::{Code, CodeChoice, Explanation};
pub use guide::GUIDE;
pub use settings::{motion_settings, setting_lines, setup_settings};

use site::Site;

/// What a book is made from.
#[derive(Debug)]
pub struct Book<'a> {
    /// The rules, choices, quirks, editions and profiles.
    pub suite: &'a Suite,
    /// What became of each document.
    pub ledgers: &'a [Ledger],
    /// Reports of controllers; the page of a rule lists which of them keep it.
    pub comparison: Option<&'a Comparison>,
    /// Pages of the guide, such as [`GUIDE`].
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

impl Book<'_> {
    /// All files of the site, ordered by path. The model runs each case that a page has in full.
    ///
    /// # Errors
    /// A template does not fit: a fault of this program.
    pub fn render(&self) -> Result<Vec<Page>, String> {
        let mut site = Site::new(self)?;
        home::add(self, &mut site)?;
        rule_page::add(self, &mut site)?;
        choice_page::add(self, &mut site)?;
        code_page::add(self, &mut site)?;
        document_page::add(self, &mut site)?;
        edition_page::add(self, &mut site)?;
        guide::add(self, &mut site)?;
        search::add(self, &mut site);
        Ok(site.into_pages())
    }
}
