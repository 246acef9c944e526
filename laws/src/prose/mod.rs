//! Text that people read: documents, help, messages, documentation comments.

mod code;
mod words;

use std::collections::BTreeMap;
use std::fmt;

pub use code::literal_lines;
pub use words::{Rules, Word, found_in};

use crate::files;

/// Text of the suite's pages, written into the model by a command.
const IDS: &str = "reference-model/src/ids/";

/// What a text is part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A Markdown file.
    Document,
    /// What `--help` prints.
    Help,
    /// A string literal of three words or more.
    Message,
    /// A documentation comment.
    Comment,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Document => "document",
            Self::Help => "help",
            Self::Message => "message",
            Self::Comment => "comment",
        })
    }
}

/// A piece of text and where it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Text {
    /// What it is part of.
    pub kind: Kind,
    /// Its file, from the root of the repository.
    pub path: String,
    /// Its first line in the file.
    pub line: usize,
    /// The text; program text in it is blanked out.
    pub text: String,
}

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
        } else if path.ends_with(".rs") && !is_test(&path) && !path.starts_with(IDS) {
            found.extend(code::texts(&path, &text));
        }
    }
    found
}

/// Whether a source file belongs to tests or to measurements alone.
fn is_test(path: &str) -> bool {
    path.ends_with("/tests.rs")
        || ["/tests/", "/benches/"].iter().any(|folder| path.contains(folder))
}

/// A text in which fenced blocks and what is between backquotes are blank; lines stay.
#[must_use]
pub fn without_code(text: &str) -> String {
    let mut is_fenced = false;
    let mut plain = String::new();
    for line in text.lines() {
        let is_fence = line.trim_start().starts_with("```");
        is_fenced ^= is_fence;
        if !is_fenced && !is_fence {
            // A word in place of the program text keeps its neighbours apart.
            let parts = line
                .split('`')
                .enumerate()
                .map(|(place, part)| if place % 2 == 0 { part } else { "…" });
            plain.extend(parts);
        }
        plain.push('\n');
    }
    plain
}

/// House words of the repository: kind of text, place and word of each.
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
