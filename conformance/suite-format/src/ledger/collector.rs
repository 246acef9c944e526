//! Sections and items, collected in the order of the text.

use super::digest::words;
use super::kind::Kind;

/// A section of a document: the text under one heading, up to the next heading of any level.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextSection {
    /// The words of the heading.
    pub name: String,
    /// Its items in order; the item with ordinal 1 comes first.
    pub items: Vec<TextItem>,
}

/// An item in the words of the document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextItem {
    /// What it is.
    pub kind: Kind,
    /// Its text, blanks and line breaks folded (in an example kept).
    pub text: String,
}

/// Collects items under headings.
#[derive(Debug, Default)]
pub(super) struct Collector {
    sections: Vec<TextSection>,
}

impl Collector {
    /// Begins a section.
    pub(super) fn heading(&mut self, name: &str) {
        self.sections.push(TextSection { name: folded(name), items: Vec::new() });
    }

    /// Adds running text: one item per sentence.
    pub(super) fn prose(&mut self, kind: Kind, text: &str) {
        for sentence in sentences(&folded(text)) {
            self.item(kind, sentence);
        }
    }

    /// Adds one item, unless it has no words or comes before the first heading.
    pub(super) fn item(&mut self, kind: Kind, text: String) {
        if let Some(section) = self.sections.last_mut()
            && !words(kind, &text).is_empty()
        {
            section.items.push(TextItem { kind, text });
        }
    }

    /// All sections.
    pub(super) fn finish(self) -> Vec<TextSection> {
        self.sections
    }
}

/// One blank for each run of blanks and line breaks.
pub(super) fn folded(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Splits running text into sentences.
///
/// A sentence ends with a full stop, a question or an exclamation mark, closing marks included,
/// where the text ends or goes on after a blank with anything but a small letter (a full stop
/// between two digits is a decimal point, blanks or not). After a closing parenthesis and a full
/// stop the blank may be missing before a capital.
pub(super) fn sentences(text: &str) -> Vec<String> {
    let marks: Vec<(usize, char)> = text.char_indices().collect();
    let mut found = Vec::new();
    let mut begin = 0;
    for (place, &(at, mark)) in marks.iter().enumerate() {
        if !matches!(mark, '.' | '?' | '!') {
            continue;
        }
        let closing = marks[place + 1..].iter().take_while(|(_, mark)| is_closing(*mark)).count();
        let next = marks.get(place + 1 + closing);
        let end = next.map_or(text.len(), |&(next_at, _)| next_at);
        let ends = match next {
            None => true,
            Some((_, ' ')) => {
                !goes_on(&text[end + 1..])
                    && !is_abbreviation(&text[begin..=at])
                    && !is_decimal_point(&text[..at], &text[at + 1..])
            }
            Some((_, next)) => text[..at].ends_with(')') && closing == 0 && next.is_uppercase(),
        };
        if ends && end > begin {
            found.push(text[begin..end].trim().to_owned());
            begin = end;
        }
    }
    found.push(text[begin..].trim().to_owned());
    found.retain(|sentence| !sentence.is_empty());
    found
}

fn is_closing(mark: char) -> bool {
    matches!(mark, '\'' | '"' | '`' | ')' | '*' | '’' | '”')
}

/// Whether the rest of a text begins with a small letter, opening marks set aside.
fn goes_on(rest: &str) -> bool {
    rest.trim_start_matches(['\'', '"', '`', '(', '*', '‘', '“'])
        .starts_with(|mark: char| mark.is_lowercase())
}

fn is_decimal_point(before: &str, after: &str) -> bool {
    let digit = |mark: char| mark.is_ascii_digit();
    before.ends_with(digit) && after.trim_start().starts_with(digit)
}

fn is_abbreviation(text: &str) -> bool {
    ["e.g.", "i.e.", "vs."].iter().any(|short| text.ends_with(short))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ledger::{Form, extract};

    #[test]
    fn sentences_end_where_a_new_one_begins() {
        let text = "Motion stops. It goes on (unless held). 'M2' ends it. Is it? Yes.";
        assert_eq!(
            sentences(text),
            ["Motion stops.", "It goes on (unless held).", "'M2' ends it.", "Is it?", "Yes.",]
        );
    }

    #[test]
    fn a_full_stop_inside_does_not_end_a_sentence() {
        for whole in [
            "See the .ini file and G54 to G59.3 (i.e. Offsets).",
            "It runs at the feed. (unless something else is active).",
            "The state is not restored .",
            "The line G0 X +0. 12 34 goes to 0.1234.",
        ] {
            assert_eq!(sentences(whole), [whole]);
        }
    }

    #[test]
    fn a_missing_blank_after_a_parenthesis() {
        assert_eq!(
            sentences("Not both (a and b).Then it stops."),
            ["Not both (a and b).", "Then it stops."]
        );
    }

    #[test]
    fn text_without_a_full_stop_is_a_sentence() {
        assert_eq!(sentences("It consists of:"), ["It consists of:"]);
        assert!(sentences("").is_empty());
    }

    #[test]
    fn printed_line_numbers_are_stripped() {
        let text = "file.txt\n  1  == Speed\n  2  \n  3  S is the speed.\n 12   * 4 rows\n";
        let sections = extract(text, Form::NumberedAsciidoc);
        assert_eq!(sections.len(), 1);
        assert_eq!(sections[0].name, "Speed");
        assert_eq!(sections[0].items[0].text, "S is the speed.");
        assert_eq!(sections[0].items[1], TextItem { kind: Kind::List, text: "4 rows".into() });
    }
}
