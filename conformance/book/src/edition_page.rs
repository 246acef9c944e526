//! A page for each edition, and a table that compares them choice by choice.

use std::collections::BTreeMap;

use gaugeblock_suite::{Edition, Suite};
use serde::Serialize;

use super::address;
use super::contents::Book;
use super::site::{Link, Links, Listing, Site};

#[derive(Debug, Serialize)]
struct EditionPage {
    sentence: String,
    base: Option<Link>,
    documents: Vec<Link>,
    rules: usize,
    /// What it chooses differently from its base, or from the first option of each choice.
    options: Vec<Chosen>,
}

#[derive(Debug, Serialize)]
struct Chosen {
    choice: Link,
    option: String,
    means: String,
    instead_of: String,
}

pub(super) fn add(book: &Book<'_>, site: &mut Site) -> Result<(), String> {
    let suite = book.suite;
    let mut links = Vec::new();
    for edition in &suite.editions {
        let page = page(book, edition);
        let path = address::edition(&edition.id);
        links.push(link(suite, &edition.id));
        site.add(&path, "edition.html", ["editions", &edition.id], page)?;
    }
    let about = "An edition is a set of documents with one option of each choice.".to_owned();
    let groups = vec![Links { title: String::new(), links }];
    let listing = Listing { about, groups };
    site.add("editions/index.html", "list.html", ["editions", "Editions"], listing)
}

fn link(suite: &Suite, id: &str) -> Link {
    Link {
        address: address::edition(id),
        name: id.to_owned(),
        sentence: suite.edition(id).map(|it| it.sentence.clone()).unwrap_or_default(),
    }
}

fn page(book: &Book<'_>, edition: &Edition) -> EditionPage {
    let suite = book.suite;
    let documents = edition.documents.iter().map(|id| {
        let ledger = book.ledgers.iter().find(|ledger| ledger.document == *id);
        Link {
            address: address::document(id),
            name: id.clone(),
            sentence: ledger.map(|it| it.title.clone()).unwrap_or_default(),
        }
    });
    EditionPage {
        sentence: edition.sentence.clone(),
        base: edition.base.as_deref().map(|id| link(suite, id)),
        documents: documents.collect(),
        rules: suite.rules.iter().filter(|rule| rule.is_judged_in(edition)).count(),
        options: chosen(suite, edition),
    }
}

fn chosen(suite: &Suite, edition: &Edition) -> Vec<Chosen> {
    let base = edition.base.as_deref().and_then(|id| suite.edition(id));
    let others: BTreeMap<String, String> = base.map_or_else(
        || suite.defaults().0.iter().map(|(id, option)| (id.clone(), option.clone())).collect(),
        |base| suite.options(base).0.iter().map(|(id, it)| (id.clone(), it.clone())).collect(),
    );
    let own = suite.options(edition);
    let differs =
        own.0.iter().filter(|(id, option)| others.get(*id).is_none_or(|it| it != *option));
    let chosen = differs.filter_map(|(id, option)| {
        let choice = suite.choices.iter().find(|choice| choice.id == *id)?;
        let named = choice.options.iter().find(|it| it.name == *option)?;
        Some(Chosen {
            choice: super::choice_page::link(choice),
            option: option.clone(),
            means: named.means.clone(),
            instead_of: others.get(id).cloned().unwrap_or_default(),
        })
    });
    chosen.collect()
}
