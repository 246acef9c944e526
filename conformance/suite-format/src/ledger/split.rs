//! Splits the text of a document into sections and items, the same way each time.
//!
//! An item is a sentence of prose, of a list item, of a note or of a warning, a table row, or a
//! whole code example. Items are counted from 1 within their section, in the order of the text.

use serde::{Deserialize, Serialize};

use super::collector::TextSection;
use super::{asciidoc, comments, manual, markdown, web};

/// How the text of a document is set out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Form {
    /// Asciidoc source text.
    Asciidoc,
    /// Asciidoc source text with a line number printed before each line.
    NumberedAsciidoc,
    /// The text of a web page: a paragraph per line, `-` before a list item, `|` between cells.
    Web,
    /// A printed manual with numbered headings, in the XML that `pdftohtml -xml -i -stdout` writes.
    Manual,
    /// Markdown source text.
    Markdown,
    /// The comments of a C file: a section per function and step.
    Comments,
}

/// Splits a document. Sections without items are left out; so is text before the first heading.
pub fn extract(document_text: &str, form: Form) -> Vec<TextSection> {
    let mut sections = match form {
        Form::Asciidoc => asciidoc::split(document_text.lines()),
        Form::NumberedAsciidoc => {
            asciidoc::split(document_text.lines().filter_map(without_line_number))
        }
        Form::Web => web::split(document_text),
        Form::Manual => manual::split(document_text),
        Form::Markdown => markdown::split(document_text),
        Form::Comments => comments::split(document_text),
    };
    sections.retain(|section| !section.items.is_empty());
    sections
}

/// Kind and text of each item of a document, for the tests of its form.
#[cfg(test)]
pub(super) fn extracted_items(document_text: &str, form: Form) -> Vec<(super::kind::Kind, String)> {
    let items = extract(document_text, form).into_iter().flat_map(|section| section.items);
    items.map(|item| (item.kind, item.text)).collect()
}

/// The text after the printed line number; nothing for a line that has none.
fn without_line_number(line: &str) -> Option<&str> {
    let rest = line.trim_start();
    let after = rest.trim_start_matches(|digit: char| digit.is_ascii_digit());
    (after.len() < rest.len())
        .then(|| after.strip_prefix("  ").unwrap_or_else(|| after.trim_start()))
}
