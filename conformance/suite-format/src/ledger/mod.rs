//! The sentence ledger: what became of each sentence, list item, table row and example of a
//! document. Either rules carry it, or it says why none does.
//!
//! The text itself is not here, since it is under its owner's licence. A digest of each item's
//! words lets anyone who has the document [`check`] the ledger against it, and [`extract`] begins
//! a ledger for another document.

mod asciidoc;
mod carriers;
mod check;
mod collector;
mod comments;
mod digest;
mod kind;
mod manual;
mod markdown;
mod printed_page;
mod split;
#[cfg(test)]
mod tests;
mod web;
mod write;

use std::collections::BTreeSet;
use std::fmt;

use serde::{Deserialize, Serialize};

pub use carriers::absent;
pub use check::{Mismatch, check};
pub use collector::{TextItem, TextSection};
pub use digest::{digest, file_digest, words};
pub use kind::Kind;
pub use split::{Form, extract};

/// The issues that carry what this suite does not carry yet; an item's `later` names one.
pub const LATER_ISSUES: [&str; 2] =
    ["Motion, cycles and offsets", "Custom macros and post-processor variables"];

/// What became of one document.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ledger {
    /// The name under which the sources of rule pages cite it.
    pub document: String,
    /// Its title, for people.
    pub title: String,
    /// The edition of the document.
    pub edition: String,
    /// How its text is set out.
    pub form: Form,
    /// The SHA-256 of the whole file as given.
    pub sha256: String,
    /// Whether the ledger covers only some of the document's sections.
    #[serde(default)]
    pub partial: bool,
    /// Its sections in the order of the document.
    #[serde(rename = "section")]
    pub sections: Vec<Section>,
}

/// One section with its items: the text under one heading, up to the next of any level.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Section {
    /// The words of its heading; no two sections of a document share a name.
    pub name: String,
    /// Its items in order.
    pub items: Vec<Item>,
    /// Grids and cases that check every value of an item.
    #[serde(default)]
    pub grids: Vec<ItemGrid>,
}

/// A grid, or a case, that checks every value of some items.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ItemGrid {
    /// The ordinals of the items.
    pub n: Vec<usize>,
    /// Its rule and its name, as `RULE / NAME`.
    pub name: String,
}

/// What became of one item.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Item {
    /// Its ordinal in its section, from 1.
    pub n: usize,
    /// What it is.
    pub kind: Kind,
    /// The digest of its words.
    pub digest: String,
    /// The rules that carry it.
    #[serde(default)]
    pub rules: Vec<String>,
    /// The choices that it is a source of.
    #[serde(default)]
    pub choices: Vec<String>,
    /// The quirks of controllers that differ from it.
    #[serde(default)]
    pub quirks: Vec<String>,
    /// Why no observation of a run could confirm or contradict it.
    pub not_observable: Option<String>,
    /// Why the suite does not cover it.
    pub out_of_scope: Option<String>,
    /// The later issue that carries it, or the rest of it where rules carry a part.
    pub later: Option<String>,
}

impl Ledger {
    /// Reads a ledger file.
    ///
    /// # Errors
    /// What is wrong with it as a TOML file of this form, or as a ledger: see [`LedgerError`].
    pub fn parse(text: &str) -> Result<Self, LedgerError> {
        let ledger: Self = toml::from_str(text).map_err(LedgerError::Form)?;
        let faults = ledger.faults();
        if faults.is_empty() { Ok(ledger) } else { Err(LedgerError::Content(faults)) }
    }

    /// Begins the ledger of a document: all its items, none of them classified.
    pub fn begin(document: &str, title: &str, form: Form, document_text: &str) -> Self {
        let sections = extract(document_text, form);
        Self {
            document: document.to_owned(),
            title: title.to_owned(),
            edition: document.to_owned(),
            form,
            sha256: file_digest(document_text.as_bytes()),
            partial: false,
            sections: sections.iter().map(Section::unclassified).collect(),
        }
    }

    /// The item with this ordinal in the section of this name.
    pub fn item(&self, section: &str, ordinal: usize) -> Option<&Item> {
        let section = self.section(section)?;
        section.items.get(ordinal.checked_sub(1)?)
    }

    /// The section of this name.
    pub fn section(&self, name: &str) -> Option<&Section> {
        self.sections.iter().find(|section| section.name == name)
    }

    /// Every fault of the ledger, each with its place.
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let mut names = BTreeSet::new();
        for section in &self.sections {
            let name = &section.name;
            if !names.insert(name) {
                faults.push(format!("{name}: two sections of this name"));
            }
            for (item, expected) in section.items.iter().zip(1..) {
                if item.n != expected {
                    faults.push(format!("{name}: item {} is at place {expected}", item.n));
                }
                if let Some(fault) = item.fault() {
                    faults.push(format!("{name} {}: {fault}", item.n));
                }
            }
        }
        faults
    }
}

impl Section {
    fn unclassified(section: &TextSection) -> Self {
        let items = section.items.iter().zip(1..).map(|(item, n)| Item::unclassified(item, n));
        Self { name: section.name.clone(), items: items.collect(), grids: Vec::new() }
    }
}

impl Item {
    fn unclassified(item: &TextItem, n: usize) -> Self {
        Self {
            n,
            kind: item.kind,
            digest: digest(item.kind, &item.text),
            rules: Vec::new(),
            choices: Vec::new(),
            quirks: Vec::new(),
            not_observable: None,
            out_of_scope: None,
            later: None,
        }
    }

    /// Why the item is not classified, or in more than one way. Rules or a choice carry it, or it has one of the three
    /// reasons; only `later` may be combined with rules.
    fn fault(&self) -> Option<&'static str> {
        let carried = !self.rules.is_empty() || !self.choices.is_empty();
        let set_aside = [&self.not_observable, &self.out_of_scope].into_iter().flatten().count();
        let later = usize::from(self.later.is_some());
        if let Some(issue) = &self.later
            && !LATER_ISSUES.contains(&issue.as_str())
        {
            return Some("the later issue has no such name");
        }
        if [&self.not_observable, &self.out_of_scope].into_iter().flatten().any(String::is_empty) {
            return Some("the reason is empty");
        }
        match usize::from(carried) + later + set_aside {
            0 => Some("not classified"),
            1 => None,
            _ if set_aside == 0 => None,
            _ => Some("classified in two ways that exclude each other"),
        }
    }
}

/// Why a file is not a valid ledger.
#[derive(Clone, Debug)]
pub enum LedgerError {
    /// It is not a TOML file of the ledger's form.
    Form(toml::de::Error),
    /// It is incomplete or contradicts itself: every fault with its place.
    Content(Vec<String>),
}

impl fmt::Display for LedgerError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Form(error) => write!(out, "{error}"),
            Self::Content(faults) => write!(out, "{}", faults.join("\n")),
        }
    }
}

impl std::error::Error for LedgerError {}
