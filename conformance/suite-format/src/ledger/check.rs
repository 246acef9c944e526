//! Holds a ledger against the document that it was made from.

use std::collections::BTreeSet;
use std::fmt;

use super::collector::{TextItem, TextSection};
use super::digest::{digest, file_digest};
use super::split::extract;
use super::{Item, Ledger, Section};

/// One place at which a document is not what its ledger says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mismatch {
    /// The file as a whole is another one. Reported only beside others: blanks and markup may
    /// differ as long as the words agree.
    OtherFile {
        /// The SHA-256 in the ledger.
        ledger: String,
        /// The SHA-256 of the document at hand.
        document: String,
    },
    /// The document lacks a section of the ledger.
    NoSuchSection {
        /// Its name.
        section: String,
    },
    /// The ledger lacks a section of the document.
    NewSection {
        /// Its name.
        section: String,
    },
    /// The document's section ends before this item.
    NoSuchItem {
        /// The section.
        section: String,
        /// The item's ordinal.
        ordinal: usize,
    },
    /// The ledger's section ends before this item.
    NewItem {
        /// The section.
        section: String,
        /// The item's ordinal.
        ordinal: usize,
        /// The item in the document.
        text: String,
    },
    /// The item contains *all*, *any*, *every* or *each*, and the ledger names no grid or case for it.
    NoGrid {
        /// The section.
        section: String,
        /// The item's ordinal.
        ordinal: usize,
        /// The item in the document.
        text: String,
    },
    /// The item has other words, or is another kind of item.
    OtherItem {
        /// The section.
        section: String,
        /// The item's ordinal.
        ordinal: usize,
        /// Kind and digest in the ledger.
        ledger: String,
        /// Kind and digest of the document's item.
        document: String,
        /// The item in the document.
        text: String,
    },
}

impl fmt::Display for Mismatch {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OtherFile { ledger, document } => {
                write!(out, "the ledger was made from another file: {ledger}, not {document}")
            }
            Self::NoSuchSection { section } => {
                write!(out, "\"{section}\": the document has no section of this name")
            }
            Self::NewSection { section } => {
                write!(out, "\"{section}\": the ledger has no section of this name")
            }
            Self::NoSuchItem { section, ordinal } => {
                write!(out, "\"{section}\" {ordinal}: the document's section ends before it")
            }
            Self::NewItem { section, ordinal, text } => {
                write!(out, "\"{section}\" {ordinal}: the ledger's section ends before it: {text}")
            }
            Self::NoGrid { section, ordinal, text } => {
                write!(
                    out,
                    "\"{section}\" {ordinal}: the ledger names no grid or case for it: {text}"
                )
            }
            Self::OtherItem { section, ordinal, ledger, document, text } => write!(
                out,
                "\"{section}\" {ordinal}: the ledger has {ledger}, the document {document}: {text}"
            ),
        }
    }
}

/// Compares each item of the ledger with the document. A partial ledger need not name grids.
///
/// # Errors
/// Every mismatch, in the order of the document.
pub fn check(document_text: &str, ledger: &Ledger) -> Result<(), Vec<Mismatch>> {
    let document = extract(document_text, ledger.form);
    let mut mismatches = Vec::new();
    for section in &ledger.sections {
        match document.iter().find(|candidate| candidate.name == section.name) {
            Some(found) => compare_section(section, found, &mut mismatches),
            None => {
                mismatches.push(Mismatch::NoSuchSection { section: section.name.clone() });
            }
        }
    }
    if ledger.partial {
        mismatches.retain(|mismatch| !matches!(mismatch, Mismatch::NoGrid { .. }));
    } else {
        mismatches.extend(new_sections(ledger, &document));
    }
    if mismatches.is_empty() {
        return Ok(());
    }
    let found = file_digest(document_text.as_bytes());
    if found != ledger.sha256 {
        let other = Mismatch::OtherFile { ledger: ledger.sha256.clone(), document: found };
        mismatches.insert(0, other);
    }
    Err(mismatches)
}

fn new_sections(ledger: &Ledger, document: &[TextSection]) -> Vec<Mismatch> {
    let known: BTreeSet<&str> =
        ledger.sections.iter().map(|section| section.name.as_str()).collect();
    document
        .iter()
        .filter(|section| !known.contains(section.name.as_str()))
        .map(|section| Mismatch::NewSection { section: section.name.clone() })
        .collect()
}

fn compare_section(ledger: &Section, document: &TextSection, mismatches: &mut Vec<Mismatch>) {
    let section = &ledger.name;
    for place in 0..ledger.items.len().max(document.items.len()) {
        let ordinal = place + 1;
        match (ledger.items.get(place), document.items.get(place)) {
            (Some(item), Some(found)) => {
                mismatches.extend(compare_item(section, ordinal, item, found));
                let has_grid = ledger.grids.iter().any(|grid| grid.n.contains(&ordinal));
                if !item.rules.is_empty() && !has_grid && is_about_all(&found.text) {
                    let text = found.text.clone();
                    mismatches.push(Mismatch::NoGrid { section: section.clone(), ordinal, text });
                }
            }
            (None, Some(found)) => mismatches.push(Mismatch::NewItem {
                section: section.clone(),
                ordinal,
                text: found.text.clone(),
            }),
            (Some(_), None) => {
                mismatches.push(Mismatch::NoSuchItem { section: section.clone(), ordinal });
            }
            (None, None) => {}
        }
    }
}

/// Whether a sentence contains *all*, *any*, *every* or *each*.
fn is_about_all(text: &str) -> bool {
    let mut words = text.split(|character: char| !character.is_alphabetic());
    words.any(|word| matches!(word.to_lowercase().as_str(), "all" | "any" | "every" | "each"))
}

fn compare_item(section: &str, ordinal: usize, item: &Item, found: &TextItem) -> Option<Mismatch> {
    let found_digest = digest(found.kind, &found.text);
    (item.kind != found.kind || item.digest != found_digest).then(|| Mismatch::OtherItem {
        section: section.to_owned(),
        ordinal,
        ledger: format!("{} {}", item.kind, item.digest),
        document: format!("{} {found_digest}", found.kind),
        text: found.text.clone(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ledger::{Form, ItemGrid};

    const TEXT: &str =
        "== Speed\n\nS is the speed. It may be zero.\n\n== Feed\n\n* F is the feed\n";

    fn ledger() -> Ledger {
        Ledger::begin("ours", "Ours", Form::Asciidoc, TEXT)
    }

    fn messages(text: &str, ledger: &Ledger) -> Vec<String> {
        check(text, ledger).unwrap_err().iter().map(ToString::to_string).collect()
    }

    #[test]
    fn the_document_itself_agrees() {
        assert_eq!(check(TEXT, &ledger()), Ok(()));
    }

    #[test]
    fn markup_and_blanks_may_differ() {
        let text = TEXT.replace("S is", "*S*  is").replace("== Feed", "\n== Feed [[feed]]");
        assert_eq!(check(&text, &ledger()), Ok(()));
    }

    #[test]
    fn sentence_about_all_of_something_needs_a_grid() {
        let text = "== Speed\n\nAny speed is taken. Ally.\n";
        let mut ledger = Ledger::begin("ours", "Ours", Form::Asciidoc, text);
        assert_eq!(check(text, &ledger), Ok(()));
        ledger.sections[0].items[0].rules = vec!["spindle.speed".to_owned()];
        let found = messages(text, &ledger);
        assert_eq!(
            found,
            ["\"Speed\" 1: the ledger names no grid or case for it: Any speed is taken."]
        );
        let name = "spindle.speed / each".to_owned();
        ledger.sections[0].grids = vec![ItemGrid { n: vec![1], name }];
        assert_eq!(check(text, &ledger), Ok(()));
    }

    #[test]
    fn another_word_is_found_with_its_place() {
        let found = messages(&TEXT.replace("zero", "one"), &ledger());
        assert_eq!(found.len(), 2);
        assert!(found[0].starts_with("the ledger was made from another file"), "{}", found[0]);
        assert!(found[1].starts_with("\"Speed\" 2: the ledger has sentence"), "{}", found[1]);
        assert!(found[1].ends_with("It may be one."), "{}", found[1]);
    }

    #[test]
    fn items_and_sections_too_many_or_too_few() {
        let more = format!("{TEXT}* It is positive\n\n== Dwell\n\nP is the time.\n");
        let found = messages(&more, &ledger());
        assert!(found[1].starts_with("\"Feed\" 2: the ledger's section ends"), "{}", found[1]);
        assert!(found[2].starts_with("\"Dwell\": the ledger has no section"), "{}", found[2]);
        let fewer = "== Speed\n\nS is the speed.\n";
        let found = messages(fewer, &ledger());
        assert!(found[1].starts_with("\"Speed\" 2: the document's section"), "{}", found[1]);
        assert!(found[2].starts_with("\"Feed\": the document has no section"), "{}", found[2]);
    }

    #[test]
    fn a_partial_ledger_leaves_sections_out() {
        let mut ledger = ledger();
        ledger.sections.pop();
        ledger.partial = true;
        assert_eq!(check(TEXT, &ledger), Ok(()));
    }

    #[test]
    fn another_kind_of_item_is_a_mismatch() {
        let found = messages(&TEXT.replace("* F", "F"), &ledger());
        assert!(found[1].starts_with("\"Feed\" 1: the ledger has list"), "{}", found[1]);
    }
}
