//! Splits a printed manual with numbered headings, in the XML that `pdftohtml -xml -i -stdout` writes.

use super::collector::{Collector, TextSection};
use super::kind::Kind;
use super::printed_page::{Face, Line, lines};

/// Lines of one paragraph follow each other at most this far. Pixels.
const LINE_PITCH: i32 = 21;
/// A program's lines with a blank line between them lie further apart than this. Pixels.
const BLANK_LINE: i32 = 25;
/// A table's lines, caption and heading included, follow each other at most this far. Pixels.
const TABLE_PITCH: i32 = 40;
/// Captions and tables without one begin at least this far from the left edge. Pixels.
const CENTRED: i32 = 200;

/// Splits the manual; text before the first numbered heading is left out.
pub(super) fn split(xml: &str) -> Vec<TextSection> {
    let mut reader = Reader::default();
    for line in lines(xml) {
        reader.line(&line);
    }
    reader.flush();
    reader.collector.finish()
}

#[derive(Default)]
struct Reader {
    collector: Collector,
    open: Open,
    /// A bold line that may be the title of a program.
    title: Option<String>,
    /// The footnotes of the page; they wait until the open paragraph has ended.
    footnotes: Vec<String>,
}

/// What is being collected.
#[derive(Default)]
enum Open {
    #[default]
    Nothing,
    Heading(String),
    Paragraph(Kind, String),
    Program(String),
    Table(Table),
}

#[derive(Default)]
struct Table {
    heading: String,
    rows: Vec<String>,
    /// Where the cells of the last row begin. Pixels from the left.
    columns: Vec<i32>,
}

impl Reader {
    fn line(&mut self, line: &Line) {
        let text = line.text();
        if line.is_footnote() {
            self.footnote(line, &text);
        } else if line.is_program() {
            self.program(line, &text);
        } else if line.is_heading() {
            self.heading(line, &text);
        } else if self.continues_table(line) {
            self.table_line(line, &text);
        } else if line.left >= CENTRED && (is_caption(&text) || line.is_bold()) {
            self.flush();
            let heading = if is_caption(&text) { String::new() } else { line.row() };
            self.open = Open::Table(Table { heading, ..Table::default() });
        } else if let Some(kind) = admonition(line, &text) {
            self.flush();
            self.open = Open::Paragraph(kind, String::new());
        } else {
            self.prose(line, &text);
        }
    }

    fn footnote(&mut self, line: &Line, text: &str) {
        match self.footnotes.last_mut() {
            Some(footnote) if line.gap.is_some_and(|gap| gap <= LINE_PITCH) => {
                join(footnote, text);
            }
            _ => self.footnotes.push(text.to_owned()),
        }
    }

    fn program(&mut self, line: &Line, text: &str) {
        if let Open::Program(program) = &mut self.open {
            program.push_str(if line.gap.is_some_and(|gap| gap > BLANK_LINE) {
                "\n\n"
            } else {
                "\n"
            });
            program.push_str(text);
        } else {
            let title = self.title.take();
            self.flush();
            let title = title.map(|title| title + "\n").unwrap_or_default();
            self.open = Open::Program(title + text);
        }
    }

    fn heading(&mut self, line: &Line, text: &str) {
        if let Open::Heading(heading) = &mut self.open
            && line.gap.is_some_and(|gap| gap <= BLANK_LINE)
        {
            join(heading, text);
        } else {
            self.flush();
            self.open = Open::Heading(text.to_owned());
        }
    }

    /// A table goes on with lines that follow closely, and after a page break under its caption
    /// or its repeated heading.
    fn continues_table(&self, line: &Line) -> bool {
        let Open::Table(table) = &self.open else { return false };
        match line.gap {
            Some(gap) => gap <= TABLE_PITCH,
            None => line.text().ends_with("(continued)") || line.is_bold() && table.repeats(line),
        }
    }

    fn table_line(&mut self, line: &Line, text: &str) {
        if let Open::Table(table) = &mut self.open
            && !is_caption(text)
            && !table.repeats(line)
        {
            table.add(line);
        }
    }

    fn prose(&mut self, line: &Line, text: &str) {
        let goes_on = self.continues_paragraph(line);
        let item = list_item(text).or_else(|| if goes_on { None } else { numbered_item(text) });
        if item.is_none() && goes_on {
            if let Open::Paragraph(_, paragraph) = &mut self.open {
                join(paragraph, text);
            }
            return;
        }
        let noted = self.admonition();
        self.flush();
        if line.is_bold() && item.is_none() {
            self.title = Some(text.to_owned());
            return;
        }
        let kind = match noted {
            Some(kind) if line.font().face == Face::Sans => kind,
            _ if item.is_some() => Kind::List,
            _ => Kind::Sentence,
        };
        self.open = Open::Paragraph(kind, item.unwrap_or(text).to_owned());
    }

    /// The kind of the note or warning that is open.
    fn admonition(&self) -> Option<Kind> {
        if let Open::Paragraph(kind @ (Kind::Note | Kind::Warning), _) = self.open {
            Some(kind)
        } else {
            None
        }
    }

    /// A paragraph goes on with the next line, and over a page break when its last sentence has
    /// not ended.
    fn continues_paragraph(&self, line: &Line) -> bool {
        let Open::Paragraph(_, paragraph) = &self.open else { return false };
        match line.gap {
            Some(gap) => gap <= LINE_PITCH,
            None => !paragraph.ends_with(['.', ':', '?', '!']),
        }
    }

    /// Ends what is being collected.
    fn flush(&mut self) {
        if let Some(title) = self.title.take() {
            self.collector.prose(Kind::Sentence, &title);
        }
        match std::mem::take(&mut self.open) {
            Open::Nothing => {}
            Open::Heading(heading) => self.collector.heading(&heading),
            Open::Paragraph(kind, text) => self.collector.prose(kind, &text),
            Open::Program(program) => self.collector.item(Kind::Example, program),
            Open::Table(Table { heading, rows, columns: _ }) => {
                self.collector.item(Kind::Row, heading);
                for row in rows {
                    self.collector.item(Kind::Row, row);
                }
            }
        }
        for footnote in std::mem::take(&mut self.footnotes) {
            self.collector.prose(Kind::Sentence, &footnote);
        }
    }
}

impl Table {
    /// Whether the line is, after a page break, what the heading begins or goes on with.
    fn repeats(&self, line: &Line) -> bool {
        line.is_bold() && !self.rows.is_empty() && self.heading.contains(&line.row())
    }

    /// Adds a line: to the heading when it is bold, to the row above when it goes on with one of
    /// its cells or closes its parenthesis, else as a row.
    fn add(&mut self, line: &Line) {
        let row = line.row();
        if line.is_bold() && self.rows.is_empty() {
            join(&mut self.heading, &row);
            return;
        }
        let lefts = line.cell_lefts();
        let one_cell = lefts.len() == 1 && self.columns.contains(&lefts[0]);
        let open = |above: &str| above.matches('(').count() > above.matches(')').count();
        match self.rows.last_mut() {
            Some(above) if one_cell || open(above) => join(above, &row),
            _ => {
                self.rows.push(row);
                self.columns = lefts;
            }
        }
    }
}

/// Adds a line to running text. A hyphen at the end of the line is taken for a division.
fn join(text: &mut String, line: &str) {
    let divided = text.strip_suffix('-').is_some_and(|rest| rest.ends_with(char::is_alphabetic));
    if divided && line.starts_with(char::is_lowercase) {
        text.pop();
    } else if !text.is_empty() {
        text.push(' ');
    }
    text.push_str(line);
}

fn is_caption(text: &str) -> bool {
    let numbered = |rest: &str| rest.starts_with(|first: char| first.is_ascii_digit());
    text.strip_prefix("Table ").is_some_and(numbered)
}

fn admonition(line: &Line, text: &str) -> Option<Kind> {
    if line.font().face != Face::Sans || !line.is_bold() {
        return None;
    }
    match text {
        "Note" | "Tip" => Some(Kind::Note),
        "Warning" | "Caution" | "Important" => Some(Kind::Warning),
        _ => None,
    }
}

fn list_item(text: &str) -> Option<&str> {
    text.strip_prefix(['•', '–']).map(str::trim_start)
}

fn numbered_item(text: &str) -> Option<&str> {
    let (number, item) = text.split_once(". ")?;
    (number.len() <= 2 && number.chars().all(|mark| mark.is_ascii_digit())).then_some(item)
}

#[cfg(test)]
mod tests {
    use std::fmt::Write;

    use super::*;
    use crate::ledger::collector::TextItem;

    /// Pages of lines: how far down each begins, from the left, its font and its text.
    fn pages(pages: &[&[(i32, i32, char, &str)]]) -> Vec<(Kind, String)> {
        let mut xml = String::new();
        for page in pages {
            xml.push_str("<page number=\"1\">\n");
            for (id, size, family) in
                [(0, 15, "Serif"), (1, 15, "Sans"), (2, 13, "Mono"), (3, 12, "")]
            {
                writeln!(xml, "<fontspec id=\"{id}\" size=\"{size}\" family=\"{family}\"/>")
                    .unwrap();
            }
            let mut top = 100;
            for (gap, left, font, text) in *page {
                top += gap;
                for (cell, text) in (0..).zip(text.split('|')) {
                    write_piece(&mut xml, top, left + 100 * cell, *font, text);
                }
            }
            xml.push_str("</page>\n");
        }
        let items = split(&xml).into_iter().flat_map(|section| section.items);
        items.map(|TextItem { kind, text }| (kind, text)).collect()
    }

    /// Fonts: `s` text, `b` bold, `h` heading, `n` note, `m` program, `f` footnote.
    fn write_piece(xml: &mut String, top: i32, left: i32, font: char, text: &str) {
        let id = match font {
            'h' | 'n' => 1,
            'm' => 2,
            'f' => 3,
            _ => 0,
        };
        let bold = if "hb".contains(font) { format!("<b>{text}</b>") } else { text.to_owned() };
        let place = format!("top=\"{top}\" left=\"{left}\" width=\"50\"");
        writeln!(xml, "<text {place} font=\"{id}\">{bold}</text>").unwrap();
    }

    fn texts(items: &[(Kind, String)]) -> Vec<&str> {
        items.iter().map(|(_, text)| text.as_str()).collect()
    }

    #[test]
    fn paragraphs_end_with_a_gap_and_go_on_over_a_page() {
        let items = pages(&[
            &[
                (0, 85, 'h', "1.2 Feed"),
                (40, 85, 's', "The feed is com-"),
                (18, 85, 's', "manded by F."),
                (27, 85, 's', "It may"),
            ],
            &[(0, 85, 's', "change."), (30, 85, 's', "• one"), (18, 101, 's', "item")],
        ]);
        assert_eq!(texts(&items), ["The feed is commanded by F.", "It may change.", "one item"]);
        assert_eq!(items[2].0, Kind::List);
    }

    #[test]
    fn numbers_before_items_count_only_at_a_beginning() {
        let items = pages(&[&[
            (0, 85, 'h', "1.2 Feed"),
            (40, 85, 's', "1. F is at most"),
            (18, 85, 's', "9. More is refused."),
            (27, 85, 's', "2. S"),
        ]]);
        assert_eq!(texts(&items), ["F is at most 9.", "More is refused.", "S"]);
        assert!(items.iter().all(|(kind, _)| *kind == Kind::List));
    }

    #[test]
    fn a_program_keeps_its_title_and_blank_lines() {
        let items = pages(&[&[
            (0, 85, 'h', "1.2 Feed"),
            (40, 85, 'b', "Example"),
            (27, 85, 'm', "G1 X1"),
            (33, 85, 'm', "M2"),
            (40, 85, 'b', "Not a title"),
            (27, 85, 's', "Text."),
        ]]);
        assert_eq!(texts(&items), ["Example\nG1 X1\n\nM2", "Not a title", "Text."]);
    }

    #[test]
    fn notes_are_set_in_another_face() {
        let items = pages(&[&[
            (0, 85, 'h', "1.2 Feed"),
            (40, 100, 'h', "Note"),
            (18, 100, 'n', "Hear this. And"),
            (18, 100, 'n', "that."),
            (40, 85, 's', "Text."),
        ]]);
        let kinds: Vec<Kind> = items.iter().map(|(kind, _)| *kind).collect();
        assert_eq!(kinds, [Kind::Note, Kind::Note, Kind::Sentence]);
    }

    #[test]
    fn a_table_goes_on_over_a_page() {
        let items = pages(&[
            &[
                (0, 85, 'h', "1.2 Feed"),
                (40, 330, 's', "Table 1.1: Words"),
                (34, 220, 'b', "Letter|Meaning"),
                (18, 220, 's', "A|An axis"),
                (18, 320, 's', "of the machine"),
            ],
            &[
                (0, 330, 's', "Table 1.1: (continued)"),
                (34, 220, 'b', "Letter|Meaning"),
                (18, 220, 's', "F|Feed"),
                (18, 226, 's', "centred"),
                (60, 85, 's', "Text."),
            ],
        ]);
        assert_eq!(
            texts(&items),
            ["Letter | Meaning", "A | An axis of the machine", "F | Feed", "centred", "Text."]
        );
    }

    #[test]
    fn a_footnote_waits_for_the_end_of_the_paragraph() {
        let items = pages(&[
            &[
                (0, 85, 'h', "1.2 Feed"),
                (40, 85, 's', "The feed"),
                (40, 105, 'f', "At most."),
                (14, 85, 'f', "Or so."),
            ],
            &[(0, 85, 's', "is large."), (27, 85, 's', "Text.")],
        ]);
        assert_eq!(texts(&items), ["The feed is large.", "At most.", "Or so.", "Text."]);
    }
}
