//! Splits the comments of a C file. Each function is a section, with the comments before it; within a function each
//! step is a section: a comment that begins with `STEP 3:` or with a number and a name, such as `[11. Set plane ]`.
//! The number and the name are its first item.

use super::collector::{Collector, TextSection};
use super::kind::Kind;

/// The name of the section of what comes after the last function.
const AFTER_LAST: &str = "after the last function";

/// Splits a file. Texts between quotes must not contain signs of comments.
pub(super) fn split(text: &str) -> Vec<TextSection> {
    let mut reader = Reader::default();
    for line in text.lines() {
        reader.line(line.trim_end());
    }
    reader.close_paragraph();
    reader.open_section(AFTER_LAST.to_owned());
    reader.collector.finish()
}

/// The state of the reader between two lines.
#[derive(Default)]
struct Reader {
    collector: Collector,
    /// Paragraphs outside functions: they belong to the next one.
    waiting: Vec<(Kind, String)>,
    /// The paragraph that is being collected.
    open: Option<(Kind, String)>,
    /// Whether the line is in the body of a function.
    is_inside: bool,
    /// Whether a block comment is open.
    is_block: bool,
    /// The step in which the reader is, such as `STEP 3`.
    step: String,
}

impl Reader {
    fn line(&mut self, line: &str) {
        if self.is_block {
            let (comment, is_end) = until_end(line);
            self.comment(comment);
            if is_end {
                self.is_block = false;
                self.close_paragraph();
            }
            return;
        }
        let block = line.find("/*");
        let rest = line.find("//");
        match (block, rest) {
            (Some(at), rest) if rest.is_none_or(|rest| at < rest) => {
                self.close_paragraph();
                self.code(&line[..at]);
                let (comment, is_end) = until_end(&line[at + 2..]);
                self.comment(comment);
                self.is_block = !is_end;
                if is_end {
                    self.close_paragraph();
                }
            }
            (_, Some(at)) => {
                let code = line[..at].trim_end();
                if !code.trim_start().is_empty() {
                    self.close_paragraph();
                    self.code(code);
                }
                self.comment(&line[at + 2..]);
                if !code.trim_start().is_empty() {
                    self.close_paragraph();
                }
            }
            _ => {
                self.close_paragraph();
                self.code(line);
            }
        }
    }

    /// Code outside comments: a function begins or ends in the first column.
    fn code(&mut self, code: &str) {
        if code.starts_with('}') {
            self.is_inside = false;
        } else if let Some(name) = function(code) {
            self.is_inside = true;
            self.step.clear();
            self.open_section(name.to_owned());
        }
    }

    /// A line of a comment. A blank line, a hyphen, a bracket or `NOTE:` begins a paragraph.
    fn comment(&mut self, line: &str) {
        let words = line.trim().trim_start_matches(['*', '-', '/']).trim();
        if words.is_empty() {
            self.close_paragraph();
        } else if let Some(step) = step(words) {
            self.close_paragraph();
            self.step = step.to_owned();
            self.open_section(step.to_owned());
            self.open = Some((Kind::Sentence, words.to_owned()));
        } else if let Some((name, rest)) = numbered(words) {
            self.close_paragraph();
            let before = if self.step.is_empty() { "" } else { ", " };
            self.open_section(format!("{}{before}{name}", self.step));
            self.collector.item(Kind::Sentence, name.to_owned());
            self.open = Some((Kind::Sentence, rest.to_owned()));
        } else if words.starts_with(['[', '(']) || words.starts_with("NOTE:") || is_item(line) {
            self.close_paragraph();
            let kind = match () {
                () if words.starts_with("NOTE:") => Kind::Note,
                () if is_item(line) => Kind::List,
                () => Kind::Sentence,
            };
            self.open = Some((kind, words.to_owned()));
        } else if let Some((_, text)) = &mut self.open {
            text.push(' ');
            text.push_str(words);
        } else {
            self.open = Some((Kind::Sentence, words.to_owned()));
        }
    }

    fn close_paragraph(&mut self) {
        match self.open.take() {
            Some((kind, text)) if self.is_inside => self.collector.prose(kind, &text),
            Some(paragraph) => self.waiting.push(paragraph),
            None => {}
        }
    }

    fn open_section(&mut self, name: String) {
        self.collector.heading(&name);
        for (kind, text) in self.waiting.drain(..) {
            self.collector.prose(kind, &text);
        }
    }
}

/// The comment up to its end, and whether it ends in this line.
fn until_end(line: &str) -> (&str, bool) {
    line.split_once("*/").map_or((line, false), |(comment, _)| (comment, true))
}

/// The name of a function whose definition begins in this line.
fn function(code: &str) -> Option<&str> {
    let (head, rest) = code.split_once('(')?;
    let head = head.trim_end();
    let is_definition = head.starts_with(|first: char| first.is_ascii_alphabetic())
        && head.contains(' ')
        && !rest.contains(';');
    let name = head.rsplit([' ', '*']).next()?;
    (is_definition && !name.is_empty()).then_some(name)
}

/// `STEP 3` of a comment that begins with `STEP 3:`.
fn step(words: &str) -> Option<&str> {
    let (step, _) = words.split_once(':')?;
    let number = step.strip_prefix("STEP ")?;
    number.chars().all(|digit| digit.is_ascii_digit()).then_some(step)
}

/// `11. Set plane` of a comment that begins with `[11. Set plane ]`, and what follows.
fn numbered(words: &str) -> Option<(&str, &str)> {
    let (name, rest) = words.strip_prefix('[')?.split_once(']')?;
    let (number, _) = name.split_once(". ")?;
    let is_number = !number.is_empty() && number.chars().all(|digit| digit.is_ascii_digit());
    is_number.then(|| (name.trim(), rest.trim_start_matches([':', ' '])))
}

/// Whether the line is an item of a list.
fn is_item(line: &str) -> bool {
    line.trim_start().starts_with("- ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ledger::split::{Form, extract};

    const TEXT: &str = "/* About.\n\n * The file.\n */\nint other(int);\n// Reads it. It\n// is long.\n\
        static char *read(int a) // first\n{\n  if (a) { f(); } // [No word]\n  // NOTE: One.\n  \
        // - two\n  /* --------\n     STEP 3: Check all. Then\n     act.\n  */\n  \
        // [11. Set plane ]: N/A\n  // [G1 Errors]: None.\n  g();\n}\n\n/*\n  Absent:\n\n  - Cycles\n  - Axes\n*/\n";

    #[test]
    fn functions_and_steps_are_sections() {
        let sections = extract(TEXT, Form::Comments);
        let names: Vec<_> = sections.iter().map(|section| section.name.as_str()).collect();
        assert_eq!(names, ["read", "STEP 3", "STEP 3, 11. Set plane", AFTER_LAST]);
    }

    #[test]
    fn function_may_have_a_blank_before_its_parameters() {
        let sections = extract("char *first (int a)\n{\n  // One.\n}\n// Two.\n", Form::Comments);
        let names: Vec<_> = sections.iter().map(|section| section.name.as_str()).collect();
        assert_eq!(names, ["first", AFTER_LAST]);
    }

    #[test]
    fn comments_are_split_into_sentences() {
        let sections = extract(TEXT, Form::Comments);
        let items = sections.iter().flat_map(|section| &section.items);
        let texts: Vec<_> = items.clone().map(|item| item.text.as_str()).collect();
        assert_eq!(
            texts,
            [
                "About.",
                "The file.",
                "Reads it.",
                "It is long.",
                "first",
                "[No word]",
                "NOTE: One.",
                "two",
                "STEP 3: Check all.",
                "Then act.",
                "11. Set plane",
                "N/A",
                "[G1 Errors]: None.",
                "Absent:",
                "Cycles",
                "Axes",
            ]
        );
        let kinds: Vec<_> = items.map(|item| item.kind).collect();
        assert_eq!(kinds[6..8], [Kind::Note, Kind::List]);
        assert_eq!(kinds[14..], [Kind::List, Kind::List]);
    }
}
