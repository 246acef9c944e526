//! Writes the ids of all pages as Rust, so that the compiler knows each rule, choice, option and quirk.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use crate::{ChoiceKind, Suite};

/// Width of a line of a comment.
const WIDTH: usize = 110;

/// Width of a line of code.
const CODE_WIDTH: usize = 100;

/// The first line of each file.
const HEADING: &str = "written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.";

/// The folders of the model's sources that hold ids and nothing else.
pub const FOLDERS: [&str; 3] = [RULES, CHOICES, QUIRKS];

/// The folder of rules.
const RULES: &str = "ids/rule";

/// The folder of choices.
const CHOICES: &str = "ids/choice";

/// The folder of quirks.
const QUIRKS: &str = "dialects/quirk";

/// A page as it is written: its id, its sentence, and its options with what they mean.
struct Page<'a> {
    id: &'a str,
    sentence: &'a str,
    options: Vec<(&'a str, &'a str)>,
}

/// The text of each file, by its path in the model's sources: a file per chapter in each of [`FOLDERS`].
pub fn model_ids(suite: &Suite) -> BTreeMap<String, String> {
    let rules = suite.rules.iter();
    let rules =
        rules.map(|rule| Page { id: &rule.id, sentence: &rule.sentence, options: Vec::new() });
    let of_kind = |kind| {
        let pages = suite.choices.iter().filter(move |choice| choice.kind == kind);
        pages.map(|choice| {
            let options = choice.options.iter();
            let options =
                options.map(|option| (option.name.as_str(), option.means.as_str())).collect();
            Page { id: &choice.id, sentence: &choice.sentence, options }
        })
    };
    let of_motion = suite.motion_choices.iter().map(|choice| {
        let options = choice.options.iter();
        let options = options.map(|option| (option.name.as_str(), option.means.as_str())).collect();
        Page { id: &choice.id, sentence: &choice.sentence, options }
    });
    let mut files = BTreeMap::new();
    add("rule", RULES, rules.collect(), &mut files);
    add("choice", CHOICES, of_kind(ChoiceKind::Choice).chain(of_motion).collect(), &mut files);
    add("quirk", QUIRKS, of_kind(ChoiceKind::Quirk).collect(), &mut files);
    files
}

/// Writes all pages of one kind: the list of chapters, and a file for each.
fn add(kind: &str, folder: &str, pages: Vec<Page<'_>>, files: &mut BTreeMap<String, String>) {
    let mut chapters: BTreeMap<&str, Vec<Page<'_>>> = BTreeMap::new();
    for page in pages {
        let chapter = page.id.split('.').next().unwrap_or_default();
        chapters.entry(chapter).or_default().push(page);
    }
    files.insert(format!("{folder}/mod.rs"), list(kind, &chapters));
    files.insert(format!("{folder}/first.rs"), first(kind, &chapters));
    for (chapter, pages) in chapters {
        files.insert(format!("{folder}/{}.rs", snake(chapter)), text(kind, chapter, &pages));
    }
}

/// The list of chapters.
fn list(kind: &str, chapters: &BTreeMap<&str, Vec<Page<'_>>>) -> String {
    let mut text = format!("//! Every {kind} by its chapter; {HEADING}\n\n");
    let modules = chapters.keys().map(|chapter| (snake(chapter), "pub "));
    let modules: BTreeMap<_, _> = modules.chain([("first".to_owned(), "")]).collect();
    for (module, visibility) in modules {
        let _ = writeln!(text, "{visibility}mod {module};");
    }
    let (import, content, what) = match kind {
        "choice" => ("use super::page::Page;\n", "Page", "pages"),
        _ => ("", "&str", "ids"),
    };
    let _ = write!(text, "\n{import}pub(crate) use first::COUNT;\n\n");
    let _ = writeln!(text, "/// The {what} of each chapter, in the order of their numbers.");
    let tables = chapters
        .keys()
        .map(|chapter| format!("{}::CHAPTER_{}", snake(chapter), what.to_uppercase()));
    let tables: Vec<_> = tables.collect();
    let line = format!("pub(crate) const CHAPTERS: &[&[{content}]] = &[{}];", tables.join(", "));
    if line.len() <= CODE_WIDTH {
        let _ = writeln!(text, "{line}");
        return text;
    }
    let _ = write!(text, "pub(crate) const CHAPTERS: &[&[{content}]] =");
    let list = format!("    &[{}];", tables.join(", "));
    if list.len() <= CODE_WIDTH {
        let _ = writeln!(text, "\n{list}");
        return text;
    }
    text.push_str(" &[\n");
    for table in tables {
        let _ = writeln!(text, "    {table},");
    }
    text.push_str("];\n");
    text
}

/// The number of the first page of each chapter, and how many pages there are.
fn first(kind: &str, chapters: &BTreeMap<&str, Vec<Page<'_>>>) -> String {
    let mut text = format!("//! The number of the first {kind} of each chapter; {HEADING}\n\n");
    let mut number = 0;
    for (chapter, pages) in chapters {
        let _ = writeln!(text, "pub(super) const {}: u16 = {number};", shout(chapter));
        number += pages.len();
    }
    let _ = write!(text, "\n/// How many there are.\npub(crate) const COUNT: u16 = {number};\n");
    text
}

/// A chapter.
fn text(kind: &str, chapter: &str, pages: &[Page<'_>]) -> String {
    let mut text = format!("//! Each {kind} of `{chapter}`; {HEADING}\n\n{kind}s! {{\n");
    let _ = writeln!(text, "    super::first::{};", shout(chapter));
    if kind != "choice" {
        text.push('\n');
    }
    for page in pages {
        if kind == "choice" {
            text.push('\n');
        }
        document(&mut text, "    ", page.sentence);
        let name = page.id.split_once('.').map_or(page.id, |(_, name)| name);
        if kind != "choice" {
            let _ = writeln!(text, "    {} = \"{}\",", shout(name), page.id);
            continue;
        }
        let _ = writeln!(text, "    {} = \"{}\" {{", camel(name), page.id);
        for (option, means) in &page.options {
            document(&mut text, "        ", means);
            let _ = writeln!(text, "        {} = \"{option}\",", camel(option));
        }
        text.push_str("    }\n");
    }
    text.push_str("}\n");
    text
}

/// A sentence as a doc comment. What has a meaning of its own there is set as code.
fn document(text: &mut String, indent: &str, sentence: &str) {
    let mut line = format!("{indent}///");
    for word in sentence.split_whitespace() {
        let word = as_code(word);
        if line.len() + 1 + word.len() > WIDTH {
            text.push_str(&line);
            text.push('\n');
            line = format!("{indent}///");
        }
        line.push(' ');
        line.push_str(&word);
    }
    text.push_str(&line);
    text.push('\n');
}

/// A word, in backticks where it has a sign that documentation would read as something else.
fn as_code(word: &str) -> String {
    let special = |character| matches!(character, '_' | '<' | '>' | '[' | ']' | '*' | '#' | '`');
    if !word.contains(special) {
        return word.to_owned();
    }
    let core = word.trim_end_matches([',', '.', ';', ':']);
    format!("`{}`{}", core.replace('`', ""), &word[core.len()..])
}

/// `saved-state` as the name of a module.
fn snake(id: &str) -> String {
    id.replace('-', "_")
}

/// `saved-state` as the name of a constant.
fn shout(id: &str) -> String {
    snake(id).to_uppercase()
}

/// `saved-state` as the name of a type or a variant.
fn camel(id: &str) -> String {
    let word = |word: &str| {
        let mut letters = word.chars();
        letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect::<String>()
    };
    id.split('-').map(word).collect()
}

/// The files of a folder that differ from what the pages say, each by its path: missing, left over, or of another text.
pub fn differing(suite: &Suite, found: &BTreeMap<String, String>) -> Vec<String> {
    let expected = model_ids(suite);
    let paths: BTreeSet<_> = expected.keys().chain(found.keys()).collect();
    paths.into_iter().filter(|path| expected.get(*path) != found.get(*path)).cloned().collect()
}
