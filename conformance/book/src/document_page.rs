//! A page for each document: what became of each of its sentences.

use gaugeblock_suite::Suite;
use gaugeblock_suite::ledger::{Item, Ledger, Section};
use serde::Serialize;

use super::address::{self, anchor};
use super::contents::Book;
use super::site::{Link, Links, Listing, Site};

#[derive(Debug, Serialize)]
struct DocumentPage {
    about: String,
    sections: Vec<SectionView>,
}

#[derive(Debug, Serialize)]
struct SectionView {
    anchor: String,
    name: String,
    public: Option<String>,
    items: Vec<ItemView>,
}

/// A sentence, list item, table row or example.
#[derive(Debug, Serialize)]
struct ItemView {
    ordinal: usize,
    kind: String,
    pages: Vec<Link>,
    /// Why no page carries it, or all of it.
    reason: String,
}

pub(super) fn add(book: &Book<'_>, site: &mut Site) -> Result<(), String> {
    let mut links = Vec::new();
    for ledger in book.ledgers {
        let address = address::document(&ledger.document);
        links.push(Link {
            address: address.clone(),
            name: ledger.document.clone(),
            sentence: ledger.title.clone(),
        });
        let page = DocumentPage {
            about: ledger.title.clone(),
            sections: ledger.sections.iter().map(|it| section(book.suite, ledger, it)).collect(),
        };
        site.add(&address, "document.html", ["documents", &ledger.document], page)?;
    }
    let about =
        "The documents that the rules are read from: what became of each sentence.".to_owned();
    let groups = vec![Links { title: String::new(), links }];
    let listing = Listing { about, groups };
    site.add("documents/index.html", "list.html", ["documents", "Documents"], listing)
}

fn section(suite: &Suite, ledger: &Ledger, section: &Section) -> SectionView {
    SectionView {
        anchor: anchor(&section.name),
        name: section.name.clone(),
        public: address::public(&ledger.document, &section.name),
        items: section.items.iter().map(|it| item(suite, it)).collect(),
    }
}

fn item(suite: &Suite, item: &Item) -> ItemView {
    let link =
        |address: String, id: &String| Link { address, name: id.clone(), sentence: String::new() };
    // A ledger names some choices of motion among its rules.
    let rules = item.rules.iter().map(|id| match suite.rule(id) {
        Some(_) => link(address::rule(id), id),
        None => link(address::choice(id), id),
    });
    let choices = item.choices.iter().chain(&item.quirks);
    let reasons = [
        ("not observable", &item.not_observable),
        ("out of scope", &item.out_of_scope),
        ("later", &item.later),
    ];
    let reasons =
        reasons.into_iter().filter_map(|(kind, why)| Some(format!("{kind}: {}", why.as_ref()?)));
    ItemView {
        ordinal: item.n,
        kind: item.kind.to_string(),
        pages: rules.chain(choices.map(|id| link(address::choice(id), id))).collect(),
        reason: reasons.collect::<Vec<_>>().join("; "),
    }
}
