//! Splits Markdown source text. Links become their words; images, anchors and horizontal rules are markup.
//! Text before the first heading is a section, too.

use super::collector::{Collector, TextSection, folded};
use super::kind::Kind;

/// The name of the section of what comes before the first heading.
const BEFORE_FIRST: &str = "before the first heading";

/// Splits a document.
pub(super) fn split(text: &str) -> Vec<TextSection> {
    let mut reader = Reader::default();
    reader.collector.heading(BEFORE_FIRST);
    for line in text.lines() {
        reader.line(line.trim_end());
    }
    reader.flush();
    reader.collector.finish()
}

/// The state of the reader between two lines.
#[derive(Default)]
struct Reader {
    collector: Collector,
    /// The paragraph or list item that is being collected.
    open: Option<(Kind, String)>,
    /// The lines so far of the example between two fences.
    example: Option<String>,
}

impl Reader {
    fn line(&mut self, line: &str) {
        let words = line.trim_start();
        let is_fence = words.starts_with("```");
        if let Some(example) = &mut self.example {
            if is_fence {
                let text = example.trim_end().to_owned();
                self.example = None;
                self.collector.item(Kind::Example, text);
            } else {
                example.push_str(line);
                example.push('\n');
            }
        } else if is_fence {
            self.flush();
            self.example = Some(String::new());
        } else if let Some(name) = heading(words) {
            self.flush();
            self.collector.heading(&plain(name));
        } else if let Some(row) = words.strip_prefix('|') {
            self.flush();
            if !is_row_of_hyphens(row) {
                self.collector.item(Kind::Row, folded(&plain(row)));
            }
        } else if words.is_empty() || is_rule(words) || is_anchor(words) {
            self.flush();
        } else if let Some(item) = list_item(words) {
            self.flush();
            self.open = Some((Kind::List, item.to_owned()));
        } else if let Some((_, text)) = &mut self.open {
            text.push(' ');
            text.push_str(words);
        } else {
            self.open = Some((Kind::Sentence, words.to_owned()));
        }
    }

    /// Ends what is being collected.
    fn flush(&mut self) {
        if let Some((kind, text)) = self.open.take() {
            self.collector.prose(kind, &plain(&text));
        }
    }
}

/// The words of a heading of any level.
fn heading(line: &str) -> Option<&str> {
    let name = line.trim_start_matches('#');
    (name.len() < line.len() && name.starts_with(' ')).then(|| name.trim_end_matches('#').trim())
}

/// The row between the heading of a table and its other rows.
fn is_row_of_hyphens(row: &str) -> bool {
    row.chars().all(|mark| matches!(mark, '|' | ':' | '-' | ' ' | '\t'))
}

/// A line of three or more hyphens, asterisks or underscores.
fn is_rule(line: &str) -> bool {
    let of = |rule: char| line.chars().all(|mark| mark == rule);
    line.len() >= 3 && ['-', '*', '_'].into_iter().any(of)
}

/// An anchor in HTML on a line of its own.
fn is_anchor(line: &str) -> bool {
    line.starts_with("<a id=") && line.ends_with("></a>")
}

/// The text of a list item of any depth, bulleted or numbered.
fn list_item(line: &str) -> Option<&str> {
    let (marker, text) = line.split_once([' ', '\t'])?;
    let number = marker.strip_suffix('.').unwrap_or_default();
    let is_number =
        !number.is_empty() && number.chars().all(|character| character.is_ascii_digit());
    (matches!(marker, "-" | "*" | "+") || is_number).then(|| text.trim_start())
}

/// The text without images and marks of code, and with the words of each link instead of the link.
fn plain(text: &str) -> String {
    let mut kept = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("](") {
        let Some((opening, (_, after))) = before.rfind('[').zip(after.split_once(')')) else {
            break;
        };
        match before[..opening].strip_suffix('!') {
            Some(before) => kept.push_str(before),
            None => {
                kept.push_str(&before[..opening]);
                kept.push_str(&before[opening + 1..]);
            }
        }
        rest = after;
    }
    kept.push_str(rest);
    kept.replace('`', "")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ledger::split::{Form, extract, extracted_items};

    fn items(text: &str) -> Vec<(Kind, String)> {
        extracted_items(text, Form::Markdown)
    }

    #[test]
    fn headings_lose_their_markup() {
        let text = "Before.\n# `$G` - View [state](x#y) #\nText.\n\n<a id=\"inner\"></a>\n#### Inner\n***\nMore.\n";
        let names: Vec<_> =
            extract(text, Form::Markdown).into_iter().map(|section| section.name).collect();
        assert_eq!(names, [BEFORE_FIRST, "$G - View state", "Inner"]);
        assert_eq!(items(text).len(), 3);
    }

    #[test]
    fn paragraphs_and_lists_hold_sentences() {
        let text = "# A\nIt stops. See\n[the page](there), please.\n![Logo](x.png)\n\n- one. Two\n  \
                    more\n\t* inner\n12. numbered\n***\n*bold* text\n";
        let found = items(text);
        let texts: Vec<_> = found.iter().map(|(_, text)| text.as_str()).collect();
        assert_eq!(
            texts,
            [
                "It stops.",
                "See the page, please.",
                "one.",
                "Two more",
                "inner",
                "numbered",
                "*bold* text",
            ]
        );
        let lists = found.iter().filter(|(kind, _)| *kind == Kind::List);
        assert_eq!(lists.count(), 4);
    }

    #[test]
    fn each_row_of_a_table_is_an_item() {
        let text = "# A\n\t| ID | Text |\n|:---:|----|\n| **`1`** | See [x](y). It. |\nAfter.\n";
        assert_eq!(
            items(text),
            [
                (Kind::Row, "ID | Text |".into()),
                (Kind::Row, "**1** | See x. It. |".into()),
                (Kind::Sentence, "After.".into()),
            ]
        );
    }

    #[test]
    fn a_fence_holds_an_example() {
        let text = "# A\n- item:\n    ```\n    # G1\n\n    - X1\n    ```\nAfter.\n";
        assert_eq!(
            items(text),
            [
                (Kind::List, "item:".into()),
                (Kind::Example, "    # G1\n\n    - X1".into()),
                (Kind::Sentence, "After.".into()),
            ]
        );
    }
}
