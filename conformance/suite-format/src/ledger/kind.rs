//! What an item of a document is.

use std::fmt;

use serde::{Deserialize, Serialize};

/// What an item is in its document.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A sentence of a paragraph.
    Sentence,
    /// A sentence of a list item.
    List,
    /// A row of a table, its heading included.
    Row,
    /// A code example with its title.
    Example,
    /// A sentence of a note.
    Note,
    /// A sentence of a warning.
    Warning,
}

impl fmt::Display for Kind {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Sentence => "sentence",
            Self::List => "list",
            Self::Row => "row",
            Self::Example => "example",
            Self::Note => "note",
            Self::Warning => "warning",
        })
    }
}
