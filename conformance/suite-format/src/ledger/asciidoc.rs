//! Splits Asciidoc source text. Anchors, index terms, references and attributes are markup and
//! no part of an item.

use super::collector::{Collector, TextSection, folded};
use super::kind::Kind;

/// Splits the lines of a document.
pub(super) fn split<'text>(lines: impl Iterator<Item = &'text str>) -> Vec<TextSection> {
    let mut reader = Reader::default();
    for line in lines {
        reader.line(line.trim_end());
    }
    reader.flush();
    reader.collector.finish()
}

/// The state of the reader between two lines.
#[derive(Default)]
struct Reader {
    collector: Collector,
    /// The paragraph, list item or admonition that is being collected.
    open: Option<(Kind, String)>,
    /// The block title (`.Title`) that belongs to what follows.
    title: Option<String>,
    /// What the next paragraph is, after `[NOTE]` and the like.
    admonition: Option<Kind>,
    inside: Inside,
}

#[derive(Default)]
enum Inside {
    #[default]
    Text,
    /// Between two lines of hyphens of this length; the lines so far.
    Example(usize, String),
    /// Between two lines of `|===`.
    Table,
}

impl Reader {
    fn line(&mut self, line: &str) {
        match &mut self.inside {
            Inside::Example(length, example) if is_rule(line, '-') == Some(*length) => {
                let text = match self.title.take() {
                    Some(title) => format!("{title}\n{example}"),
                    None => example.clone(),
                };
                self.collector.item(Kind::Example, text.trim_end().to_owned());
                self.inside = Inside::Text;
            }
            Inside::Example(_, example) => {
                example.push_str(line);
                example.push('\n');
            }
            Inside::Table if is_table_rule(line) => self.inside = Inside::Text,
            Inside::Table => {
                let row = folded(&resolved(line.trim_start_matches('|')));
                self.collector.item(Kind::Row, row);
            }
            Inside::Text => self.text_line(line),
        }
    }

    fn text_line(&mut self, line: &str) {
        let bare = without_anchors(line);
        let words = bare.trim();
        if let Some(length) = is_rule(line, '-') {
            self.flush();
            self.inside = Inside::Example(length, String::new());
        } else if is_table_rule(line) {
            self.flush();
            self.inside = Inside::Table;
        } else if let Some(name) = heading(words) {
            self.flush();
            self.collector.heading(&resolved(name));
        } else if words.is_empty() {
            // A line of anchors alone stands inside a paragraph as little as before it.
            self.flush();
        } else if let Some(kind) = admonition(words) {
            self.flush();
            self.admonition = Some(kind);
        } else if is_markup(words) {
            self.flush();
        } else if let Some(item) = list_item(words) {
            self.flush();
            self.open = Some((Kind::List, item.to_owned()));
        } else if let Some((_, text)) = &mut self.open {
            text.push(' ');
            text.push_str(words);
        } else if let Some(title) = block_title(line) {
            self.title = Some(title.to_owned());
        } else {
            self.open = Some((self.admonition.take().unwrap_or(Kind::Sentence), words.to_owned()));
        }
    }

    /// Ends what is being collected.
    fn flush(&mut self) {
        if let Some((kind, text)) = self.open.take() {
            if let Some(title) = self.title.take() {
                self.collector.prose(kind, &title);
            }
            self.collector.prose(kind, &resolved(&text));
        }
    }
}

/// The length of a line that consists of at least four of one character.
fn is_rule(line: &str, of: char) -> Option<usize> {
    (line.len() >= 4 && line.chars().all(|mark| mark == of)).then_some(line.len())
}

fn is_table_rule(line: &str) -> bool {
    line.strip_prefix('|')
        .is_some_and(|rest| rest.len() >= 3 && rest.chars().all(|mark| mark == '='))
}

fn heading(line: &str) -> Option<&str> {
    let name = line.trim_start_matches('=');
    (name.len() < line.len() && name.starts_with(' ')).then(|| name.trim_end_matches('=').trim())
}

/// Cautions and the like warn; tips are notes.
fn admonition(line: &str) -> Option<Kind> {
    match line {
        "[NOTE]" | "[TIP]" => Some(Kind::Note),
        "[WARNING]" | "[CAUTION]" | "[IMPORTANT]" => Some(Kind::Warning),
        _ => None,
    }
}

/// An attribute entry, an attribute list or a comment.
fn is_markup(line: &str) -> bool {
    let entry = line.strip_prefix(':').and_then(|rest| rest.split_once(':'));
    line.starts_with("//")
        || (line.starts_with('[') && line.ends_with(']'))
        || entry.is_some_and(|(name, _)| !name.is_empty() && !name.contains(' '))
}

/// The text of a list item of any depth, bulleted or numbered.
fn list_item(line: &str) -> Option<&str> {
    let (marker, text) = line.split_once(' ')?;
    let bullet = ['*', '.', '-'].iter().any(|mark| marker.chars().all(|each| each == *mark));
    (bullet && !marker.is_empty() && (marker.len() == 1 || !marker.starts_with('-')))
        .then(|| text.trim_start())
}

fn block_title(line: &str) -> Option<&str> {
    line.strip_prefix('.').filter(|title| title.starts_with(|first: char| first.is_alphanumeric()))
}

/// The line without `[[anchors]]` and `(((index terms)))`.
fn without_anchors(line: &str) -> String {
    without_between(&without_between(line, "[[", "]]"), "(((", ")))")
}

fn without_between(line: &str, open: &str, close: &str) -> String {
    let mut kept = String::new();
    let mut rest = line;
    while let Some((before, after)) = rest.split_once(open) {
        let Some((_, after)) = after.split_once(close) else { break };
        kept.push_str(before);
        rest = after;
    }
    kept + rest
}

/// The text with each reference `<<place,words>>` replaced by its words, or by its place where it
/// has none.
fn resolved(text: &str) -> String {
    let mut kept = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("<<") {
        let Some((reference, after)) = after.split_once(">>") else { break };
        let words = reference.split_once(',').map_or(reference, |(_, words)| words);
        kept.push_str(before);
        kept.push_str(words.trim());
        rest = after;
    }
    kept + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ledger::split::{Form, extract, extracted_items};

    fn items(text: &str) -> Vec<(Kind, String)> {
        extracted_items(text, Form::Asciidoc)
    }

    #[test]
    fn headings_lose_their_markup() {
        let text = "= Codes\n:a: {b:'':c}\n\n== M70 Save (((M70)))[[sec:M70]]\n(((M70)))\n\nText.\n\
                    === Inner ==\n\nMore.\n";
        let names: Vec<_> =
            extract(text, Form::Asciidoc).into_iter().map(|section| section.name).collect();
        assert_eq!(names, ["M70 Save", "Inner"]);
    }

    #[test]
    fn paragraphs_are_split_and_references_resolved() {
        let text = "== A\n[[here]]\nIt stops, see\n<<there,the other\nplace>>. It goes on.\n";
        assert_eq!(
            items(text),
            [
                (Kind::Sentence, "It stops, see the other place.".into()),
                (Kind::Sentence, "It goes on.".into()),
            ]
        );
    }

    #[test]
    fn lists_nest_and_hold_sentences() {
        let text = "== A\n* one. Two\n  more\n** inner\n. numbered\n\n * indented\n";
        let texts: Vec<_> = items(text).into_iter().map(|(_, text)| text).collect();
        assert_eq!(texts, ["one.", "Two more", "inner", "numbered", "indented"]);
        assert!(items(text).iter().all(|(kind, _)| *kind == Kind::List));
    }

    #[test]
    fn an_example_is_one_item_with_its_title() {
        let text = "== A\n.Example file\n[source,{ngc}]\n----\nG1 X1\n\n* no list\n----\nAfter.\n";
        assert_eq!(
            items(text),
            [
                (Kind::Example, "Example file\nG1 X1\n\n* no list".into()),
                (Kind::Sentence, "After.".into()),
            ]
        );
    }

    #[test]
    fn notes_and_warnings_keep_their_kind() {
        let text = "== A\nText.\n[NOTE]\nHear this.\nAnd this.\n\n[WARNING]\nBeware.\n\nText.\n";
        let kinds: Vec<_> = items(text).into_iter().map(|(kind, _)| kind).collect();
        assert_eq!(kinds, [Kind::Sentence, Kind::Note, Kind::Note, Kind::Warning, Kind::Sentence]);
    }

    #[test]
    fn each_row_of_a_table_is_an_item() {
        let text = "== A\n[width=\"60%\"]\n|====\n|Code | Text\n|<<x,M0 M1>>  | Pause\n|====\n";
        assert_eq!(
            items(text),
            [(Kind::Row, "Code | Text".into()), (Kind::Row, "M0 M1 | Pause".into())]
        );
    }
}
