//! Text that people read: documents, help, messages, documentation comments.

mod code;
mod text;
mod words;

use std::collections::BTreeMap;

pub use code::literal_lines;
pub use text::{Kind, Text, without_code};
pub use words::{Rules, Word, found_in};

use crate::files;

/// Text of the suite's pages, written into the model by a command.
const IDS: [&str; 2] = ["reference-model/src/ids/", "reference-model/src/dialects/quirk/"];

/// All text of the repository that people read; tests, and pages of the suite, are left out.
///
/// # Panics
///
/// When a source file is not Rust.
#[must_use]
pub fn all() -> Vec<Text> {
    let mut found = Vec::new();
    for (path, text) in files::below("") {
        if path.ends_with(".md") {
            found.push(Text { kind: Kind::Document, line: 1, text: without_code(&text), path });
        } else if path.ends_with(".rs") && !is_test(&path) && !is_generated(&path) {
            found.extend(code::texts(&path, &text));
        }
    }
    found
}

/// Whether a source file holds the text of pages alone.
fn is_generated(path: &str) -> bool {
    IDS.iter().any(|ids| path.starts_with(ids))
}

/// Whether a source file belongs to tests or to measurements alone.
fn is_test(path: &str) -> bool {
    path.ends_with("/tests.rs")
        || ["/tests/", "/benches/"].iter().any(|folder| path.contains(folder))
}

/// House words of the repository, as `laws/words.toml` defines them: kind of text, place and word of each.
#[must_use]
pub fn house_words(rules: &Rules) -> Vec<(Kind, String)> {
    let mut found = Vec::new();
    for text in all() {
        for (line, word) in found_in(rules, &text.text) {
            let context = text.text.lines().nth(line).unwrap_or_default().trim();
            found.push((
                text.kind,
                format!("{}:{}: {word:?}: {context}", text.path, text.line + line),
            ));
        }
    }
    found
}

/// How many of them there are of each kind.
#[must_use]
pub fn count(words: &[(Kind, String)]) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for (kind, _) in words {
        *counts.entry(kind.to_string()).or_default() += 1;
    }
    counts
}
