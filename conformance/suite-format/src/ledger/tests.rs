//! Holds the ledgers of the suite against its pages, in both directions.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::{Item, Ledger};

/// What these tests read of a rule, choice or quirk page.
#[derive(Deserialize)]
struct Page {
    id: String,
    #[serde(default)]
    sources: Vec<Source>,
    /// Editions in which a rule does not exist; an edition is named like its document.
    #[serde(default)]
    void: BTreeMap<String, String>,
}

#[derive(Deserialize)]
struct Source {
    document: String,
    section: String,
    ordinal: Option<usize>,
}

/// The three shelves of pages; a rule and a choice may share an id.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Shelf {
    Rules,
    Choices,
    Quirks,
}

impl Shelf {
    const ALL: [Self; 3] = [Self::Rules, Self::Choices, Self::Quirks];

    fn of(chapter: &str) -> Self {
        match chapter {
            "choices" => Self::Choices,
            "quirks" => Self::Quirks,
            _ => Self::Rules,
        }
    }

    fn ids(self, item: &Item) -> &[String] {
        match self {
            Self::Rules => &item.rules,
            Self::Choices => &item.choices,
            Self::Quirks => &item.quirks,
        }
    }
}

/// A page at an item: document, section, ordinal, shelf, id.
type Link = (String, String, usize, Shelf, String);

fn suite() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../suite")
}

/// The files in a folder that end in `.toml`, in order.
fn toml_files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    files.sort();
    files
}

/// Every ledger that loads; what is wrong with the others goes to the violations.
fn ledgers(violations: &mut Vec<String>) -> BTreeMap<String, Ledger> {
    let mut ledgers = BTreeMap::new();
    for path in toml_files(&suite().join("documents")) {
        match Ledger::parse(&fs::read_to_string(&path).unwrap()) {
            Ok(ledger) => {
                if path.file_stem().unwrap().to_str() != Some(ledger.document.as_str()) {
                    violations.push(format!("{}: named unlike its document", path.display()));
                }
                ledgers.insert(ledger.document.clone(), ledger);
            }
            Err(error) => violations.push(format!("{}: {error}", path.display())),
        }
    }
    ledgers
}

fn pages(violations: &mut Vec<String>) -> Vec<(Shelf, Page)> {
    let mut pages = Vec::new();
    let mut folders: Vec<PathBuf> =
        fs::read_dir(suite()).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    for folder in folders.iter().filter(|path| path.is_dir() && !path.ends_with("documents")) {
        let chapter = folder.file_name().unwrap().to_str().unwrap();
        for path in toml_files(folder) {
            match toml::from_str(&fs::read_to_string(&path).unwrap()) {
                Ok(page) => pages.push((Shelf::of(chapter), page)),
                Err(error) => violations.push(format!("{}: {error}", path.display())),
            }
        }
    }
    pages
}

/// What the pages say: every source in a document that has a ledger, if that has such an item.
fn links_of_pages(
    pages: &[(Shelf, Page)],
    ledgers: &BTreeMap<String, Ledger>,
    violations: &mut Vec<String>,
) -> BTreeSet<Link> {
    let mut links = BTreeSet::new();
    for (shelf, page) in pages {
        for source in &page.sources {
            let Some(ledger) = ledgers.get(&source.document) else { continue };
            let Source { document, section, ordinal } = source;
            let place = format!("{shelf:?} {} cites {document} \"{section}\"", page.id);
            if page.void.contains_key(document) {
                violations.push(format!("{place}: void in that edition"));
            }
            if ledger.section(section).is_none() {
                if !ledger.partial {
                    violations.push(format!("{place}: no such section"));
                }
                continue;
            }
            match ordinal {
                Some(n) if ledger.item(section, *n).is_some() => {
                    links.insert((document.clone(), section.clone(), *n, *shelf, page.id.clone()));
                }
                Some(n) => violations.push(format!("{place} {n}: no such ordinal")),
                None => violations.push(format!("{place}: without an ordinal")),
            }
        }
    }
    links
}

/// What the ledgers say.
fn links_of_ledgers(ledgers: &BTreeMap<String, Ledger>) -> BTreeSet<Link> {
    let mut links = BTreeSet::new();
    for ledger in ledgers.values() {
        for section in &ledger.sections {
            for item in &section.items {
                for shelf in Shelf::ALL {
                    for id in shelf.ids(item) {
                        let document = ledger.document.clone();
                        links.insert((document, section.name.clone(), item.n, shelf, id.clone()));
                    }
                }
            }
        }
    }
    links
}

#[test]
fn every_ledger_is_complete_and_agrees_with_the_pages() {
    let mut violations = Vec::new();
    let ledgers = ledgers(&mut violations);
    assert!(!ledgers.is_empty(), "no ledger was found");
    let pages = pages(&mut violations);
    let known: BTreeSet<(Shelf, &str)> =
        pages.iter().map(|(shelf, page)| (*shelf, page.id.as_str())).collect();
    let from_pages = links_of_pages(&pages, &ledgers, &mut violations);
    let from_ledgers = links_of_ledgers(&ledgers);
    for (document, section, n, shelf, id) in from_ledgers.difference(&from_pages) {
        let why = if known.contains(&(*shelf, id.as_str())) {
            "has no such source"
        } else {
            "does not exist"
        };
        violations.push(format!("{document} \"{section}\" {n} names {shelf:?} {id}, which {why}"));
    }
    for (document, section, n, shelf, id) in from_pages.difference(&from_ledgers) {
        violations.push(format!("{document} \"{section}\" {n} does not name {shelf:?} {id}"));
    }
    assert!(violations.is_empty(), "{} violations:\n{}", violations.len(), violations.join("\n"));
}

#[test]
fn every_ledger_is_in_canonical_form() {
    for path in toml_files(&suite().join("documents")) {
        let text = fs::read_to_string(&path).unwrap();
        let ledger = Ledger::parse(&text).unwrap();
        let written = ledger.to_toml();
        if std::env::var_os("GAUGEBLOCK_BLESS").is_some() {
            fs::write(&path, written).unwrap();
            continue;
        }
        let hint = "write it with `GAUGEBLOCK_BLESS=1 cargo test -p gaugeblock-suite canonical`";
        assert!(written == text, "{} is not in canonical form: {hint}", path.display());
    }
}

#[test]
fn faults_of_a_ledger_are_named_with_their_places() {
    let text = "== A\n\nOne. Two. Three. Four. Five.\n";
    let mut ledger = Ledger::begin("ours", "Ours", super::Form::Asciidoc, text);
    let items = &mut ledger.sections[0].items;
    items[0].rules = vec!["a.b".into()];
    items[0].not_observable = Some("both".into());
    items[1].later = Some("some day".into());
    items[2].out_of_scope = Some(String::new());
    items[3].rules = vec!["a.b".into()];
    items[3].later = Some("Motion, cycles and offsets".into());
    items[3].n = 5;
    assert_eq!(
        ledger.faults(),
        [
            "A 1: classified in two ways that exclude each other",
            "A 2: the later issue has no such name",
            "A 3: the reason is empty",
            "A: item 5 is at place 4",
            "A 5: not classified",
        ]
    );
}
