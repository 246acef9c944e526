//! How text is written that people read.

use gaugeblock_laws::files::{below, sources};
use gaugeblock_laws::prose::{self, Rules, literal_lines};

use crate::holds;

/// Columns of a line.
const COLUMNS_MAX: usize = 120;

#[test]
fn house_words_do_not_become_more() {
    let rules = Rules::read();
    let words = prose::house_words(&rules);
    let mut more = Vec::new();
    for (kind, count) in prose::count(&words) {
        let ceiling =
            rules.ceiling.get(&kind).and_then(toml::Value::as_integer).unwrap_or_default();
        if count > usize::try_from(ceiling).expect("a ceiling is not negative") {
            more.push(format!("{kind}: {count} of {ceiling}"));
        }
    }
    holds("text has plain words (`cargo run -p gaugeblock-laws -- words` lists the others)", &more);
}

fn is_long(line: &str) -> bool {
    line.chars().count() > COLUMNS_MAX
}

/// A literal may be longer: broken, it would be harder to compare with what is printed.
#[test]
fn code_and_comments_have_lines_of_120_columns() {
    let mut long = Vec::new();
    for (path, text) in sources("").iter().filter(|(_, text)| text.lines().any(is_long)) {
        let literals = literal_lines(text);
        let lines = (1..)
            .zip(text.lines())
            .filter(|(number, line)| is_long(line) && !literals.contains(number));
        long.extend(lines.map(|(number, _)| format!("{path}:{number}")));
    }
    holds("a longer line has a literal", &long);
}

/// Values are data, and as long as they are; `#` and a name without a blank is a parameter of a program.
#[test]
fn comments_of_toml_files_have_lines_of_120_columns() {
    let mut long = Vec::new();
    for (path, text) in below("").iter().filter(|(path, _)| path.ends_with(".toml")) {
        let is_comment = |line: &str| line.trim_start().starts_with("# ");
        let lines = (1..).zip(text.lines()).filter(|(_, line)| is_long(line) && is_comment(line));
        long.extend(lines.map(|(number, _): (usize, _)| format!("{path}:{number}")));
    }
    holds("a comment has lines of 120 columns", &long);
}

/// A row of a table is one line, and so is an address.
#[test]
fn documents_have_lines_of_120_columns() {
    let is_unbreakable = |line: &str| {
        let is_address =
            line.split_whitespace().count() == 1 || (line.starts_with('[') && line.contains("]: "));
        line.trim_start().starts_with('|') || is_address
    };
    let mut long = Vec::new();
    for (path, text) in below("").into_iter().filter(|(path, _)| path.ends_with(".md")) {
        let mut is_fenced = false;
        for (number, line) in text.lines().enumerate() {
            is_fenced ^= line.trim_start().starts_with("```");
            if is_long(line) && !is_fenced && !is_unbreakable(line) {
                long.push(format!("{path}:{}", number + 1));
            }
        }
    }
    holds("a document has lines of 120 columns", &long);
}
