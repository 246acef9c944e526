//! A piece of text, without the program text in it.

use std::fmt;

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
