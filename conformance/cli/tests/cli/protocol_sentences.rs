//! Each sentence of PROTOCOL.md has a test, or explains. `protocol_sentences.txt` has the sentences in the order of the
//! page, each with the names of its tests or with `explanation`.
//!
//! After a change of the page, correct the list: a sentence that demands something needs a test that fails without it.

use std::collections::BTreeSet;
use std::path::Path;

use crate::protocol::PAGE;

const LIST: &str = include_str!("protocol_sentences.txt");

/// Files of tests that are lists of entries: the name of each entry begins a paragraph.
const ENTRIES: [(&str, &str); 3] = [
    ("misbehaviours", include_str!("misbehaviours.txt")),
    ("asked_twice", include_str!("asked_twice.txt")),
    ("offering", include_str!("offering.txt")),
];

/// The sentences of a page: those of its paragraphs and list items, and the rows of its tables without their heads.
fn sentences(page: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut paragraph = String::new();
    let mut is_code = false;
    let lines: Vec<&str> = page.lines().collect();
    for (place, line) in lines.iter().enumerate() {
        let is_fence = line.starts_with("```");
        let is_item = line.starts_with("* ") || line.starts_with("- ");
        if is_fence || is_item || line.is_empty() || line.starts_with(['#', '|']) {
            split(&mut paragraph, &mut found);
        }
        if is_fence {
            is_code = !is_code;
        } else if is_code || line.is_empty() || line.starts_with('#') {
        } else if line.starts_with('|') {
            let is_head = lines.get(place + 1).is_some_and(|next| next.starts_with("| ---"));
            if !is_head && !line.starts_with("| ---") {
                found.push((*line).to_owned());
            }
        } else {
            let text = line.strip_prefix("* ").or_else(|| line.strip_prefix("- ")).unwrap_or(line);
            paragraph.push_str(text.trim());
            paragraph.push(' ');
        }
    }
    split(&mut paragraph, &mut found);
    found
}

/// Moves the sentences of a paragraph to those that were found.
fn split(paragraph: &mut String, found: &mut Vec<String>) {
    let mut rest = paragraph.trim();
    while !rest.is_empty() {
        let ends = rest.match_indices(['.', '!', '?']).map(|(place, _)| place + 1);
        let mut ends = ends.filter(|end| {
            let mut next = rest[*end..].chars();
            next.next() == Some(' ')
                && next
                    .next()
                    .is_some_and(|letter| letter.is_ascii_uppercase() || "`[*".contains(letter))
        });
        let end = ends.next().unwrap_or(rest.len());
        found.push(rest[..end].to_owned());
        rest = rest[end..].trim_start();
    }
    paragraph.clear();
}

/// Each sentence of the list, with what is said of it.
fn listed() -> Vec<(&'static str, Vec<&'static str>)> {
    let mut listed: Vec<(&str, Vec<&str>)> = Vec::new();
    for line in LIST.lines().filter(|line| !line.is_empty() && !line.starts_with("# ")) {
        match (line.strip_prefix("  = "), listed.last_mut()) {
            (Some(test), Some((_, all))) => all.push(test),
            (Some(_), None) => panic!("a test without a sentence: {line}"),
            (None, _) => listed.push((line, Vec::new())),
        }
    }
    listed
}

/// The names of all tests in the Rust sources below a folder.
fn tests(folder: &Path, names: &mut BTreeSet<String>) {
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            tests(&path, names);
        } else if path.extension().is_some_and(|end| end == "rs") {
            let source = std::fs::read_to_string(&path).expect("a source");
            let after = source.split("#[test]\n").skip(1);
            let names_of = after.filter_map(|rest| {
                let (_, rest) = rest.split_once("fn ")?;
                Some(rest.split_once('(')?.0.to_owned())
            });
            names.extend(names_of);
        }
    }
}

fn known_tests() -> BTreeSet<String> {
    let mut known = BTreeSet::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for folder in root.read_dir().expect("a folder").flatten().map(|entry| entry.path()) {
        for part in ["src", "tests"].map(|part| folder.join(part)) {
            if part.is_dir() {
                tests(&part, &mut known);
            }
        }
    }
    tests(&root.join("../vocabulary"), &mut known);
    for (file, text) in ENTRIES {
        let entries = text.split("\n\n").skip(1).filter_map(|entry| entry.lines().next());
        known.extend(entries.map(|entry| format!("{file}: {entry}")));
    }
    known
}

#[test]
fn sentence_of_the_protocol_has_a_test_or_explains() {
    let listed = listed();
    let page = sentences(PAGE);
    let other = page.iter().zip(&listed).find(|(sentence, (listed, _))| sentence != listed);
    assert_eq!(other, None, "the page has a sentence, and the list has another one there");
    assert_eq!(page.len(), listed.len(), "sentences of the page, and of the list");
    let known = known_tests();
    let mut tested = 0;
    for (sentence, tests) in &listed {
        assert!(!tests.is_empty(), "without a test: {sentence}");
        if tests[..] == ["explanation"] {
            continue;
        }
        let unknown = tests.iter().find(|test| !known.contains(**test));
        assert_eq!(unknown, None, "a test that does not exist, of: {sentence}");
        tested += 1;
    }
    assert!(tested > listed.len() / 2, "{tested} of {} sentences have a test", listed.len());
}

#[test]
fn sentence_that_is_changed_is_found() {
    let page = "# A\n\nOne. Two `x`\nis long. [Three](y)\n* four. Five:\n\n```json\n{}\n```\n| a | b |\n| --- | --- |\n| c. D | e |\n";
    let all = ["One.", "Two `x` is long.", "[Three](y)", "four.", "Five:", "| c. D | e |"];
    assert_eq!(sentences(page), all);
}
