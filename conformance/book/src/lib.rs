//! The suite as a static site: what a rule, a code, a section of a document or a choice means, with programs and what
//! the documents demand of them.
//!
//! [`render`] makes all pages. It reads nothing but its arguments and writes nothing. The address of a page
//! depends on the id that it is about, so that a link to a rule stays valid as long as the rule exists.

mod address;
mod case;
mod choice_page;
mod code;
mod code_page;
mod contents;
mod document_page;
mod edition_page;
mod guide;
mod home;
mod rule_page;
mod search;
mod settings;
mod site;

pub use address::{anchor, choice as choice_address, code as code_address, rule as rule_address};
pub use code::{Code, CodeChoice, Explanation};
pub use contents::{Book, Guide, Page};
pub use guide::GUIDE;
pub use settings::{motion_settings, setting_lines, setup_settings};

use site::Site;

/// All files of the site, ordered by path. The model runs each case that a page has in full.
///
/// # Errors
/// A template does not fit: a fault of this program.
pub fn render(book: &Book<'_>) -> Result<Vec<Page>, String> {
    let mut site = Site::new(&book.suite.digest)?;
    home::add(book, &mut site)?;
    rule_page::add(book, &mut site)?;
    choice_page::add(book, &mut site)?;
    code_page::add(book, &mut site)?;
    document_page::add(book, &mut site)?;
    edition_page::add(book, &mut site)?;
    guide::add(book, &mut site)?;
    search::add(book, &mut site);
    Ok(site.into_pages())
}
