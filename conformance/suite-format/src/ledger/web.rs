//! Splits the text of a web page: a paragraph per line, `-` on a line of its own before a list
//! item, `|` between the cells of a table.

use super::collector::{Collector, TextSection};
use super::kind::Kind;

/// Splits a page. Text before the first heading is left out.
pub(super) fn split(text: &str) -> Vec<TextSection> {
    let mut collector = Collector::default();
    let mut kind = Kind::Sentence;
    for line in text.lines().map(trimmed) {
        if line.contains('|') {
            collector.item(Kind::Row, row(line));
        } else if line == "-" {
            kind = Kind::List;
            continue;
        } else if let Some(name) = heading(line) {
            collector.heading(name);
        } else if !is_page_number(line) {
            collector.prose(kind, line);
        }
        kind = Kind::Sentence;
    }
    collector.finish()
}

/// The line without the bar that a cell of the page's frame leaves before it.
fn trimmed(line: &str) -> &str {
    let line = line.trim();
    match line.strip_prefix('|') {
        Some(rest) if !rest.contains('|') => rest.trim(),
        _ => line,
    }
}

/// A heading is a line without a full stop whose words of four letters and more begin with a capital; a page number may
/// precede it and a colon follow it.
fn heading(line: &str) -> Option<&str> {
    let name = line
        .trim_start_matches(|mark: char| mark.is_ascii_digit())
        .trim_start()
        .trim_end_matches(':');
    let words: Vec<&str> = name.split_whitespace().collect();
    let capital = |word: &&str| word.starts_with(|first: char| first.is_uppercase());
    let titled = words.len() >= 2
        && !name.ends_with('.')
        && words.first().is_some_and(capital)
        && words.iter().filter(|word| word.len() >= 4).all(capital);
    titled.then_some(name)
}

fn is_page_number(line: &str) -> bool {
    line.chars().all(|mark| mark.is_ascii_digit())
}

/// The cells of a row that are not empty.
fn row(line: &str) -> String {
    let cells: Vec<&str> = line.split('|').map(str::trim).filter(|cell| !cell.is_empty()).collect();
    cells.join(" | ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_paragraphs_lists_and_rows() {
        let text = "|\nSet Status of a Thing\nA thing is on or off. It is off at first.\n\
                    It is on when:\n-\nIt is set.\n-\n-\nIt is named, see Chapter Two.\n12\n\
                    More Notes:\nlevel 0 | level 1 |\n| |\n";
        let sections = split(text);
        let names: Vec<_> = sections.iter().map(|section| section.name.as_str()).collect();
        assert_eq!(names, ["Set Status of a Thing", "More Notes"]);
        let kinds: Vec<_> = sections[0].items.iter().map(|item| item.kind).collect();
        assert_eq!(kinds, [Kind::Sentence, Kind::Sentence, Kind::Sentence, Kind::List, Kind::List]);
        assert_eq!(sections[1].items.len(), 1);
        assert_eq!(sections[1].items[0].text, "level 0 | level 1");
    }

    #[test]
    fn a_page_number_before_a_heading_is_dropped() {
        assert_eq!(heading("20 Custom Macro"), Some("Custom Macro"));
        assert_eq!(heading("A variable is set on in these cases:"), None);
    }
}
